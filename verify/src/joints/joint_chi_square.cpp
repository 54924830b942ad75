#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <plumbline/verify/detail/stopwatch.h>

#include "distributions.h"
#include "joints/joint_checks.h"
#include "text.h"

namespace plumbline::verify {

namespace {

// A pass may leave so much of the mass to places where nothing but own samples shows the density.
constexpr double kMostOnOwnSamples = 0.02;
// Masses are estimates, and the statistic knows their variance: a bin is tested as long as that
// adds no more than half to the variance of its count.
constexpr double kErrorOfJointMass = 0.5;

/// Upper limit of the deviation of the samples' density from the pdf, root mean square over bins.
///
/// Of a bin with a deviation δ, observed − expected has the mean m δ and the variance of the count
/// and of the expected, m + v ≤ (1 + ρ) m. The sum of its squares over m + v is about a noncentral
/// chi-square variable, and Σ m δ² at most 1 + ρ times its noncentrality.
///
/// @param largest  count that one random node stands for: a few more or less may have been missed
double limit_of_deviation(const BinTable& table, double n, double largest, double level) {
  double statistic = 0, bins = 0, most = 0;
  for (std::size_t i = 0; i < table.expected.size(); ++i) {
    const double expected = table.expected[i];
    if (!(expected > 0)) continue;
    const double variance = table.variance[i] + largest * largest * std::log(1 / level);
    statistic += std::pow(table.observed[i] - expected, 2) / (expected + variance);
    most = std::max(most, variance / expected);
    bins += 1;
  }
  if (!std::isfinite(statistic) || !std::isfinite(most)) {
    return std::numeric_limits<double>::infinity();
  }
  // Variances are rather too large than too small: no use is made of a statistic that is small.
  const double degrees = std::max(1.0, bins - 1);
  const double noncentrality = noncentrality_limit(std::max(statistic, degrees), degrees, level);
  return std::sqrt((1 + most) * noncentrality / n);
}

class JointLook {
 public:
  JointLook(const JointBins& bins, const CountedShare& rejected, const ContractOptions& options,
            double fail_level, double pass_level)
      : bins_(bins), options_(options), mass_{bins.expected().integral, rejected} {
    const double n = static_cast<double>(bins.counts().drawn);
    const std::vector<int> depths = depths_of(bins.depth());
    for (const int depth : depths) {
      levels_.push_back(test_level(bins.table(depth), depth, n, kErrorOfJointMass));
    }
    level_ = fail_level / 2 / static_cast<double>(levels_.size());
    excess_error_ = mass_.error(fail_level / 2);
    const LevelTest& coarse = levels_.front();
    bound_ = limit_of_deviation(bins.table(coarse.depth), n, n * mass_.integral.largest_term,
                                pass_level);
    detectable_ = detectable_deviation(coarse.degrees, level_, n);
  }

  CheckResult result() const {
    const JointCounts& counts = bins_.counts();
    const CubeMass& expected = bins_.expected();
    CheckResult r;
    r.kind = CheckKind::chi_square;
    r.samples = counts.drawn;
    r.tolerance = options_.deviation;
    r.bound = bound_;
    r.detectable = detectable_;
    r.p_value = std::min(1.0, worst().p_value * static_cast<double>(levels_.size()));
    r.leaned_on = "bin masses estimated at random nodes, their variance in the statistic";
    r.figures = {{Figure::integral_of_pdf, expected.integral.total},
                 {Figure::rejected, static_cast<double>(counts.rejected)},
                 {Figure::chi_square, worst().statistic},
                 {Figure::degrees_of_freedom, worst().degrees},
                 {Figure::bins, std::exp2(worst().depth)},
                 {Figure::unresolved_share, levels_.front().unresolved},
                 {"unresolved in the finest bins", levels_.back().unresolved},
                 {"mass that rests on own samples", expected.rests_on_own},
                 {"standard deviation of the masses", error_of_masses()}};
    judge(r);
    return r;
  }

