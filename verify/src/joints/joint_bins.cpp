#include "joints/joint_bins.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "distributions.h"
#include "pairs/batches.h"
#include "pairs/lines.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr std::uint64_t kPilotsPerBin = 16, kLeastPilots = 1 << 14, kMostPilots = 1 << 20;
// Farther than this from the domain is not rounding.
constexpr double kOutside = 1e-4;
// Without a stated tolerance.
constexpr double kPromise = 1e-3;
// Of the tolerance: what the masses may be off by, and what a rejected share may be.
constexpr double kMassErrorPerTolerance = 0.25, kRejectedErrorPerTolerance = 0.4;
constexpr std::uint64_t kRejectedProbes = 100'000;
// Draws for it, at most, in units of the samples of the chi-square.
constexpr std::uint64_t kRejectedDrawsPerSample = 4;
// Sampling one standard deviation of the deviation that a pass excludes, see chi_square.cpp: masses
// to a fiftieth of it over 64 bins.
constexpr double kMassErrorPerDeviation = 0.02;

int log2_of_bins(std::size_t bins) {
  int depth = 0;
  while ((std::size_t{1} << depth) < bins) ++depth;
  return depth;
}

std::vector<CubePoint> draw_points(const JointPair& pair, const Cube& cube, std::uint64_t count,
                                   Random& random) {
  std::vector<CubePoint> points;
  draw_joint(pair, random, count, [&](std::span<const MaybeJoint> samples) {
    for (const MaybeJoint& s : samples) {
      if (s && all_finite(s->x)) points.push_back(cube.to_cube(s->x));
    }
  });
  return points;
}

/// The pdf per unit of the cube.
Many<double(CubePoint)> per_cube(const Cube& cube, const Many<double(JointPoint)>& pdf) {
  const auto in_spans = [&cube, pdf](std::span<const CubePoint> p, std::span<double> out) {
    std::vector<JointPoint> x(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) x[i] = cube.from_cube(p[i]);
    pdf(std::span<const JointPoint>(x), out);
    for (std::size_t i = 0; i < p.size(); ++i) out[i] *= cube.element(p[i]);
  };
  return {in_spans, pdf.batch()};
}

}  // namespace

void require_usable(const JointPair& pair, const ContractOptions& options) {
  const auto refuse = [&](const std::string& what) {
    throw std::invalid_argument("joint pair '" + pair.name + "': " + what);
  };
  if (static_cast<bool>(pair.sample) == static_cast<bool>(pair.draw)) {
    refuse("give one of `sample` and `draw`");
  }
  if (!pair.pdf) refuse("give its `pdf`");
  const int most = static_cast<int>(std::tuple_size_v<JointUniforms>);
  if (pair.numbers < 1 || pair.numbers > most) {
    refuse("`numbers` is 1 to " + std::to_string(most) + "; for more give `draw`");
  }
  if (options.finest_bins < 2 || !(options.deviation > 0) || options.evaluations < 1000 ||
      options.samples == 0 || options.points < 1 || options.jacobian_points < 1) {
    refuse("needs points, samples, at least 1000 evaluations and 2 bins, and a deviation above 0");
  }
}

bool all_finite(const JointPoint& x) {
  for (const Vec3& v : x) {
    if (!std::isfinite(v[0]) || !std::isfinite(v[1]) || !std::isfinite(v[2])) return false;
  }
  return true;
}

bool positive_near(const JointPair& pair, const Cube& cube, const JointPoint& x) {
  // A float direction that rounding put outside the support is within a few 2^-24 of it.
  constexpr double kRoundingDistance = 2e-6;
  for (std::size_t way = 0; way < cube.ways(); ++way) {
    if (pair.pdf(cube.near(x, kRoundingDistance, way)) > 0) return true;
  }
  return false;
}

std::string place(const JointPair& pair, const JointPoint& x) {
  std::string text;
  for (std::size_t f = 0; f < pair.domain.factors().size(); ++f) {
    const Domain& factor = pair.domain.factors()[f];
    text += f > 0 ? " × " : "";
    text += factor.dimension() == 1 ? number(x[f][0]) : place(x[f]);
  }
  return text;
}

double CountedShare::error(double level) const {
  if (!(trials > 0)) return 1;
  // Clopper, Pearson 1934.
  const double low = hits > 0 ? beta_quantile(level / 2, hits, trials - hits + 1) : 0;
  const double high = hits < trials ? beta_quantile(1 - level / 2, hits + 1, trials - hits) : 1;
  return std::max(high - value(), value() - low);
}

double joint_mass_tolerance(const ContractOptions& options) {
  return options.mass_tolerance.value_or(kPromise);
}

JointBins::JointBins(const JointPair& pair, const ContractOptions& options)
    : pair_(pair),
      options_(options),
      cube_(pair.domain),
      random_(random_for(options.seed, Stream::joint_samples)),
      depth_(log2_of_bins(static_cast<std::size_t>(options.finest_bins))) {
  integrate(options);
  measure_rounding();
  counts_.bins.assign(std::size_t{1} << depth_, 0);
}

