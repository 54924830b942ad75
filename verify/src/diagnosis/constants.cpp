#include <algorithm>
#include <cmath>

#include "diagnosis/direct.h"
#include "diagnosis/geometry.h"
#include "diagnosis/hypothesis.h"
#include "text.h"

namespace plumbline::verify {

namespace {

using Numbers = std::vector<std::vector<double>>;

/// Above the horizon or below it: for a BSDF, on the side of wo or through the surface.
bool beyond(const Place& p) { return has_wo(*p.view) ? transmits(p.wo, p.x) : p.x[2] < 0; }

std::string side_name(bool bsdf, bool other) {
  if (bsdf) return other ? "in transmission" : "in reflection";
  return other ? "below the horizon" : "above the horizon";
}

std::string constant_name(double c, double error) {
  const std::string usual = usual_constant(c, error);
  return usual.empty() ? number(c) : usual;
}

/// Samples that ought to be rejected, a share q, are drawn again: until one is accepted, or m − 1
/// times, which leaves q^m of them.
bool is_left_over(const MassSeen& mass) {
  constexpr int kMostDraws = 9;
  if (mass.rejected < 1e-6) return true;
  const double q = 1 - mass.integral;
  for (int m = 2; m <= kMostDraws; ++m) {
    const double error = mass.rejected_error + m * std::pow(q, m - 1) * mass.integral_error;
    if (std::abs(mass.rejected - std::pow(q, m)) <= error && error < q / 10) return true;
  }
  return false;
}

/// A density that is too small by its own lack of mass is one of samples that were drawn again
/// until they were accepted.
bool draws_again(const Observations& observations, const Numbers& numbers, double error) {
  bool lacks = false;
  for (std::size_t v = 0; v < numbers.size(); ++v) {
    const ViewEvidence& view = *observations.views()[v].view;
    if (!view.mass || view.mass->atoms > 0) return false;
    if (!is_left_over(*view.mass)) return false;
    if (view.stray_share > 0) return false;
    if (numbers[v][0] < -error) return false;
    lacks = lacks || numbers[v][0] > 2 * error;
  }
  // What is the same from everywhere is a constant, not what a horizon cuts off.
  double low = numbers.front()[0], high = low;
  for (const auto& of_view : numbers) {
    low = std::min(low, of_view[0]);
    high = std::max(high, of_view[0]);
  }
  return lacks && (numbers.size() == 1 || high - low > 2 * error);
}

/// The constant that the whole of one view asks for, by its masses or counts or exact ratios.
double constant_of(const Observations& observations) {
  const ViewObservations& v = observations.views()[observations.order().front()];
  if (!v.exact.empty()) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < v.exact.size(); i += 2) ratios.push_back(v.exact[i].ratio);
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    return *middle;
  }
  if (v.view->mass && v.view->mass->integral > 0) {
    const MassSeen& m = *v.view->mass;
    return (1 - m.atoms - m.rejected - v.view->stray_share) / m.integral;
  }
  double observed = 0, expected = 0;
  for (const CountedBin& b : v.bins) {
    observed += b.observed;
    expected += b.expected;
  }
  return observed / expected;
}

/// A constant is one only if the masses add up with it: else it is that of where samples fall, and
/// none fall elsewhere.
bool adds_up(const Observations& observations, double constant) {
  constexpr double kWithin = 0.02;
  for (const ViewObservations& v : observations.views()) {
    if (!v.judge_mass || !v.view->mass) continue;
    const MassSeen& m = *v.view->mass;
    const double sum = constant * m.integral + m.atoms + m.rejected + v.view->stray_share;
    const double error = constant * m.integral_error + m.rejected_error;
    if (std::abs(sum - 1) > kWithin + error) return false;
  }
  return true;
}

