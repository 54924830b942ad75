#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <plumbline/verify/detail/stopwatch.h>

#include "distributions.h"
#include "pairs/chi_square_look.h"
#include "pairs/integral_check.h"
#include "text.h"

namespace plumbline::verify {

namespace {

// Coarse to fine: 64 bins see what is wrong at large, the finest what is wrong in places.
constexpr int kCoarseDepth = 6;
constexpr int kDepthStep = 3;
// Below that the normal approximation of a count is too far off in its tails: pooled, and the pool
// is tested exactly.
constexpr double kSmallestExpected = 20;
// So few categories can be tested exactly, one by one; in a sum of so few the tails of each matter.
constexpr std::size_t kFewCategories = 16;
// A bin whose mass is known so badly that it adds a tenth to the variance of its count says little.
constexpr double kErrorOfMass = 0.1;
// A pass may leave so much of the mass to bins that are not resolved.
constexpr double kMostUnresolved = 0.02;
constexpr double kMostAtomsTested = 64;

struct Category {
  double expected = 0, variance = 0, observed = 0;  // variance: of `expected`
  double rounding = 0;                              // variance: by where samples are rounded to

  void add(const Category& c) {
    expected += c.expected;
    variance += c.variance;
    observed += c.observed;
    rounding += c.rounding;
  }
  bool resolved(double error_of_mass) const { return variance <= error_of_mass * expected; }
  double pull() const {
    return (observed - expected) / std::sqrt(std::max(expected, 1.0) + variance + rounding);
  }
};

/// The categories of one depth, sorted by how they can be tested.
struct Categories {
  double error_of_mass = 0;     // that counts as known, see test_level
  std::vector<Category> large;  // enough expected, and well known
  Category small, unresolved;   // pools
  bool impossible = false;      // samples where nothing is expected

