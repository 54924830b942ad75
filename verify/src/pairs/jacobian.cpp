#include "pairs/jacobian.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <plumbline/verify/detail/stopwatch.h>

#include "pairs/chi_square_look.h"
#include "text.h"

namespace plumbline::verify {

namespace {

using Map = std::function<std::optional<PairSample>(const Uniforms&)>;

constexpr double kDoubleTolerance = 1e-4;
constexpr double kFloatTolerance = 5e-3;
// Differences that do not converge at more than this share of the points prove too little.
constexpr double kMostFolds = 0.75;
// Failing points that a seam may cause by a coincidence of its differences.
constexpr double kSeamPoints = 2;
constexpr double kSeamShare = 0.002;

/// A derivative along one uniform number, with its error.
struct Derivative {
  Vec3 value{};
  double error = 0;
};

double norm(const Vec3& v) { return std::hypot(v[0], v[1], v[2]); }

Vec3 combine(double a, const Vec3& x, double b, const Vec3& y) {
  return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]};
}

/// Largest coordinate that a difference subtracts, for its rounding error.
double largest_coordinate(const Vec3& x) {
  return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
}

/// Central difference; steps are powers of two and u a multiple of 2^-20, so that u ± h is exact in
/// float too.
std::optional<Vec3> difference(const Map& map, Uniforms u, std::size_t d, double h) {
  const double center = u[d];
  u[d] = center + h;
  const auto above = map(u);
  u[d] = center - h;
  const auto below = map(u);
  if (!above || !below || above->mass > 0 || below->mass > 0) return std::nullopt;
  return combine(0.5 / h, above->x, -0.5 / h, below->x);
}

/// What each coordinate of the map is off by around u: its steps, if the code rounds something on
/// the way that the result magnifies (a sine from 1 − cos² in float), else `unit`. Second
/// differences at steps so small that a smooth map is straight over them.
double rounding_around(const Map& map, const Uniforms& u, std::size_t d, double unit) {
  const auto here = map(u);
  for (double h = 0x1p-20; here && h <= 0x1p-17 && h < u[d] && u[d] + h < 1; h *= 2) {
    Uniforms above = u, below = u;
    above[d] += h;
    below[d] -= h;
    const auto a = map(above), b = map(below);
    if (!a || !b) break;
    const Vec3 bend =
        combine(0.5, combine(1, a->x, -1, here->x), 0.5, combine(1, b->x, -1, here->x));
    unit = std::max(unit, norm(bend));
  }
  return unit;
}

/// Ridders: differences at halved steps, extrapolated; the best is where neither the extrapolation
/// nor rounding (`unit`: what each coordinate of the map is off by) leaves a larger error.
std::optional<Derivative> derivative(const Map& map, const Uniforms& u, std::size_t d,
                                     double unit) {
  constexpr int kSteps = 8;
  if (unit > 0x1p-40) unit = rounding_around(map, u, d, unit);
  double h = std::exp2(std::floor(std::log2(std::min({0.0625, u[d] / 2, (1 - u[d]) / 2}))));
  std::array<std::array<Vec3, kSteps>, kSteps> table;
  Derivative best;
  best.error = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kSteps; ++i, h /= 2) {
    const auto next = difference(map, u, d, h);
    if (!next) {
      if (i == 0) return std::nullopt;
      break;
    }
    table[0][i] = *next;
    double factor = 4;
    for (std::size_t j = 1; j <= i; ++j, factor *= 4) {
      table[j][i] =
          combine(factor / (factor - 1), table[j - 1][i], -1 / (factor - 1), table[j - 1][i - 1]);
      const double error =
          std::max({norm(combine(1, table[j][i], -1, table[j - 1][i])),
                    norm(combine(1, table[j][i], -1, table[j - 1][i - 1])), 4 * unit / h});
      if (error <= best.error) best = {table[j][i], error};
    }
  }
  return best;
}

/// |∂x/∂u| with its relative error; nullopt where the map rejects or has atoms nearby.
struct Determinant {
  double value = 0;
  double relative_error = 0;
};