void add_everywhere(std::vector<Hypothesis>& list, const Blame& blame,
                    const Observations& observations, double error) {
  const double constant = constant_of(observations);
  const double nearest = nearest_usual_constant(constant);
  const std::string name = usual_constant(nearest, error);
  if (!name.empty()) {
    Hypothesis usual;
    usual.kind = CauseKind::constant;
    usual.prediction = [nearest](const Place& p, std::span<const double>) {
      return p.base * nearest;
    };
    usual.charge = [&observations, nearest](const Numbers&) -> std::optional<double> {
      if (!adds_up(observations, nearest)) return std::nullopt;
      return 0;
    };
    usual.words = [=](std::span<const double>) {
      return "constant factor " + name + " missing from " + blame.function + ": " +
             blame.numerator + " is " + name + " times as large everywhere";
    };
    list.push_back(std::move(usual));
  }
  Hypothesis h;
  h.kind = CauseKind::constant;
  h.starts = {{0.0}};
  if (constant > 0 && std::isfinite(constant)) h.starts.push_back({std::log(constant)});
  h.prediction = [](const Place& p, std::span<const double> n) { return p.base * std::exp(n[0]); };
  h.charge = [&observations, error](const Numbers& n) -> std::optional<double> {
    if (std::abs(n.front()[0]) <= error / 4) return std::nullopt;
    if (!adds_up(observations, std::exp(n.front()[0]))) return std::nullopt;
    return -kPerNumber / 2;
  };
  h.words = [=](std::span<const double> n) {
    const std::string c = constant_name(std::exp(n[0]), error);
    return "constant factor " + c + " missing from " + blame.function + ": " + blame.numerator +
           " is " + c + " times as large everywhere";
  };
  list.push_back(std::move(h));
}

void add_on_sides(std::vector<Hypothesis>& list, bool bsdf, const Blame& blame, double error) {
  for (const bool other : {false, true}) {
    Hypothesis h;
    h.kind = CauseKind::constant_per_hemisphere;
    h.starts = {{0.0}};
    h.complexity = 1;
    h.prediction = [other](const Place& p, std::span<const double> n) {
      return beyond(p) == other ? p.base * std::exp(n[0]) : p.base;
    };
    h.charge = [error](const Numbers& n) -> std::optional<double> {
      return usual_constant(std::exp(n.front()[0]), error).empty() ? 0 : -kPerNumber / 2;
    };
    h.words = [=](std::span<const double> n) {
      return "constant factor " + constant_name(std::exp(n[0]), error) + " missing from " +
             blame.function + " " + side_name(bsdf, other) + ", not " + side_name(bsdf, !other);
    };
    list.push_back(std::move(h));
  }
  // The shares of the two sides exchanged: a/b on one and b/a on the other. Where a mirrored
  // density says the same, it says more than is seen: that the sides have the same shape is all
  // that makes them look exchanged.
  Hypothesis exchanged;
  exchanged.kind = CauseKind::constant_per_hemisphere;
  exchanged.starts = {{0.5}, {-0.5}};
  exchanged.prediction = [](const Place& p, std::span<const double> n) {
    return p.base * std::exp(beyond(p) ? -n[0] : n[0]);
  };
  // Close to 1, counts cannot tell a/b and b/a from any two numbers.
  exchanged.charge = [least = 20 * error](const Numbers& n) -> std::optional<double> {
    if (std::abs(n.front()[0]) <= least) return std::nullopt;
    return 0.5 - kPerNumber;
  };
  exchanged.words = [=](std::span<const double> n) {
    return "the shares of the two sides are exchanged in " + blame.function + ": " +
           blame.numerator + " is " + number(std::exp(n[0])) + " times as large " +
           side_name(bsdf, false) + ", and " + number(std::exp(-n[0])) + " times " +
           side_name(bsdf, true);
  };
  list.push_back(std::move(exchanged));

  Hypothesis h;
  h.kind = CauseKind::constant_per_hemisphere;
  h.starts = {{0.0, 0.0}};
  h.prediction = [](const Place& p, std::span<const double> n) {
    return p.base * std::exp(n[beyond(p) ? 1 : 0]);
  };
  h.words = [=](std::span<const double> n) {
    return "constant factors missing from " + blame.function + ": " +
           constant_name(std::exp(n[0]), error) + " " + side_name(bsdf, false) + ", " +
           constant_name(std::exp(n[1]), error) + " " + side_name(bsdf, true);
  };
  list.push_back(std::move(h));
}

