#include "pairs/chi_square_look.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <plumbline/verify/detail/stopwatch.h>

#include "distributions.h"
#include "text.h"

namespace plumbline::verify {

namespace {

// Coarse to fine: 64 bins see what is wrong at large, the finest what is wrong in places.
constexpr int kCoarseDepth = 6;
constexpr int kDepthStep = 3;
constexpr double kSmallestExpected = 5;

/// A category with its expected and observed count enters the statistic.
void add_category(LevelTest& test, double expected, double observed) {
  if (expected <= 0) {
    if (observed > 0) test.statistic = std::numeric_limits<double>::infinity();
    return;
  }
  test.statistic += (observed - expected) * (observed - expected) / expected;
  ++test.degrees;
}

/// Adds bins; those with too little expected go to a pool, which is a category too, however small.
void add_bins(LevelTest& test, const BinTable& table) {
  double pool_expected = 0, pool_observed = 0;
  for (std::size_t i = 0; i < table.expected.size(); ++i) {
    const double expected = table.expected[i], observed = table.observed[i];
    const double pull = (observed - expected) / std::sqrt(std::max(expected, 1.0));
    if (std::abs(pull) > std::abs(test.worst_pull)) {
      test.worst_bin = i;
      test.worst_pull = pull;
    }
    if (expected > 0 && expected < kSmallestExpected) {
      pool_expected += expected;
      pool_observed += observed;
    } else {
      add_category(test, expected, observed);
    }
  }
  add_category(test, pool_expected, pool_observed);
}

LevelTest test_level(const BinnedPair& pair, int depth, double rejected_share) {
  const double n = static_cast<double>(pair.counts().drawn);
  LevelTest test;
  test.depth = depth;
  add_bins(test, table_of(pair, depth));
  for (const AtomCount& a : pair.counts().atoms) {
    add_category(test, n * a.atom.mass, static_cast<double>(a.drawn));
  }
  if (n * rejected_share >= kSmallestExpected) {
    add_category(test, n * rejected_share, static_cast<double>(pair.counts().rejected));
  }
  test.degrees = std::max(1.0, test.degrees - 1);
  test.p_value = chi_square_tail(test.statistic, test.degrees);
  return test;
}

std::vector<int> depths_of(int finest) {
  std::vector<int> depths;
  for (int d = std::min(kCoarseDepth, finest); d < finest; d += kDepthStep) depths.push_back(d);
  depths.push_back(finest);
  return depths;
}

}  // namespace

std::string place(const Vec3& x) {
  std::string text = "(";
  text += number(x[0]) + ", " + number(x[1]) + ", " + number(x[2]) + ")";
  return text;
}

BinTable table_of(const BinnedPair& pair, int depth) {
  const double n = static_cast<double>(pair.counts().drawn);
  const std::size_t bins = std::size_t{1} << depth;
  const int finer = pair.depth() - depth;
  BinTable table{std::vector<double>(bins), std::vector<double>(bins)};
  for (std::size_t i = 0; i < pair.expected().value.size(); ++i) {
    table.expected[i >> finer] += n * pair.expected().value[i];
    table.observed[i >> finer] += static_cast<double>(pair.counts().bins[i]);
  }
  return table;
}

ChiSquareLook::ChiSquareLook(const ContractOptions& options, const BinnedPair& pair,
                             const RejectedShare& rejected, double fail_level, double pass_level)
    : options_(options), pair_(pair), mass_(balance_mass(pair, rejected, fail_level / 2)) {
  const double rejected_share = mass_.expected_rejected(options.mass_tolerance + pair.rounding());
  for (const int depth : depths_of(pair.depth())) {
    levels_.push_back(test_level(pair, depth, rejected_share));
  }
  level_ = fail_level / 2 / static_cast<double>(levels_.size());
  const LevelTest& coarse = levels_.front();
  const double n = static_cast<double>(pair.counts().drawn);
  bound_ = std::sqrt(noncentrality_limit(coarse.statistic, coarse.degrees, pass_level) / n);
  // A deviation δ adds n δ² to the statistic, whose spread is then √(2 k + 4 n δ²): seen with 99 %
  // when n δ² − 2.33 √(2 k + 4 n δ²) reaches the gap between the critical value and k.
  const double k = coarse.degrees, z = normal_quantile(0.01);
  const double gap = chi_square_quantile(level_, k) - k;
  const double excess = gap + 2 * z * z + z * std::sqrt(4 * z * z + 4 * gap + 2 * k);
  detectable_ = std::sqrt(excess / n);
}

const LevelTest& ChiSquareLook::worst() const {
  return *std::min_element(
      levels_.begin(), levels_.end(),
      [](const LevelTest& a, const LevelTest& b) { return a.p_value < b.p_value; });
}

CheckResult ChiSquareLook::result() const {
  CheckResult r;
  const BinCounts& counts = pair_.counts();
  r.kind = CheckKind::chi_square;
  r.samples = counts.drawn;
  r.tolerance = options_.deviation;
  r.bound = bound_;
  r.detectable = detectable_;
  r.p_value = std::min(1.0, worst().p_value * static_cast<double>(levels_.size()));
  r.leaned_on = "certified bin integrals";
  r.figures = {{Figure::integral_of_pdf, pair_.expected().total},
               {Figure::integral_error, pair_.expected().total_error},
               {Figure::rejected, static_cast<double>(counts.rejected)},
               {Figure::atoms, static_cast<double>(counts.atoms.size())},
               {Figure::chi_square, worst().statistic},
               {Figure::degrees_of_freedom, worst().degrees},
               {Figure::bins, std::exp2(worst().depth)}};
  judge(r);
  return r;
}

void ChiSquareLook::judge(CheckResult& r) const {
  const BinCounts& counts = pair_.counts();
  const auto fail = [&r](const std::string& reason) {
    r.verdict = Verdict::fail;
    r.reason += (r.reason.empty() ? "" : "; ") + reason;
  };
  if (counts.not_finite > 0 || !pair_.expected().finite) {
    fail("a sampled point or the density is negative or not finite" +
         (counts.not_finite_at ? ", e.g. at " + place(*counts.not_finite_at) : std::string()));
  }
  if (counts.stray > 0) {
    fail(number(counts.stray) + " of " + number(counts.drawn) + " samples lie where the pdf is 0" +
         (counts.strays.empty() ? std::string() : ", e.g. at " + place(counts.strays.front())));
  }
  const double tolerance = options_.mass_tolerance + pair_.rounding();
  if (!(std::abs(mass_.excess()) <= tolerance + mass_.error())) {
    fail("∫pdf = " + number(mass_.integral) + ", atoms and rejected samples add " +
         number(mass_.atoms + mass_.rejected.value));
  }
  if (!(worst().p_value >= level_)) {
    const BinTable table = table_of(pair_, worst().depth);
    fail("of " + number(std::exp2(worst().depth)) + " bins, the one around " +
         place(pair_.center(worst().depth, worst().worst_bin)) + " holds " +
         number(table.observed[worst().worst_bin]) + " samples, expected " +
         number(table.expected[worst().worst_bin]));
  }
  if (r.verdict == Verdict::fail) return;
  if (!(pair_.expected().total_error <= options_.mass_tolerance)) {
    r.reason = "the bin integrals are known to " + number(pair_.expected().total_error) + " only";
  } else if (bound_ <= options_.deviation) {
    r.verdict = Verdict::pass;
  } else {
    r.reason =
        "neither a difference nor a deviation below " + number(options_.deviation) + " is proven";
  }
}

CheckResult run_chi_square(const ContractOptions& options, BinnedPair& binned,
                           const RejectedShare& rejected) {
  const LookPlan plan = plan_looks(options.first_look, options.samples, options.budget);
  CheckResult result;
  for (std::size_t look = 0; look < plan.samples.size(); ++look) {
    binned.draw(plan.samples[look] - binned.counts().drawn);
    result = ChiSquareLook(options, binned, rejected, plan.fail_level[look], plan.pass_level[look])
                 .result();
    if (result.verdict != Verdict::inconclusive) break;
  }
  result.subject = binned.pair().name + "/chi_square";
  result.seed = options.seed;
  return result;
}

CheckResult check_chi_square(const SamplingPair& pair, const ContractOptions& options) {
  if (options.finest_bins < 2 || !(options.deviation > 0)) {
    throw std::invalid_argument("chi-square check '" + pair.name +
                                "': needs at least 2 bins and a positive deviation to exclude");
  }
  const Stopwatch watch;
  BinnedPair binned(pair, options.finest_bins, options.mass_tolerance / 2, options.seed);
  CheckResult result = run_chi_square(options, binned, measure_rejected(pair, options.seed));
  result.seconds = watch.seconds();
  return result;
}

}  // namespace plumbline::verify