void JointBins::integrate(const ContractOptions& options) {
  constexpr std::uint64_t kTries = 4096;
  Random random = random_for(options.seed, Stream::joint_pilot);
  const std::uint64_t wanted = std::max(kPilotsPerBin << depth_, kLeastPilots);
  const auto used = draw_points(pair_, cube_, kTries, random).size();
  const std::uint64_t draws = std::clamp<std::uint64_t>(
      wanted * kTries / std::max<std::uint64_t>(used, 1), wanted, std::max(wanted, kMostPilots));
  CubeQuestion question;
  question.density = per_cube(cube_, pair_.pdf);
  question.pilot = draw_points(pair_, cube_, draws, random);
  question.pilots_drawn = static_cast<double>(draws);
  for (std::size_t d = 0; d < cube_.dimension(); ++d) question.breaks[d] = cube_.breaks(d);
  question.target = std::min(kMassErrorPerTolerance * joint_mass_tolerance(options),
                             kMassErrorPerDeviation * options.deviation);
  question.max_evaluations = options.evaluations;
  question.seed = options.seed;
  Random own = random_for(options.seed, Stream::joint_own_nodes);
  question.draw_own = [&](std::size_t count) { return draw_points(pair_, cube_, count, own); };
  std::vector<CubePoint> points = question.pilot;
  on_lines_ = share_on_lines(points, cube_.dimension(), pair_.epsilon);
  tree_.emplace(points, depth_, cube_.dimension(), pair_.epsilon);
  expected_ = integrate_cube(question, *tree_, cube_.dimension());
}

void JointBins::measure_rounding() {
  constexpr std::uint64_t kPoints = 500;
  Random random = random_for(options_.seed, Stream::joint_rounding);
  double sum = 0, count = 0;
  std::vector<JointPoint> points, moved;
  draw_joint(pair_, random, kPoints, [&](std::span<const MaybeJoint> samples) {
    for (const MaybeJoint& s : samples) {
      if (s && all_finite(s->x)) points.push_back(s->x);
    }
  });
  for (const JointPoint& x : points) {
    moved.push_back(cube_.near(x, pair_.epsilon, random.bits() % cube_.ways()));
  }
  const std::vector<double> here = ask(pair_.pdf, points), beside = ask(pair_.pdf, moved);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(here[i] > 0 && beside[i] > 0)) continue;
    sum += std::min(1.0, std::abs(beside[i] / here[i] - 1));
    count += 1;
  }
  rounding_ = count > 0 ? sum / count : 0;
}

void JointBins::draw(std::uint64_t count_of_samples) {
  draw_joint(pair_, random_, count_of_samples,
             [&](std::span<const MaybeJoint> samples) { count(samples); });
  counts_.drawn += count_of_samples;
}

void JointBins::count(std::span<const MaybeJoint> samples) {
  std::vector<JointPoint> points;
  for (const MaybeJoint& sample : samples) {
    if (!sample) {
      ++counts_.rejected;
    } else if (all_finite(sample->x)) {
      points.push_back(sample->x);
    } else {
      ++counts_.not_finite;
      if (!counts_.not_finite_at) counts_.not_finite_at = sample->x;
    }
  }
  const std::vector<double> densities = ask(pair_.pdf, points);
  for (std::size_t i = 0; i < points.size(); ++i) count_point(points[i], densities[i]);
}

void JointBins::count_point(const JointPoint& x, double density) {
  if (!(density >= 0) || std::isinf(density)) {
    ++counts_.not_finite;
    if (!counts_.not_finite_at) counts_.not_finite_at = x;
    return;
  }
  const bool inside = cube_.distance(x) <= kOutside;
  if (!inside || (density == 0 && !positive_near(pair_, cube_, x))) {
    ++counts_.stray;
    if (!counts_.stray_at) counts_.stray_at = x;
  }
  if (inside) ++counts_.bins[tree_->locate(cube_.to_cube(x))];
}

BinTable JointBins::table(int depth) const {
  const double n = static_cast<double>(counts_.drawn);
  const std::size_t bins = std::size_t{1} << depth;
  const int finer = depth_ - depth;
  BinTable table{
      std::vector<double>(bins), std::vector<double>(bins), std::vector<double>(bins), {}};
  for (std::size_t i = 0; i < counts_.bins.size(); ++i) {
    table.expected[i >> finer] += n * expected_.integral.value[i];
    table.variance[i >> finer] += n * n * expected_.integral.variance[i];
    table.observed[i >> finer] += static_cast<double>(counts_.bins[i]);
  }
  return table;
}

CountedShare JointBins::rejected() const {
  CountedShare share;
  Random random = random_for(options_.seed, Stream::joint_rejected);
  const auto draw = [&](std::uint64_t count) {
    draw_joint(pair_, random, count, [&](std::span<const MaybeJoint> samples) {
      for (const MaybeJoint& s : samples) share.hits += s ? 0 : 1;
    });
    share.trials += static_cast<double>(count);
  };
  draw(kRejectedProbes);
  const double wanted = kRejectedErrorPerTolerance * joint_mass_tolerance(options_);
  const double z = normal_quantile(options_.budget.pass_level() / 4);
  const double p = std::max(share.value(), 1 / share.trials);
  const double needed = 1.05 * p * (1 - p) * std::pow(z / wanted, 2);
  if (needed > share.trials) {
    const double most = static_cast<double>(kRejectedDrawsPerSample * options_.samples);
    draw(static_cast<std::uint64_t>(std::min(needed - share.trials, most)));
  }
  return share;
}

JointPoint JointBins::center(int depth, std::size_t bin) const {
  // The finest bin in the middle of the coarser one's range stands for it.
  const int finer = depth_ - depth;
  const std::size_t fine = (bin << finer) + ((std::size_t{1} << finer) >> 1);
  return cube_.from_cube(tree_->box(fine).center());
}

}  // namespace plumbline::verify