 private:
  /// Of the coarsest bins, relative, root mean square.
  double error_of_masses() const {
    const double n = static_cast<double>(bins_.counts().drawn);
    const BinTable table = bins_.table(levels_.front().depth);
    double sum = 0;
    for (std::size_t i = 0; i < table.expected.size(); ++i) {
      if (table.expected[i] > 0) sum += table.variance[i] / table.expected[i] / n;
    }
    return std::sqrt(sum);
  }

  const LevelTest& worst() const {
    return *std::min_element(
        levels_.begin(), levels_.end(),
        [](const LevelTest& a, const LevelTest& b) { return a.p_value < b.p_value; });
  }

  void judge(CheckResult& r) const {
    const JointCounts& counts = bins_.counts();
    const JointPair& pair = bins_.pair();
    const auto fail = [&r](const std::string& reason) {
      r.verdict = Verdict::fail;
      r.reason += (r.reason.empty() ? "" : "; ") + reason;
    };
    if (counts.not_finite > 0 || !mass_.integral.finite) {
      fail("a sampled point or the density is negative or not finite" +
           (counts.not_finite_at ? ", e.g. at " + place(pair, *counts.not_finite_at)
                                 : std::string()));
    }
    if (counts.stray > 0) {
      fail(number(counts.stray) + " of " + number(counts.drawn) +
           " samples lie where the pdf is 0, e.g. at " + place(pair, *counts.stray_at));
    }
    if (!(std::abs(mass_.excess()) <=
          joint_mass_tolerance(options_) + bins_.rounding() + excess_error_)) {
      fail("∫pdf = " + number(mass_.integral.total) + ", with rejected samples " +
           number(1 + mass_.excess()));
    }
    if (!(worst().p_value >= level_)) {
      const LevelTest& test = worst();
      const BinTable table = bins_.table(test.depth);
      fail("of " + number(std::exp2(test.depth)) + " bins, the one around " +
           place(pair, bins_.center(test.depth, test.worst_bin)) + " holds " +
           number(table.observed[test.worst_bin]) + " samples, expected " +
           number(table.expected[test.worst_bin]));
    }
    if (bins_.on_lines() > 0) {
      fail("at least " + number(std::round(1e4 * bins_.on_lines()) / 100) +
           " % of the samples have a coordinate in common with many others");
    }
    if (r.verdict == Verdict::fail) return;
    const double on_own = bins_.expected().rests_on_own;
    if (on_own > kMostOnOwnSamples) {
      r.bound.reset();
      r.reason = "the density is so narrow that " + number(on_own) +
                 " of its mass is shown by its own samples alone";
      r.advice =
          "state where the density jumps (Domain::with_breaks of a factor), allow more "
          "`evaluations`, or check one factor at a time, given the others";
    } else if (bound_ <= options_.deviation) {
      r.verdict = Verdict::pass;
    } else {
      r.reason =
          "neither a difference nor a deviation below " + number(options_.deviation) + " is proven";
      r.advice = error_of_masses() > options_.deviation / 6 ? "allow more `evaluations`"
                                                            : "allow more `samples`";
    }
  }

  const JointBins& bins_;
  const ContractOptions& options_;
  JointBalance mass_;
  std::vector<LevelTest> levels_;
  double level_ = 0, excess_error_ = 0, bound_ = 0, detectable_ = 0;
};

}  // namespace

CheckResult run_joint_chi_square(JointBins& bins, const CountedShare& rejected,
                                 const ContractOptions& options) {
  const LookPlan plan = plan_looks(options.first_look, options.samples, options.budget);
  CheckResult result;
  for (std::size_t look = 0; look < plan.samples.size(); ++look) {
    bins.draw(plan.samples[look] - bins.counts().drawn);
    result =
        JointLook(bins, rejected, options, plan.fail_level[look], plan.pass_level[look]).result();
    if (result.verdict != Verdict::inconclusive) break;
  }
  result.subject = bins.pair().name + "/chi_square";
  result.seed = options.seed;
  return result;
}

CheckResult check_chi_square(const JointPair& pair, const ContractOptions& options) {
  require_usable(pair, options);
  const Stopwatch watch;
  JointBins bins(pair, options);
  CheckResult result = run_joint_chi_square(bins, bins.rejected(), options);
  result.seconds = watch.seconds();
  return result;
}

}  // namespace plumbline::verify
