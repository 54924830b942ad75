#include "diagnosis/constant_diagnosis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>

#include "diagnosis/smith.h"

namespace plumbline::verify {

namespace {

constexpr double kGoodFit = 0.98;

using OfDirection = std::function<double(const Vec3&)>;

std::vector<std::pair<std::string, OfDirection>> candidates() {
  std::vector<std::pair<std::string, OfDirection>> list;
  list.emplace_back("cosθo", [](const Vec3& w) { return std::abs(w[2]); });
  for (double alpha = 0.01; alpha <= 1.2; alpha *= 1.1) {
    char name[40];
    std::snprintf(name, sizeof name, "G1(wo), GGX α≈%.2g", alpha);
    list.emplace_back(name, [alpha](const Vec3& w) { return smith_g1(w, alpha); });
  }
  return list;
}

}  // namespace

void ConstantByView::add(const Vec3& wo, const Diagnosis& cause) {
  if (std::isfinite(cause.constant)) points_.push_back({wo, cause.constant});
}

std::string ConstantByView::diagnosis() const {
  double total = 0, low = 1e300, high = 0;
  for (const Point& p : points_) {
    total += std::pow(std::log(p.ratio), 2);
    low = std::min(low, p.ratio);
    high = std::max(high, p.ratio);
  }
  // The same constant everywhere needs no function of wo.
  if (points_.size() < 3 || !(high > 1.01 * low)) return {};
  std::string best;
  double best_fit = kGoodFit;
  for (const auto& [name, value] : candidates()) {
    for (const double power : {1.0, -1.0}) {
      double left = 0;
      for (const Point& p : points_) {
        left += std::pow(std::log(p.ratio) - power * std::log(value(p.wo)), 2);
      }
      if (!(1 - left / total > best_fit)) continue;
      best_fit = 1 - left / total;
      char fit[16];
      std::snprintf(fit, sizeof fit, "%.3f", best_fit);
      best = "observed/expected = " + (power > 0 ? name : "1/(" + name + ")") + " (R² " + fit +
             " over the directions): factor " + name +
             (power > 0 ? " missing from pdf?" : " too many in pdf?");
    }
  }
  return best;
}

}  // namespace plumbline::verify
