#include "diagnosis/part_explanations.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>

#include "diagnosis/apart.h"
#include "diagnosis/ask.h"
#include "diagnosis/fit.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

// Views that are taken apart.
constexpr std::size_t kViews = 2;

using Maps = std::vector<std::unique_ptr<PartMap>>;

double residual(const Equation& e, const std::vector<double>& a) {
  double off = -1;
  for (std::size_t i = 0; i < a.size(); ++i) off += a[i] * e.parts[i].q;
  return off;
}

bool holds(const Equation& e, const std::vector<double>& a, double tolerance) {
  return std::abs(residual(e, a)) <= tolerance + 4 * e.error;
}

/// Least squares with weights, on every second equation.
std::vector<double> weighed(const std::vector<Equation>& equations, std::size_t parts,
                            const std::vector<double>& weight) {
  std::vector<std::vector<double>> normal(parts, std::vector<double>(parts));
  std::vector<double> right(parts);
  for (std::size_t k = 0; k < equations.size(); k += 2) {
    const Equation& e = equations[k];
    for (std::size_t i = 0; i < parts; ++i) {
      for (std::size_t j = 0; j < parts; ++j) {
        normal[i][j] += weight[k] * e.parts[i].q * e.parts[j].q;
      }
      right[i] += weight[k] * e.parts[i].q;
    }
  }
  for (std::size_t i = 0; i < parts; ++i) normal[i][i] *= 1 + 1e-13;
  return solve_definite(std::move(normal), std::move(right));
}

/// Least absolute deviations, then least squares of those that deviate little: what a missed branch
/// or a missing piece spoils is left aside.
std::vector<double> coefficients(const std::vector<Equation>& equations, std::size_t parts,
                                 double tolerance) {
  std::vector<double> weight(equations.size(), 1.0);
  std::vector<double> a = weighed(equations, parts, weight);
  constexpr int kSteps = 60;
  for (int step = 0; step < kSteps; ++step) {
    for (std::size_t k = 0; k < equations.size(); ++k) {
      weight[k] = 1 / std::max(std::abs(residual(equations[k], a)), tolerance / 100);
    }
    a = weighed(equations, parts, weight);
  }
  for (const double times : {100, 30, 10, 3}) {
    for (std::size_t k = 0; k < equations.size(); ++k) {
      weight[k] = std::abs(residual(equations[k], a)) < times * tolerance ? 1 : 0;
    }
    a = weighed(equations, parts, weight);
  }
  return a;
}

struct Solved {
  Parts parts;
  std::vector<double> a;
  double sum = 0;         ///< ∫ of Σ a q
  bool off = false;       ///< an a is not the share
  bool pieces = false;    ///< pdf() holds more than Σ a q at some points
  bool again = false;     ///< the number that chooses is used again
  bool apart = false;     ///< the parts hardly overlap: lights, texels
  bool by_sines = false;  ///< every a is its share times a sine, or divided by it
};

/// Sines of the angles from the three axes, on average over a part's samples.
Vec3 mean_sines(const PartMap& part) {
  constexpr int kSamples = 500;
  Random random = random_for(Stream::part_latitudes);
  Vec3 mean{};
  for (int i = 0; i < kSamples; ++i) {
    const auto s = part.map()(part.draw(random));
    if (!has_density(s)) continue;
    for (std::size_t d = 0; d < 3; ++d) {
      mean[d] += std::sqrt(std::max(0.0, 1 - s->x[d] * s->x[d])) / kSamples;
    }
  }
  return mean;
}

/// Every a is its share times the sine of the part's latitude, or divided by it.
bool lacks_sines(const Solved& solved, const Maps& maps) {
  constexpr std::size_t kFewest = 4;
  constexpr double kEven = 0.04, kUneven = 0.2;
  const std::size_t n = solved.parts.count();
  if (n < kFewest) return false;
  std::vector<Vec3> sines;
  for (const auto& part : maps) sines.push_back(mean_sines(*part));
  const auto spread = [&](std::size_t pole, double power) {
    double low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < n; ++i) {
      const double by = std::pow(sines[i][pole], power);
      const double ratio = std::log(std::max(1e-300, solved.a[i]) / solved.parts.share(i) / by);
      low = std::min(low, ratio);
      high = std::max(high, ratio);
    }
    return high - low;
  };
  if (spread(0, 0) < kUneven) return false;
  for (std::size_t pole = 0; pole < 3; ++pole) {
    if (spread(pole, 1) < kEven || spread(pole, -1) < kEven) return true;
  }
  return false;
}

}  // namespace

