#include "diagnosis/strays.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "diagnosis/geometry.h"
#include "diagnosis/hypothesis.h"
#include "text.h"

namespace plumbline::verify {

namespace {

/// Whether a prediction holds, with what sampling leaves uncertain of a share of strays.
bool agrees_within(const Observations& observations, const Prediction& prediction) {
  Hypothesis h;
  h.kind = CauseKind::not_rejected;
  h.starts = {{0.0}};
  h.prediction = [&prediction](const Place& p, std::span<const double> n) {
    return prediction(p, n) * std::exp(n[0]);
  };
  const auto found = explain(observations.without_mass(), {h});
  if (found.empty()) return false;
  constexpr double kUncertain = 0.02;
  return std::abs(found.front().numbers.front()[0]) < kUncertain;
}

/// Samples beside the domain itself, and those in it thinner by just their share: what fell
/// outside should have been folded back, or drawn again.
std::optional<Cause> of_overshoot(const ReportEvidence& evidence, const Observations& inside,
                                  double strays, double share) {
  double outside = 0;
  for (const ViewEvidence& v : evidence.views) {
    if (v.pair->domain.dimension() == 0 || v.pair->domain.directions()) return std::nullopt;
    for (const Vec3& x : v.strays) outside += v.pair->domain.chart().distance(x) > 1e-5 ? 1 : 0;
  }
  if (outside < 0.98 * strays) return std::nullopt;
  const Prediction thinner = [](const Place& p, std::span<const double>) {
    return p.base * (1 - p.view->stray_share);
  };
  const std::string some = number(std::round(100 * share));
  if (agrees_within(inside, thinner)) {
    return Cause{CauseKind::not_rejected,
                 some +
                     " % of the samples lie outside the domain, and those inside are thinner by "
                     "that share: they ought to be folded back or rejected",
                 {},
                 CauseKind::none};
  }
  return Cause{
      CauseKind::support, some + " % of the samples lie outside the domain", {}, CauseKind::none};
}

}  // namespace

bool all_rejected(const ReportEvidence& evidence) {
  constexpr double kAll = 0.9999;
  return std::any_of(evidence.views.begin(), evidence.views.end(), [](const ViewEvidence& v) {
    return v.failed && v.mass && v.mass->rejected > kAll;
  });
}

std::optional<Cause> explain_strays(const ReportEvidence& evidence, const Observations& density) {
  double strays = 0, beyond = 0, share = 0;
  for (const ViewEvidence& v : evidence.views) {
    share = std::max(share, v.stray_share);
    for (const Vec3& x : v.strays) {
      ++strays;
      const bool other = has_wo(v) ? transmits(*v.wo, x) : x[2] < 0;
      beyond += v.pair->domain.directions() && other ? 1 : 0;
    }
  }
  // All of them: samples lie on the other side, or somewhere else.
  constexpr double kAll = 0.98;
  if (strays == 0 || share > kAll) return std::nullopt;
  const Observations inside = density.without_strays();
  if (!inside.judge(as_stated).admissible) return of_overshoot(evidence, inside, strays, share);
  const std::string some = percent(share) + " of the samples";
  // At most about half of a reflected lobe lies below the horizon, at grazing angles.
  constexpr double kMostBelow = 0.6;
  if (beyond > 0.98 * strays && share < kMostBelow) {
    return Cause{CauseKind::not_rejected,
                 "samples below the horizon are not rejected: up to " + some +
                     " lie where pdf() is 0, and the rest are as dense as it says",
                 {},
                 CauseKind::none};
  }
  return Cause{CauseKind::support,
               "the support of pdf() is too small: up to " + some + " lie outside it",
               {},
               CauseKind::none};
}

}  // namespace plumbline::verify