std::optional<Determinant> determinant(const Map& map, const Uniforms& u, int dimension,
                                       double unit) {
  const auto du = derivative(map, u, 0, unit);
  if (!du) return std::nullopt;
  if (dimension == 1) {
    const double length = norm(du->value);
    return Determinant{length, du->error / length};
  }
  const auto dv = derivative(map, u, 1, unit);
  if (!dv) return std::nullopt;
  const Vec3& a = du->value;
  const Vec3& b = dv->value;
  const double area =
      norm({a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
  return Determinant{area, (du->error * norm(b) + dv->error * norm(a)) / area};
}

/// Uniform in the middle, and as often close to one end: maps are steep there.
double draw_uniform(Random& random) {
  double u = random.uniform();
  if (random.uniform() < 0.5) {
    const double small = std::exp2(-16 * random.uniform() - 1);
    u = random.uniform() < 0.5 ? small : 1 - small;
  }
  return std::clamp(std::round(u * 0x1p20) * 0x1p-20, 0x1p-20, 1 - 0x1p-20);
}

class Jacobian {
 public:
  Jacobian(const SamplingPair& pair, const ContractOptions& options)
      : pair_(pair),
        random_(options.seed, 3),
        tolerance_(pair.epsilon > 0x1p-40 ? kFloatTolerance : kDoubleTolerance) {
    outcome_.evidence.quotient = "observed/expected";
    outcome_.evidence.denominator = "pdf";
    CheckResult& r = outcome_.result;
    r.kind = CheckKind::jacobian;
    r.subject = pair.name + "/jacobian";
    r.reference = 0;
    r.tolerance = tolerance_;
    r.seed = options.seed;
    r.leaned_on = "convergence of the differences";
  }

  JacobianOutcome run(int points) {
    if (pair_.lobes.empty()) {
      visit(pair_.sample, pair_.pdf, points);
    } else {
      for (const PairLobe& lobe : pair_.lobes) {
        if (lobe.probability > 0) visit(lobe.sample, lobe.pdf, points);
      }
      lobes_fail_ = failing_ > 0;
      check_mixture();
    }
    outcome_.evidence.points =
        pair_.lobes.empty() || lobes_fail_ ? std::move(of_lobes_) : std::move(of_mixture_);
    outcome_.evidence.stray_share =
        static_cast<double>(outcome_.evidence.strays.size()) / std::max(1.0, usable_);
    finish();
    return std::move(outcome_);
  }

  JacobianOutcome skip(const char* reason) {
    outcome_.result.expected = Verdict::inconclusive;
    outcome_.result.reason = reason;
    outcome_.result.seconds = watch_.seconds();
    return std::move(outcome_);
  }

 private:
  void visit(const Map& map, const std::function<double(const Vec3&)>& pdf, int points) {
    for (int i = 0; i < points; ++i) {
      Uniforms u{};
      for (int d = 0; d < pair_.numbers; ++d)
        u[static_cast<std::size_t>(d)] = draw_uniform(random_);
      const auto sample = map(u);
      if (!sample || sample->mass > 0) continue;
      const auto density = pair_.preimages ? density_of(sample->x, map) : density_at(u, map);
      ++tried_;
      if (!density || !(density->relative_error <= tolerance_ / 4)) {
        ++folds_;
        continue;
      }
      count(sample->x, pdf(sample->x), *density, of_lobes_);
    }
  }

  /// 1/|∂x/∂u| as a density with its error.
  std::optional<Determinant> density_at(const Uniforms& u, const Map& map) const {
    const auto sample = map(u);
    if (!sample) return std::nullopt;
    auto d = determinant(map, u, pair_.domain.dimension(),
                         pair_.epsilon * largest_coordinate(sample->x));
    if (!d || !(d->value > 0)) return std::nullopt;
    d->value = 1 / d->value;
    return d;
  }

  std::optional<Determinant> density_of(const Vec3& x, const Map& map) const {
    Determinant sum;
    for (const Uniforms& u : pair_.preimages(x)) {
      const auto d = density_at(u, map);
      if (!d) return std::nullopt;
      sum.value += d->value;
      sum.relative_error = std::max(sum.relative_error, d->relative_error);
    }
    return sum;
  }

  void count(const Vec3& x, double pdf, const Determinant& density,
             std::vector<RatioPoint>& ratios) {
    ++usable_;
    if (pdf == 0) outcome_.evidence.strays.push_back(x);
    const double error = std::abs(pdf / density.value - 1);
    ratios.push_back({x, density.value / pdf, 1});
    if (!(error <= worst_)) {
      worst_ = error;
      worst_at_ = x;
    }
    if (!(error <= tolerance_ + 4 * density.relative_error)) ++failing_;
  }

  /// pdf = Σ probability · lobe pdf, at points of every lobe.
  void check_mixture() {
    constexpr int kPoints = 200;
    for (const PairLobe& lobe : pair_.lobes) {
      for (int i = 0; i < kPoints && lobe.probability > 0; ++i) {
        const auto sample = lobe.sample({draw_uniform(random_), draw_uniform(random_), 0});
        if (!sample || sample->mass > 0) continue;
        double sum = 0;
        for (const PairLobe& l : pair_.lobes) sum += l.probability * l.pdf(sample->x);
        ++tried_;
        count(sample->x, pair_.pdf(sample->x), {sum, 0}, of_mixture_);
      }
    }
  }

  void finish() {
    CheckResult& r = outcome_.result;
    r.samples = static_cast<std::uint64_t>(usable_);
    r.estimate = r.bound = worst_;
    r.detectable = tolerance_ * 2;
    r.seconds = watch_.seconds();
    r.figures = {
        {Figure::points_tried, tried_}, {Figure::folds, folds_}, {Figure::failing, failing_}};
    if (tried_ == 0) {
      r.expected = Verdict::inconclusive;
      r.reason = "the map gave no point of a density";
    } else if (failing_ > std::max(kSeamPoints, kSeamShare * usable_)) {
      r.verdict = Verdict::fail;
      r.reason = "pdf · |dx/du| is off by " + number(worst_) + " at " + place(worst_at_) + ", at " +
                 number(failing_) + " of " + number(usable_) + " points";
    } else if (folds_ > kMostFolds * tried_) {
      // In float that is rounding, which says nothing against the code: skipped, and said so.
      if (pair_.epsilon > 0x1p-40) r.expected = Verdict::inconclusive;
      r.reason =
          "differences do not converge at " + number(folds_) + " of " + number(tried_) + " points";
    } else {
      r.verdict = Verdict::pass;
    }
  }

  const Stopwatch watch_;
  const SamplingPair& pair_;
  Random random_;
  double tolerance_;
  JacobianOutcome outcome_;
  double tried_ = 0, usable_ = 0, folds_ = 0, failing_ = 0;
  double worst_ = 0;
  Vec3 worst_at_{};
  std::vector<RatioPoint> of_lobes_, of_mixture_;
  bool lobes_fail_ = false;
};

}  // namespace

JacobianOutcome judge_jacobian(const SamplingPair& pair, const ContractOptions& options) {
  Jacobian jacobian(pair, options);
  if (pair.domain.dimension() == 0) return jacobian.skip("skipped: the domain is discrete");
  const bool lobes = !pair.lobes.empty();
  if (pair.draw && !lobes)
    return jacobian.skip("skipped: the sampler takes a generator, not numbers");
  if (pair.numbers != pair.domain.dimension() && !lobes) {
    return jacobian.skip("skipped: the map uses more numbers than the domain has dimensions");
  }
  if (pair.many_to_one && !pair.preimages && !lobes) {
    return jacobian.skip(
        "skipped: the map is many-to-one and neither lobes nor preimages are given");
  }
  return jacobian.run(options.jacobian_points);
}

CheckResult check_jacobian(const SamplingPair& pair, const ContractOptions& options) {
  JacobianOutcome outcome = judge_jacobian(pair, options);
  if (outcome.result.verdict == Verdict::fail) {
    outcome.result.diagnosis = diagnose(pair, outcome.evidence).text;
  }
  return outcome.result;
}

}  // namespace plumbline::verify