namespace {

bool misses(const PartThere& part) { return part.q == 0; }

std::optional<Solved> solve_view(const Apart& apart) {
  if (!apart.known() || !apart.fixed()) return std::nullopt;
  const ViewEvidence& view = apart.view();
  const SamplingPair& pair = *view.pair;
  const Maps& maps = apart.maps();
  const std::vector<Equation>& equations = apart.equations();
  Solved solved;
  solved.parts = apart.parts();
  const std::size_t parts = solved.parts.count();
  const double tolerance = tolerance_of_parts(pair);
  solved.a = coefficients(equations, parts, tolerance);
  // Every second equation has not been fitted.
  double tested = 0, missed = 0, beyond = 0;
  for (std::size_t k = 1; k < equations.size(); k += 2) {
    ++tested;
    const Equation& e = equations[k];
    if (holds(e, solved.a, tolerance)) continue;
    // A search misses what numbers next to 0 lead to, which is little.
    constexpr double kLittle = 5e-3;
    const bool lacks_a_part = std::any_of(e.parts.begin(), e.parts.end(), misses);
    const double off = residual(e, solved.a);
    if (lacks_a_part && std::abs(off) < kLittle) continue;
    (off < 0 && lacks_a_part ? beyond : missed) += 1;
  }
  constexpr double kMostBeyond = 0.4;
  if (missed > kMissed * tested || beyond > kMostBeyond * tested) return std::nullopt;
  const auto overlaps = std::count_if(equations.begin(), equations.end(), [](const Equation& e) {
    return std::count_if(e.parts.begin(), e.parts.end(), misses) + 1 <
           static_cast<std::ptrdiff_t>(e.parts.size());
  });
  solved.apart = 2 * static_cast<std::size_t>(overlaps) < equations.size();
  solved.pieces = beyond > 2 * kMissed * tested;
  for (std::size_t i = 0; i < parts; ++i) {
    solved.sum += solved.a[i] * maps[i]->accepted();
    if (std::abs(solved.a[i] - solved.parts.share(i)) > 20 * tolerance) solved.off = true;
    solved.again = solved.again || maps[i]->uses_chooser();
  }
  solved.by_sines = pair.domain.directions() && !has_wo(view) && lacks_sines(solved, maps);
  return solved;
}

std::string listed(const std::vector<double>& numbers) {
  std::string text;
  for (const double n : numbers)
    text += (text.empty() ? "" : ", ") + number(std::round(1e4 * n) / 1e4);
  return text;
}

}  // namespace

PartExplanations::PartExplanations(const ReportEvidence& evidence) : evidence_(evidence) {}
PartExplanations::~PartExplanations() = default;

const std::vector<std::unique_ptr<Apart>>& PartExplanations::views() {
  if (looked_) return views_;
  looked_ = true;
  // What passes says where a fault does not show, which tells a constant from a function of wo.
  for (const bool failed : {true, false}) {
    for (const ViewEvidence& v : evidence_.views) {
      if (v.failed != failed || !v.mass || views_.size() == kViews) continue;
      views_.push_back(std::make_unique<Apart>(v));
      if (!views_.back()->known()) return views_;
    }
  }
  return views_;
}

std::size_t PartExplanations::views_known() {
  return static_cast<std::size_t>(std::count_if(views().begin(), views().end(),
                                                [](const auto& apart) { return apart->known(); }));
}

Observations PartExplanations::with_exact(const Observations& density) {
  std::vector<ExactOfView> exact;
  for (const auto& apart : views()) {
    if (apart->known()) exact.push_back({&apart->view(), apart->densities()});
  }
  return exact.empty() ? density : density.with_points(exact, kMissed);
}

