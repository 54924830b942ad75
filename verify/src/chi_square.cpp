#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <plumbline/verify/chi_square.h>

#include "binned_pair.h"
#include "distributions.h"
#include "text.h"

namespace plumbline::verify {

namespace {

// Coarse to fine: 64 bins see what is wrong at large, the finest what is wrong in places.
constexpr int kCoarseDepth = 6;
constexpr int kDepthStep = 3;
constexpr double kSmallestExpected = 5;

/// Chi-square statistic over the bins of one depth.
struct LevelTest {
  int depth = 0;
  double statistic = 0, degrees = 0, p_value = 1;
  std::size_t worst_bin = 0;
  double worst_pull = 0, worst_observed = 0, worst_expected = 0;
};

/// A category with its expected and observed count enters the statistic.
void add_category(LevelTest& test, double expected, double observed) {
  if (expected <= 0) {
    if (observed > 0) test.statistic = std::numeric_limits<double>::infinity();
    return;
  }
  test.statistic += (observed - expected) * (observed - expected) / expected;
  ++test.degrees;
}

struct Mass {
  double rejected = 0;  ///< expected share of rejected samples
  double excess = 0;    ///< Σ + rejected share − 1
  double allowed = 0;   ///< |excess| beyond this fails
};

/// The sampler may reject what the density leaves: 1 − ∫pdf, known to the mass tolerance only.
Mass judge_mass(const ChiSquareOptions& options, const BinnedPair& pair, double level) {
  const double n = static_cast<double>(pair.counts().drawn);
  const double share = static_cast<double>(pair.counts().rejected) / n;
  const double error = pair.expected().total_error + options.mass_tolerance;
  Mass mass;
  mass.excess = pair.expected().total + share - 1;
  mass.allowed = error + normal_quantile(level / 2) * std::sqrt(share * (1 - share) / n);
  mass.rejected =
      std::clamp(share, 1 - pair.expected().total - error, 1 - pair.expected().total + error);
  return mass;
}

LevelTest test_level(const BinnedPair& pair, int depth, const Mass& mass) {
  const double n = static_cast<double>(pair.counts().drawn);
  const std::size_t bins = std::size_t{1} << depth;
  const int finer = pair.depth() - depth;
  std::vector<double> expected(bins), observed(bins);
  for (std::size_t i = 0; i < pair.expected().value.size(); ++i) {
    expected[i >> finer] += n * pair.expected().value[i];
    observed[i >> finer] += static_cast<double>(pair.counts().bins[i]);
  }
  LevelTest test;
  test.depth = depth;
  double pool_expected = 0, pool_observed = 0;
  for (std::size_t i = 0; i < bins; ++i) {
    const double pull = (observed[i] - expected[i]) / std::sqrt(std::max(expected[i], 1.0));
    if (std::abs(pull) > std::abs(test.worst_pull)) {
      test.worst_bin = i;
      test.worst_pull = pull;
      test.worst_observed = observed[i];
      test.worst_expected = expected[i];
    }
    if (expected[i] > 0 && expected[i] < kSmallestExpected) {
      pool_expected += expected[i];
      pool_observed += observed[i];
    } else {
      add_category(test, expected[i], observed[i]);
    }
  }
  // What is left in the pool is a category too, however small.
  add_category(test, pool_expected, pool_observed);
  const double rejected = static_cast<double>(pair.counts().rejected);
  if (n * mass.rejected >= kSmallestExpected) add_category(test, n * mass.rejected, rejected);
  test.degrees = std::max(1.0, test.degrees - 1);
  test.p_value = chi_square_tail(test.statistic, test.degrees);
  return test;
}

std::string place(const Vec3& x) {
  std::string text = "(";
  text += number(x[0]) + ", " + number(x[1]) + ", " + number(x[2]) + ")";
  return text;
}

/// One look: all levels under one error level, then the verdict.
class Look {
 public:
  Look(const ChiSquareOptions& options, const BinnedPair& pair, double fail_level,
       double pass_level)
      : options_(options), pair_(pair), mass_(judge_mass(options, pair, fail_level / 2)) {
    for (int depth = std::min(kCoarseDepth, pair.depth()); depth <= pair.depth();
         depth += kDepthStep) {
      levels_.push_back(test_level(pair, depth, mass_));
    }
    level_ = fail_level / 2 / static_cast<double>(levels_.size());
    const LevelTest& coarse = levels_.front();
    const double n = static_cast<double>(pair.counts().drawn);
    const double limit = noncentrality_limit(coarse.statistic, coarse.degrees, pass_level);
    bound_ = std::sqrt(limit / n);
    // A deviation δ adds n δ² to the statistic, whose spread is then about √(2 k + 4 n δ²).
    const double k = coarse.degrees, z = normal_quantile(0.01);
    const double gap = chi_square_quantile(level_, k) - k;
    const double root = z + std::sqrt(z * z + gap + z * std::sqrt(2 * k));
    detectable_ = root / std::sqrt(n);
  }