  void add(const Category& c) {
    if (c.expected <= 0 && c.variance <= 0) {
      impossible = impossible || c.observed > 0;
    } else if (!c.resolved(error_of_mass)) {
      unresolved.add(c);
    } else if (c.expected < kSmallestExpected) {
      small.add(c);
    } else {
      large.push_back(c);
    }
  }
};

/// Chance of the worst of a few categories, each by the exact distribution where its mass is known.
double exact_p(const std::vector<Category>& categories, double n) {
  if (categories.empty()) return 1;
  double smallest = 1;
  for (const Category& c : categories) {
    const double p = c.resolved(kErrorOfMass) && !(c.rounding > kErrorOfMass * c.expected)
                         ? binomial_two_sided(c.observed, n, std::min(1.0, c.expected / n))
                         : 2 * normal_tail(std::abs(c.pull()));
    smallest = std::min(smallest, p);
  }
  return std::min(1.0, smallest * static_cast<double>(categories.size()));
}

void test_categories(LevelTest& test, Categories& categories, double n) {
  double with_error = 0, inverse_expected = 0;
  if (!categories.small.resolved(kErrorOfMass)) {
    categories.unresolved.add(std::exchange(categories.small, {}));
  }
  if (categories.unresolved.expected > 0 &&
      categories.unresolved.resolved(categories.error_of_mass)) {
    categories.large.push_back(categories.unresolved);  // errors of many average out
  } else {
    test.unresolved = categories.unresolved.expected / n;
  }
  for (const Category& c : categories.large) {
    const double square = (c.observed - c.expected) * (c.observed - c.expected);
    test.statistic += square / c.expected;
    with_error += square / (c.expected + c.variance + c.rounding);
    inverse_expected += 1 / c.expected;
  }
  const double count = static_cast<double>(categories.large.size());
  test.degrees = std::max(1.0, count - 1);
  const bool few = categories.large.size() < kFewCategories;
  const double p_large =
      few ? exact_p(categories.large, n) : pearson_tail(with_error, test.degrees, inverse_expected);
  const double p_small = binomial_two_sided(categories.small.observed, n,
                                            std::min(1.0, categories.small.expected / n));
  // One test or two, as the pair has it.
  const double tests = categories.small.expected > 0 && count > 0 ? 2 : 1;
  test.p_value = categories.impossible ? 0 : std::min(1.0, tests * std::min(p_large, p_small));
}

}  // namespace

LevelTest test_level(const BinTable& table, int depth, double n, double error_of_mass) {
  LevelTest test;
  test.depth = depth;
  Categories categories;
  categories.error_of_mass = error_of_mass;
  for (std::size_t i = 0; i < table.expected.size(); ++i) {
    const Category bin{table.expected[i], table.variance[i], table.observed[i],
                       table.rounding.empty() ? 0 : table.rounding[i]};
    categories.add(bin);
    if (std::abs(bin.pull()) > std::abs(test.worst_pull)) {
      test.worst_bin = i;
      test.worst_pull = bin.pull();
    }
  }
  test_categories(test, categories, n);
  return test;
}

std::vector<int> depths_of(int finest) {
  std::vector<int> depths;
  for (int d = std::min(kCoarseDepth, finest); d < finest; d += kDepthStep) depths.push_back(d);
  depths.push_back(finest);
  return depths;
}

BinTable table_of(const BinnedPair& pair, int depth) {
  const double n = static_cast<double>(pair.counts().drawn);
  const std::size_t bins = std::size_t{1} << depth;
  const int finer = pair.depth() - depth;
  BinTable table{std::vector<double>(bins), std::vector<double>(bins), std::vector<double>(bins),
                 std::vector<double>(bins)};
  for (std::size_t i = 0; i < pair.expected().value.size(); ++i) {
    table.rounding[i >> finer] += n * n * pair.rounding_of(i);
    table.expected[i >> finer] += n * pair.expected().value[i];
    table.variance[i >> finer] += n * n * pair.expected().variance[i];
    table.observed[i >> finer] += static_cast<double>(pair.counts().bins[i]);
  }
  return table;
}

// A deviation δ adds n δ² to the statistic, whose spread is then √(2 k + 4 n δ²): seen with 99 %
// when n δ² − 2.33 √(2 k + 4 n δ²) reaches the gap between the critical value and k.
double detectable_deviation(double degrees, double level, double n) {
  const double k = degrees, z = normal_quantile(0.01);
  const double gap = chi_square_quantile(level, k) - k;
  const double excess = gap + 2 * z * z + z * std::sqrt(4 * z * z + 4 * gap + 2 * k);
  return std::sqrt(excess / n);
}

ChiSquareLook::ChiSquareLook(const ContractOptions& options, const BinnedPair& pair,
                             const RejectedShare& rejected, double fail_level, double pass_level)
    : options_(options), pair_(pair) {
  const MassBalance mass = balance_mass(pair, rejected);
  excess_ = mass.excess();
  excess_error_ = mass.error(fail_level / 2);
  const double n = static_cast<double>(pair.counts().drawn);
  for (const int depth : depths_of(pair.depth())) {
    levels_.push_back(test_level(table_of(pair, depth), depth, n, kErrorOfMass));
  }
  const std::vector<AtomCount>& atoms = pair.counts().atoms;
  // The atoms share one more level, where there are any.
  tests_ = static_cast<double>(levels_.size()) + (atoms.empty() ? 0 : 1);
  level_ = fail_level / 2 / tests_;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const double p = kMostAtomsTested * binomial_two_sided(static_cast<double>(atoms[i].drawn), n,
                                                           std::min(1.0, atoms[i].atom.mass));
    if (p >= atoms_p_) continue;
    atoms_p_ = p;
    worst_atom_ = i;
  }
  const LevelTest& coarse = levels_.front();
  bound_ = std::sqrt(noncentrality_limit(coarse.statistic, coarse.degrees, pass_level) / n);
  detectable_ = detectable_deviation(coarse.degrees, level_, n);
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
  r.p_value = std::min(1.0, std::min(worst().p_value, atoms_p_) * tests_);
  r.leaned_on = "bin masses with their sampling error";
  r.figures = {{Figure::integral_of_pdf, pair_.expected().total},
               {Figure::rejected, static_cast<double>(counts.rejected)},
               {Figure::atoms, static_cast<double>(counts.atoms.size())},
               {Figure::chi_square, worst().statistic},
               {Figure::degrees_of_freedom, worst().degrees},
               {Figure::bins, std::exp2(worst().depth)},
               {Figure::unresolved_share, levels_.front().unresolved}};
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
  if (!(std::abs(excess_) <= mass_tolerance(options_, pair_) + excess_error_)) {
    fail("∫pdf = " + number(pair_.expected().total) + ", with atoms and rejected samples " +
         number(1 + excess_));
  }
  if (!(worst().p_value >= level_)) {
    const BinTable table = table_of(pair_, worst().depth);
    fail("of " + number(std::exp2(worst().depth)) + " bins, the one around " +
         place(pair_.center(worst().depth, worst().worst_bin)) + " holds " +
         number(table.observed[worst().worst_bin]) + " samples, expected " +
         number(table.expected[worst().worst_bin]));
  }
  if (pair_.on_lines() > 0) {
    fail("at least " + number(std::round(1e4 * pair_.on_lines()) / 100) +
         " % of the samples lie on a line or in a point");
  }
  if (!(atoms_p_ >= level_)) {
    const AtomCount& a = counts.atoms[worst_atom_];
    fail("the atom at " + place(a.atom.x) + " is drawn " + number(a.drawn) + " times, its mass " +
         number(a.atom.mass) + " says " + number(a.atom.mass * static_cast<double>(counts.drawn)));
  }
  if (r.verdict == Verdict::fail) return;
  if (levels_.front().unresolved > kMostUnresolved) {
    r.reason = "the masses of bins that hold " + number(levels_.front().unresolved) +
               " of the samples are not known well enough";
    r.advice =
        "state where the density jumps (Domain::with_breaks, equirectangular, octahedral), or "
        "allow "
        "more `evaluations`";
  } else if (bound_ <= options_.deviation) {
    r.verdict = Verdict::pass;
  } else {
    r.reason =
        "neither a difference nor a deviation below " + number(options_.deviation) + " is proven";
    r.advice = "allow more `samples`";
  }
}

namespace {

/// For a person to see where.
std::vector<Bin> bins_in_detail(const BinnedPair& pair) {
  constexpr int kDepth = 8;
  const int depth = std::min(kDepth, pair.depth());
  const BinTable table = table_of(pair, depth);
  std::vector<Bin> bins;
  for (std::size_t i = 0; i < table.expected.size(); ++i) {
    const Box box = pair.box_of(depth, i);
    bins.push_back({{box.low[0], box.high[0]},
                    {box.low[1], box.high[1]},
                    table.expected[i],
                    std::sqrt(table.variance[i]),
                    table.observed[i]});
  }
  return bins;
}

}  // namespace

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
  if (result.verdict == Verdict::fail) result.bins = bins_in_detail(binned);
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
  const double error = resolved_mass_error(options);
  BinnedPair binned(pair, options, error);
  CheckResult result = run_chi_square(options, binned, measure_rejected(pair, options, error));
  result.seconds = watch.seconds();
  return result;
}

}  // namespace plumbline::verify