bool PartExplanations::contradict(const Explanation& e) {
  // Numbers that were fitted to counts are right to a few percent only.
  constexpr double kFitted = 0.03;
  for (const auto& apart : views()) {
    if (!apart->known()) continue;
    const ViewEvidence& view = apart->view();
    const auto at = static_cast<std::size_t>(&view - evidence_.views.data());
    const double tolerance = e.numbers[at].empty() ? tolerance_of_parts(*view.pair) : kFitted;
    double tested = 0, off = 0;
    for (const Equation& q : apart->equations()) {
      const double density = q.sum() * q.pdf;
      const Place place{&view, view.wo.value_or(Vec3{}), q.x, q.pdf};
      const double predicted = e.hypothesis->prediction(place, e.numbers[at]);
      if (predicted == kNothingSaid) continue;
      ++tested;
      off += std::abs(predicted / density - 1) <= tolerance + 4 * q.error ? 0 : 1;
    }
    if (off > 2 * kMissed * tested) return true;
  }
  return false;
}

namespace {

/// Whether pdf() has other weights than the parts' shares, and the same ones for each of several
/// views: a number of the code, not a function of the directions that looks like one.
bool steady(const std::vector<Solved>& views, double tolerance) {
  if (views.size() < 2) return false;
  for (const Solved& v : views) {
    if (v.a.size() != views.front().a.size()) return false;
    for (std::size_t i = 0; i < v.a.size(); ++i) {
      if (std::abs(v.a[i] - views.front().a[i]) > tolerance) return false;
    }
  }
  return true;
}

/// A part has no weight and another has more than its share: pdf() may have the other's form for
/// both, and says nothing of probabilities.
bool takes_another_form(const Solved& solved) {
  constexpr double kNone = 1e-3, kKnown = 0.02;
  bool none = false, more = false;
  for (std::size_t i = 0; i < solved.a.size(); ++i) {
    none = none || solved.a[i] < kNone;
    more = more || solved.a[i] > solved.parts.share(i) + kKnown;
  }
  return none && more;
}

/// One part's density with π too often or not at all, the others being right: no probability.
std::optional<Finding> lone_constant(const Solved& solved) {
  constexpr double kKnown = 2e-3;
  std::optional<std::size_t> off;
  for (std::size_t i = 0; i < solved.a.size(); ++i) {
    if (std::abs(solved.a[i] - solved.parts.share(i)) < kKnown) continue;
    if (off) return std::nullopt;
    off = i;
  }
  if (!off || !(solved.a[*off] > 0)) return std::nullopt;
  const double share = solved.parts.share(*off);
  const std::string c = usual_constant(share / solved.a[*off], kKnown);
  if (c.find("π") == std::string::npos) return std::nullopt;
  return Finding{CauseKind::constant,
                 "constant factor " + c +
                     " missing from pdf() of the part that is chosen with probability " +
                     listed({share})};
}

}  // namespace

