#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "diagnosis/ask.h"
#include "diagnosis/direct.h"
#include "text.h"

namespace plumbline::verify {

namespace {

/// Samples between two heights that hold far more than the heights beside them.
struct Crowd {
  std::size_t from = 0, to = 0;  ///< of the samples by height
  double height = 0;
};

constexpr double kBeside = 8;  // widths on either side that are looked at

/// The fullest window of a width, if nearly nothing is beside it.
std::optional<Crowd> crowd_of(const std::vector<SampleRecord>& by_height, double width) {
  constexpr double kLeast = 0.004, kAround = 0.12;
  const auto height = [&by_height](std::size_t i) { return by_height[i].x[2]; };
  Crowd best;
  for (std::size_t from = 0, to = 0; from < by_height.size(); ++from) {
    while (to < by_height.size() && height(to) <= height(from) + width) ++to;
    if (to - from > best.to - best.from) best = {from, to, height(from)};
  }
  const auto inside = static_cast<double>(best.to - best.from);
  if (inside < kLeast * static_cast<double>(by_height.size())) return std::nullopt;
  std::size_t low = best.from, high = best.to;
  while (low > 0 && height(low - 1) > best.height - kBeside * width) --low;
  while (high < by_height.size() && height(high) < best.height + (1 + kBeside) * width) ++high;
  const double around = static_cast<double>(high - low) - inside;
  if (around > kAround * inside) return std::nullopt;
  return best;
}

Vec3 at_height(const Vec3& x, double z) {
  const double before = std::hypot(x[0], x[1]), after = std::sqrt(std::max(0.0, 1 - z * z));
  return {x[0] * after / before, x[1] * after / before, z};
}

/// The pdf knows nothing of a crowd: beside it, it is as dense.
bool is_unknown_to_pdf(const ViewEvidence& view, const std::vector<SampleRecord>& by_height,
                       const Crowd& crowd, double width) {
  constexpr double kAlike = 3;
  double alike = 0, tested = 0;
  const std::size_t step = std::max<std::size_t>(1, (crowd.to - crowd.from) / 50);
  for (std::size_t i = crowd.from; i < crowd.to; i += step) {
    const Vec3& x = by_height[i].x;
    if (!(std::hypot(x[0], x[1]) > 0)) continue;
    const double here = pdf_at(view, x);
    const double above = pdf_at(view, at_height(x, x[2] + kBeside / 2 * width));
    ++tested;
    alike += here < kAlike * above ? 1 : 0;
  }
  return tested > 10 && alike > 0.9 * tested;
}

}  // namespace

std::optional<Finding> find_samples_near_a_line(const ReportEvidence& evidence) {
  constexpr std::size_t kSamples = 10'000;
  constexpr double kHorizon = 0.05;
  for (const ViewEvidence* v : views_to_ask(evidence)) {
    if (!v->failed || !has_wo(*v) || !v->pair->domain.directions()) continue;
    std::vector<SampleRecord> samples = draw_samples(*v, kSamples);
    std::erase_if(samples, [](const SampleRecord& s) { return s.mass > 0; });
    std::sort(samples.begin(), samples.end(),
              [](const SampleRecord& a, const SampleRecord& b) { return a.x[2] < b.x[2]; });
    for (const double width : {1e-6, 1e-5, 1e-4, 5e-4}) {
      const auto crowd = crowd_of(samples, width);
      // Around the pole all heights are alike, and a lobe lies there.
      constexpr double kFarFromPole = 0.5;
      if (!crowd || std::abs(crowd->height) > kFarFromPole ||
          !is_unknown_to_pdf(*v, samples, *crowd, width))
        continue;
      const double share =
          static_cast<double>(crowd->to - crowd->from) / static_cast<double>(samples.size());
      const std::string some = percent(share) + " of the samples";
      if (std::abs(crowd->height) < kHorizon) {
        return Finding{CauseKind::not_rejected,
                       some + " lie within " + number(width) + " of the height " +
                           number(crowd->height) +
                           ", where pdf() is as it is above: what falls below the horizon is "
                           "lifted to it, not rejected"};
      }
      return Finding{CauseKind::on_a_line, some + " lie within " + number(width) +
                                               " of the height " + number(crowd->height) +
                                               ", where pdf() is as it is above: a clamp?"};
    }
  }
  return std::nullopt;
}

namespace {

/// The middles of the cells of a grid; of a set, its members.
std::vector<Vec3> points_of(const Domain& domain) {
  constexpr std::size_t kPerSide = 48, kMost = kPerSide * kPerSide;
  std::vector<Vec3> points;
  if (domain.dimension() == 0) {
    for (std::size_t i = 0; i < std::min(domain.size(), kMost); ++i) {
      points.push_back({static_cast<double>(i), 0, 0});
    }
    return points;
  }
  const auto middle = [](std::size_t i) { return (static_cast<double>(i) + 0.5) / kPerSide; };
  for (std::size_t i = 0; i < kMost; ++i) {
    points.push_back(domain.chart().from_square({middle(i % kPerSide), middle(i / kPerSide)}));
  }
  return points;
}

}  // namespace

std::optional<Finding> find_bad_density(const ReportEvidence& evidence) {
  constexpr double kGoodPart = 2e-3;
  // Where it is not a number it may be for what is wrong elsewhere too.
  constexpr double kLargePart = 1e-2;
  for (const ViewEvidence* v : views_to_ask(evidence)) {
    if (!v->failed) continue;
    const std::vector<Vec3> points = points_of(v->pair->domain);
    const auto all = static_cast<double>(points.size());
    double negative = 0, least = 0, most = 0, none = 0, example = 0;
    for (const double pdf : pdfs_at(*v, points)) {
      if (!std::isfinite(pdf)) {
        ++none;
        example = pdf;
        continue;
      }
      negative += pdf < 0 ? 1 : 0;
      least = std::min(least, pdf);
      most = std::max(most, pdf);
    }
    if (none > kLargePart * all) {
      return Finding{CauseKind::not_finite, "pdf() is " + number(example) + " in " +
                                                percent(none / all) + " of the domain"};
    }
    constexpr double kRounding = 1e-6;
    if (negative > kGoodPart * all && -least > kRounding * most) {
      return Finding{CauseKind::not_finite, "pdf() is negative, down to " + number(least) +
                                                ", in " + percent(negative / all) +
                                                " of the domain"};
    }
  }
  return std::nullopt;
}

}  // namespace plumbline::verify
