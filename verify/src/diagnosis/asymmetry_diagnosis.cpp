#include "diagnosis/asymmetry_diagnosis.h"

#include <cmath>
#include <cstdio>
#include <functional>

#include "diagnosis/smith.h"

namespace plumbline::verify {

namespace {

constexpr double kGoodFit = 0.9;
constexpr std::size_t kEnoughPoints = 8;

struct Candidate {
  std::string formula, remark;
  std::function<double(const Asymmetry::Point&)> ratio;
};

std::vector<Candidate> candidates() {
  const auto cosines = [](const Asymmetry::Point& p) { return std::abs(p.wi[2] / p.wo[2]); };
  std::vector<Candidate> list = {
      {"cosθi/cosθo", "cosθi too often in f, the cosine applied twice?", cosines},
      {"cosθo/cosθi", "f divided by cosθi once too often?",
       [cosines](const Asymmetry::Point& p) { return 1 / cosines(p); }},
      {"η_i²/η_o²", "factor η_o²/η_i² missing from f across the refraction?",
       [](const Asymmetry::Point& p) { return p.eta_squared; }},
      {"η_o²/η_i²", "factor η_i²/η_o² missing from f across the refraction?",
       [](const Asymmetry::Point& p) { return 1 / p.eta_squared; }}};
  for (double alpha = 0.02; alpha <= 1.0; alpha *= 1.2) {
    char name[48];
    std::snprintf(name, sizeof name, "G1(wi)/G1(wo), GGX α≈%.2g", alpha);
    list.push_back({name, "G1(wo) missing from f?", [alpha](const Asymmetry::Point& p) {
                      return smith_g1(p.wi, alpha) / smith_g1(p.wo, alpha);
                    }});
    std::snprintf(name, sizeof name, "G1(wo)/G1(wi), GGX α≈%.2g", alpha);
    list.push_back({name, "G1(wi) missing from f?", [alpha](const Asymmetry::Point& p) {
                      return smith_g1(p.wo, alpha) / smith_g1(p.wi, alpha);
                    }});
  }
  return list;
}

}  // namespace

void Asymmetry::add(const Point& point) {
  if (point.ratio > 0 && std::isfinite(point.ratio)) points_.push_back(point);
}

std::string Asymmetry::diagnosis() const {
  double total = 0;
  for (const Point& p : points_) total += std::pow(std::log(p.ratio), 2);
  if (points_.size() < kEnoughPoints || !(total > 0)) return {};
  std::string best;
  double best_fit = kGoodFit;
  for (const Candidate& c : candidates()) {
    double left = 0;
    for (const Point& p : points_) left += std::pow(std::log(p.ratio) - std::log(c.ratio(p)), 2);
    if (!(1 - left / total > best_fit)) continue;
    best_fit = 1 - left / total;
    char fit[16];
    std::snprintf(fit, sizeof fit, "%.3f", best_fit);
    best = "f(wo, wi)/f(wi, wo) = " + c.formula + " (R² " + fit + "): " + c.remark;
  }
  return best;
}

}  // namespace plumbline::verify