std::optional<Finding> PartExplanations::by_parts(bool only_steady) {
  std::optional<Solved> shown;
  std::vector<Solved> all;
  bool complete = true;
  for (const auto& apart : views()) {
    const ViewEvidence& v = apart->view();
    const auto solved = solve_view(*apart);
    if (!solved && v.failed) return std::nullopt;
    if (!solved) continue;
    all.push_back(*solved);
    if (!solved->off) continue;
    constexpr double kKnown = 0.02;
    complete = complete && !solved->pieces &&
               std::abs(solved->sum - v.mass->integral) < kKnown * std::max(1.0, solved->sum);
    if (!shown) shown = solved;
  }
  if (!shown) return std::nullopt;
  steady_ = steady(all, 20 * tolerance_of_parts(*evidence_.views.front().pair));
  if (only_steady && !steady_) return std::nullopt;
  std::vector<double> shares;
  for (std::size_t i = 0; i < shown->parts.count(); ++i) shares.push_back(shown->parts.share(i));
  const std::string chosen = "a random number chooses one of " + number(double(shares.size())) +
                             " parts with probabilities " + listed(shares);
  const ViewEvidence& view = evidence_.views.front();
  if (view.pair->domain.directions() && !has_wo(view)) {
    if (shown->by_sines) {
      return Finding{CauseKind::sine, chosen + ", but pdf() weighs their densities by " +
                                          listed(shown->a) +
                                          ": sinθ of the rows is missing from one of them"};
    }
    const auto none =
        std::find_if(shown->a.begin(), shown->a.end(), [](double a) { return std::abs(a) < 1e-3; });
    if (none != shown->a.end()) {
      return Finding{CauseKind::chosen_lobe_only,
                     chosen + ", but pdf() leaves out that of probability " +
                         number(shares[static_cast<std::size_t>(none - shown->a.begin())]) +
                         " wherever another lies in the same direction"};
    }
  }
  if (complete) {
    if (const auto f = lone_constant(*shown)) return f;
    if (takes_another_form(*shown)) return std::nullopt;
    return Finding{
        shown->apart && !has_wo(view) ? CauseKind::choice_probability : CauseKind::lobe_probability,
        chosen + ", but pdf() weighs their densities by " + listed(shown->a)};
  }
  if (!shown->again) return std::nullopt;
  // Parts of parts: each weighs its share times that of the piece, the share again. One other
  // number for all is what is left where a part is never chosen.
  double low = 1e300, high = 0, share = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    low = std::min(low, shown->a[i] / shares[i]);
    high = std::max(high, shown->a[i] / shares[i]);
    share = std::max(share, shares[i]);
  }
  if (high - low < 1e-3 * high && high > 1.2 * share && !shown->pieces) {
    return Finding{CauseKind::support, chosen + ", which is " + percent(high) +
                                           " of pdf(): where the rest of it is, no sample falls"};
  }
  return Finding{CauseKind::numbers_reused,
                 chosen +
                     " and is used again in it without being stretched to [0, 1): pdf() "
                     "has densities of whole parts, of which samples take a piece"};
}

std::optional<Finding> explain_by_branches(const ReportEvidence& evidence) {
  double several = 0, matching = 0, tested = 0;
  std::size_t looked_at = 0;
  for (const ViewEvidence& v : evidence.views) {
    const SamplingPair& pair = *v.pair;
    if (!v.failed || looked_at == kViews) continue;
    ++looked_at;
    if (!can_be_taken_apart(pair) || !pair.domain.directions()) return std::nullopt;
    const Parts whole{0, {0, 1}};
    const PartMap map(pair, whole, 0);
    if (!map.usable()) return std::nullopt;
    const double tolerance = tolerance_of_parts(pair);
    constexpr std::size_t kPoints = 150;
    Random random = random_for(Stream::branch_points);
    std::vector<Uniforms> u;
    while (u.size() < kPoints) u.push_back(map.draw(random));
    const std::vector<Vec3> points = points_of_density(ask(map.map(), u));
    const std::vector<double> pdfs = ask(pair.pdf, points);
    std::vector<BranchSearch::Target> targets;
    for (const Vec3& x : points) targets.push_back({x, std::nullopt});
    const auto all_ways = map.ways(targets);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Ways& ways = all_ways[i];
      if (!ways || ways->empty()) continue;
      ++tested;
      several += ways->size() > 1 ? 1 : 0;
      matching += std::any_of(ways->begin(), ways->end(), [&](const WayThere& w) {
        return std::abs(w.density.value / pdfs[i] - 1) <= tolerance + 4 * w.density.relative_error;
      });
    }
  }
  constexpr double kFewest = 6;
  if (several < kFewest || matching < (1 - kMissed) * tested) return std::nullopt;
  return Finding{CauseKind::not_rejected,
                 "samples come to the same point twice, by different random numbers, and pdf() "
                 "knows one way only: those that ought to be rejected are folded back or drawn "
                 "again (seen at " +
                     number(several) + " of " + number(tested) + " points)"};
}

}  // namespace plumbline::verify