void add_by_view(std::vector<Hypothesis>& list, const Blame& blame,
                 const Observations& observations, bool both_sides, double error) {
  Hypothesis again;
  again.kind = CauseKind::not_rejected;
  again.starts = {{0.0}};
  again.per_view = true;
  again.prediction = [](const Place& p, std::span<const double> n) {
    return p.base * std::exp(n[0]);
  };
  again.charge = [&observations, error](const Numbers& n) -> std::optional<double> {
    if (!draws_again(observations, n, error)) return std::nullopt;
    return -kPerNumber * static_cast<double>(n.size()) + 20;
  };
  again.words = [blame](std::span<const double> n) {
    return "samples that ought to be rejected are drawn again, and " + blame.function +
           " does not know: it lacks 1/(accepted share), here " + number(std::exp(n[0]));
  };
  list.push_back(std::move(again));
  // A constant for each view explains whatever depends on wo alone, unless both sides show.
  if (!both_sides) return;

  // Reflection and transmission chosen with probabilities P and 1 − P that the density lacks.
  Hypothesis chosen;
  chosen.kind = CauseKind::lobe_probability;
  chosen.starts = {{-3.0}, {0.0}, {3.0}};
  chosen.per_view = true;
  chosen.complexity = 1;
  chosen.prediction = [](const Place& p, std::span<const double> n) {
    const double through = 1 / (1 + std::exp(-n[0]));
    return p.base * (beyond(p) ? through : 1 - through);
  };
  chosen.words = [blame](std::span<const double> n) {
    return "the probability of reflection (here " + number(1 / (1 + std::exp(n[0]))) +
           ") and that of transmission are missing from " + blame.function;
  };
  list.push_back(std::move(chosen));
  for (const bool other : {false, true}) {
    Hypothesis one;
    one.kind = CauseKind::lobe_probability;
    one.starts = {{0.0}};
    one.per_view = true;
    one.complexity = 2;
    one.prediction = [other](const Place& p, std::span<const double> n) {
      return beyond(p) == other ? p.base * std::exp(n[0]) : p.base;
    };
    // Sides that hold nothing, or all but nothing, are no matter of a probability.
    one.charge = [](const Numbers& n) -> std::optional<double> {
      constexpr double kMost = 7;
      for (const auto& of_view : n) {
        if (std::abs(of_view[0]) > kMost) return std::nullopt;
      }
      return 0;
    };
    one.words = [=](std::span<const double> n) {
      return std::string("the probability of ") + (other ? "transmission" : "reflection") +
             " is wrong in, or missing from, " + blame.function + ": by " + number(std::exp(n[0])) +
             " here";
    };
    list.push_back(std::move(one));
  }
}

/// Samples are rejected, or drawn again, and the density is that of the other.
void add_of_rejection(std::vector<Hypothesis>& list, const ReportEvidence& evidence,
                      const Blame& blame) {
  double rejected = 0, integral = 1;
  for (const ViewEvidence& v : evidence.views) {
    if (!v.mass || v.mass->atoms > 0 || v.stray_share > 0) return;
    rejected = std::max(rejected, v.mass->rejected);
    integral = std::min(integral, v.mass->integral);
  }
  constexpr double kSome = 1e-3;
  Hypothesis h;
  h.kind = CauseKind::not_rejected;
  h.complexity = 1.5;
  if (rejected > kSome) {
    h.prediction = [](const Place& p, std::span<const double>) {
      return p.base * (1 - p.view->mass->rejected);
    };
    h.words = [=](std::span<const double>) {
      return "samples are rejected, up to " + percent(rejected) + ", but " + blame.function +
             " is as large as if they were drawn again";
    };
    list.push_back(std::move(h));
  } else if (integral < 1 - kSome && integral > 0 &&
             takes_more_at_times(*evidence.views.front().pair)) {
    h.prediction = [](const Place& p, std::span<const double>) {
      return p.base / p.view->mass->integral;
    };
    h.words = [=](std::span<const double>) {
      return "samples are drawn again until they are accepted, and " + blame.function +
             " does not know: it adds up to " + number(integral) + ", that of all candidates";
    };
    list.push_back(std::move(h));
  }
}

}  // namespace

std::vector<Hypothesis> constant_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                            const Observations& observations) {
  std::vector<Hypothesis> list;
  const double error = error_of_constant(observations);
  const ViewEvidence& view = evidence.views.front();
  const bool bsdf = view.bsdf != nullptr && has_wo(view);
  add_everywhere(list, blame, observations, error);
  if (blame.function == "pdf()") add_of_rejection(list, evidence, blame);
  if (!view.pair->domain.directions()) return list;
  bool above = false, below = false;
  for (const ViewObservations& v : observations.views()) {
    for (const ExactPoint& p : v.exact) (beyond(p.place) ? below : above) = true;
    for (const CountedBin& b : v.bins) (beyond(b.nodes[0]) ? below : above) = true;
  }
  if (above && below) add_on_sides(list, bsdf, blame, error);
  if (bsdf) add_by_view(list, blame, observations, above && below, error);
  return list;
}

}  // namespace plumbline::verify
