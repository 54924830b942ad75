#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/detail/stopwatch.h>

#include "dependent/point_sets.h"
#include "distributions.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr std::size_t kBins = 64, kBinsAcross = 8;
// 32 of each bin: its count is nearly normal, and the tails of 64 together are Pearson's.
constexpr std::uint64_t kFewestReplicates = 32 * kBins;

/// Over the replicates: one point in one dimension, or in a pair of neighbouring ones.
struct Marginal {
  std::size_t point = 0, dimension = 0;
  bool pair = false;
  std::array<std::uint64_t, kBins> counts{};

  void count(const PointSet& set) {
    const double x = set.at(point, dimension);
    if (pair) {
      const double y = set.at(point, dimension + 1);
      ++counts[static_cast<std::size_t>(x * kBinsAcross) * kBinsAcross +
               static_cast<std::size_t>(y * kBinsAcross)];
    } else {
      ++counts[static_cast<std::size_t>(x * kBins)];
    }
  }

  double chi_square(double replicates) const {
    const double expected = replicates / kBins;
    double sum = 0;
    for (const std::uint64_t n : counts) {
      const double off = static_cast<double>(n) - expected;
      sum += off * off / expected;
    }
    return sum;
  }

  std::string name() const {
    return "point " + number(point) + " in dimension " + number(dimension) +
           (pair ? " and the next" : "");
  }
};

std::vector<Marginal> marginals_of(const PointSets& sets, std::size_t points) {
  std::vector<Marginal> marginals;
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t d = 0; d < sets.dimensions; ++d) {
      marginals.push_back({i, d, false, {}});
      if (d + 1 < sets.dimensions) marginals.push_back({i, d, true, {}});
    }
  }
  return marginals;
}

/// The marginal that is worst, judged for all.
void judge_worst(const std::vector<Marginal>& marginals, const ReplicateOptions& o,
                 CheckResult& r) {
  const auto n = static_cast<double>(o.replicates);
  const auto tests = static_cast<double>(marginals.size());
  const auto worst = std::max_element(
      marginals.begin(), marginals.end(),
      [n](const Marginal& a, const Marginal& b) { return a.chi_square(n) < b.chi_square(n); });
  constexpr double kDegrees = kBins - 1;
  const double statistic = worst->chi_square(n);
  // The correction for Poisson counts makes the tail a little wider than that of counts whose sum
  // is known.
  r.p_value = std::min(1.0, tests * pearson_tail(statistic, kDegrees, kBins * kBins / n));
  r.bound = std::sqrt(noncentrality_limit(statistic, kDegrees, o.budget.pass_level() / tests) / n);
  r.tolerance = o.deviation;
  r.leaned_on = "independent replicates";
  r.figures = {{Figure::chi_square, statistic},
               {Figure::degrees_of_freedom, kDegrees},
               {Figure::bins, static_cast<double>(kBins)}};
  if (!(*r.p_value > o.budget.fail_level())) {
    r.verdict = Verdict::fail;
    r.reason = worst->name() + " is not uniform over the replicates";
  } else if (*r.bound <= o.deviation) {
    r.verdict = Verdict::pass;
  } else {
    r.reason = worst->name() + ": no deviation below " + number(o.deviation) + " is proven";
    r.advice = "allow more `replicates`";
  }
}

}  // namespace

CheckResult check_replicates(const PointSets& sets, const ReplicateOptions& options) {
  if (options.points == 0 || options.replicates < kFewestReplicates || !(options.deviation > 0)) {
    throw std::invalid_argument("replicates of '" + sets.name +
                                "': need points, 2048 replicates and a deviation to exclude");
  }
  const Stopwatch watch;
  CheckResult r;
  std::vector<Marginal> marginals = marginals_of(sets, options.points);
  const std::uint64_t first = first_replicate(options.seed);
  for (std::uint64_t i = 0; i < options.replicates; ++i) {
    const PointSet set(sets, first + i, options.points);
    r.samples += set.size();
    const std::string outside = set.outside();
    if (!outside.empty()) {
      r.verdict = Verdict::fail;
      r.reason = "replicate " + number(first + i) + ": " + outside;
      break;
    }
    for (Marginal& m : marginals) m.count(set);
  }
  if (r.verdict != Verdict::fail) judge_worst(marginals, options, r);
  r.kind = CheckKind::replicates;
  r.subject = sets.name + "/replicates";
  r.seed = options.seed;
  r.seconds = watch.seconds();
  return r;
}

}  // namespace plumbline::verify