  CheckResult result() const {
    CheckResult r;
    const BinCounts& counts = pair_.counts();
    const LevelTest& worst = *std::min_element(
        levels_.begin(), levels_.end(),
        [](const LevelTest& a, const LevelTest& b) { return a.p_value < b.p_value; });
    r.samples = counts.drawn;
    r.tolerance = options_.tolerance;
    r.bound = bound_;
    r.detectable = detectable_;
    r.p_value = std::min(1.0, worst.p_value * static_cast<double>(levels_.size()));
    r.leaned_on = "certified bin integrals";
    r.figures = {{"integral of the pdf", pair_.expected().total},
                 {"its error", pair_.expected().total_error},
                 {"rejected", static_cast<double>(counts.rejected)},
                 {"chi-square", worst.statistic},
                 {"degrees of freedom", worst.degrees},
                 {"bins", std::exp2(worst.depth)}};
    judge(worst, r);
    return r;
  }

 private:
  void judge(const LevelTest& worst, CheckResult& r) const {
    const BinCounts& counts = pair_.counts();
    if (counts.not_finite > 0 || !pair_.expected().finite) {
      fail(r, "a sampled point or the density is negative or not finite" +
                  (counts.not_finite_at ? ", e.g. at " + place(*counts.not_finite_at) : ""));
    } else if (counts.stray > 0) {
      fail(r, number(counts.stray) + " samples where the pdf is 0, e.g. at " +
                  place(*counts.stray_at));
    }
    if (!(std::abs(mass_.excess) <= mass_.allowed)) {
      fail(r, "the pdf integrates to " + number(pair_.expected().total) +
                  (counts.rejected > 0 ? ", rejected samples add " +
                                             number(1 + mass_.excess - pair_.expected().total)
                                       : ""));
    }
    if (!(worst.p_value >= level_)) {
      fail(r, "of " + number(std::exp2(worst.depth)) + " bins, the one around " +
                  place(pair_.center(worst.depth, worst.worst_bin)) + " holds " +
                  number(worst.worst_observed) + " samples, expected " +
                  number(worst.worst_expected));
    }
    if (r.verdict == Verdict::fail) return;
    if (!(pair_.expected().total_error <= options_.mass_tolerance)) {
      r.reason = "the bin integrals are known to " + number(pair_.expected().total_error) + " only";
    } else if (bound_ <= options_.tolerance) {
      r.verdict = Verdict::pass;
    } else {
      r.reason =
          "neither a difference nor a deviation below " + number(options_.tolerance) + " is proven";
    }
  }

  static void fail(CheckResult& r, const std::string& reason) {
    r.verdict = Verdict::fail;
    r.reason += (r.reason.empty() ? "" : "; ") + reason;
  }

  const ChiSquareOptions& options_;
  const BinnedPair& pair_;
  Mass mass_;
  std::vector<LevelTest> levels_;
  double level_ = 0;  // of one test
  double bound_ = 0, detectable_ = 0;
};

}  // namespace

CheckResult check_chi_square(const ChiSquareOptions& options, const SpherePair& pair) {
  if (options.finest_bins < 1 << kCoarseDepth || !(options.tolerance > 0)) {
    throw std::invalid_argument("chi-square check '" + options.subject +
                                "': needs at least 64 bins and a positive tolerance");
  }
  const ChartedPair charted{&sphere_chart(), pair.sample, pair.pdf_w};
  const int depth = std::ilogb(options.finest_bins);
  BinnedPair binned(charted, depth, options.mass_tolerance / 2, options.seed);
  const LookPlan plan = plan_looks(options.first_look, options.samples, options.budget);
  CheckResult result;
  for (std::size_t look = 0; look < plan.samples.size(); ++look) {
    binned.draw(plan.samples[look] - binned.counts().drawn);
    result = Look(options, binned, plan.fail_level[look], plan.pass_level[look]).result();
    if (result.verdict != Verdict::inconclusive) break;
  }
  result.check = "chi_square";
  result.subject = options.subject;
  result.expected = options.expected;
  result.seed = options.seed;
  return result;
}

}  // namespace plumbline::verify
