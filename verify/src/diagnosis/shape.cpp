#include "diagnosis/shape.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/hypothesis.h"
#include "diagnosis/parts.h"
#include "text.h"

namespace plumbline::verify {

double never_sampled(const ReportEvidence& evidence) {
  double never = 0;
  for (const ViewEvidence& v : evidence.views) never = std::max(never, share_never_sampled(v));
  return never;
}

std::optional<Finding> explain_atoms(const ReportEvidence& evidence, const Observations& density) {
  double atoms = 0;
  for (const ViewEvidence& v : evidence.views) {
    if (v.mass) atoms = std::max(atoms, v.mass->atoms);
  }
  if (!(atoms > 1e-9)) return std::nullopt;
  const auto left = [](const Place& p) { return p.view->mass ? 1 - p.view->mass->atoms : 1.0; };
  if (density.judge([left](const Place& p, auto) { return p.base * left(p); }).admissible) {
    return Finding{
        CauseKind::lobe_probability,
        "1 − F, the probability that the atoms leave to the rest, is missing from pdf()"};
  }
  if (density.judge([left](const Place& p, auto) { return p.base / left(p); }).admissible) {
    return Finding{CauseKind::lobe_probability,
                   "1 − F, the probability that the atoms leave to the rest, is there twice in "
                   "pdf()"};
  }
  const auto others = [left](const Place& p, auto) {
    return p.base * left(p) / std::max(1e-12, 1 - left(p));
  };
  if (density.judge(others).admissible) {
    return Finding{CauseKind::lobe_probability,
                   "the rest has the probability of the atoms in pdf(), in place of what they "
                   "leave to it"};
  }
  if (density.without_mass().judge(as_stated).admissible) {
    return Finding{CauseKind::atom_as_density,
                   "the mass that atoms state is not the share of samples that they get"};
  }
  return std::nullopt;
}

namespace {

std::string where_none_falls(double never) {
  return "no sample falls where " + percent(never) + " of pdf() is, and ";
}

}  // namespace

std::optional<Finding> explain_shape(const ReportEvidence& evidence, const Observations& density,
                                     double never) {
  double excess = 0;
  for (const ViewObservations& v : density.views()) {
    for (const CountedBin& b : v.bins) {
      excess = std::max(excess, (b.observed - b.expected) / std::sqrt(b.expected + 1));
    }
  }
  constexpr double kCertain = 7;
  // A number that chooses and is used again, wrongly, breaks symmetries just so.
  if (excess < kCertain && samples_break_a_symmetry(evidence) &&
      std::none_of(evidence.views.begin(), evidence.views.end(), [](const ViewEvidence& v) {
        return choice_is_used_again(*v.pair, parts_of(*v.pair));
      })) {
    return Finding{CauseKind::tangent_frame,
                   "samples lie unevenly to the left and right of the plane of incidence, where "
                   "pdf() is the same, and are nowhere denser than it says: they are drawn in "
                   "another tangent frame than the one that pdf() is for"};
  }
  // A part of a part lies in it.
  if (!(excess > kCertain) ||
      std::any_of(evidence.views.begin(), evidence.views.end(),
                  [](const ViewEvidence& v) { return v.stray_share > 0; })) {
    return std::nullopt;
  }
  const SamplingPair& pair = *evidence.views.front().pair;
  const Parts parts = parts_of(pair);
  // At least one part in as many of each is sampled.
  const double most = parts.borders.empty() ? 1 : 1 - 0.5 / static_cast<double>(parts.count());
  if (never > 0.02 && never <= most && choice_is_used_again(pair, parts)) {
    return Finding{CauseKind::numbers_reused,
                   where_none_falls(never) +
                       "more than expected elsewhere: a number that has chosen a part is used "
                       "again without being stretched to [0, 1)"};
  }
  return std::nullopt;
}

std::optional<Finding> explain_empty_places(const Observations& density, double never) {
  constexpr double kLeast = 0.2, kClose = 0.05;
  if (never < kLeast) return std::nullopt;
  Hypothesis denser;
  denser.needs_exact = true;
  denser.starts = {{0.0}};
  denser.prediction = [](const Place& p, std::span<const double> n) {
    return p.base * std::exp(n[0]);
  };
  const auto found = explain(density, {denser});
  if (found.empty()) return std::nullopt;
  const double times = std::exp(found.front().numbers.front().front());
  if (std::abs(times * (1 - never) - 1) > kClose) return std::nullopt;
  return Finding{CauseKind::support, where_none_falls(never) + "the rest is " + number(times) +
                                         " times as dense as it says"};
}

}  // namespace plumbline::verify
