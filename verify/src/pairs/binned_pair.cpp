#include "pairs/binned_pair.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "pairs/batches.h"
#include "pairs/lines.h"
#include "streams.h"

namespace plumbline::verify {

namespace {

// Pilot samples in a bin, on average: few, since a bin need not hold just what its neighbours do.
constexpr std::size_t kPilotsPerBin = 16, kLeastPilots = 1 << 14;
constexpr std::size_t kMostDrawn = 1 << 20;
// Half of the strict promise of the integral check, see kStrictPromise.
constexpr double kStrictMassError = 2.5e-5;
// Of a tolerance that is stated: a rejected share that has to be counted needs the most of it.
constexpr double kMassErrorPerTolerance = 0.25;
// Of the deviation δ that a chi-square pass excludes, root mean square over 64 bins. Their masses
// have a standard deviation of 0.008 δ/3.3 together, 0.0003 δ each, a fiftieth of δ of a bin's
// 1/64. In 4,096 bins and 10⁶ samples it is half a count, where chance is 16.
constexpr double kMassErrorPerDeviation = 0.008;
// What is good enough where that is out of reach, at most a quarter of the promise that is made
// then.
constexpr double kLooseMassErrors = 5, kLooseMassError = 2.5e-4;
// Samples in float lie on a lattice as wide as the last digits of what they are computed from: the
// result is rounded once, and a normal or an angle before, which the sample moves twice as far as.
// Of lines that a distance s lie apart a width w holds w/s on average, and by where it begins one
// more or fewer: a variance of f (1 − f) for the fraction f of w/s, 1/6 on average over f.
constexpr double kLatticeStep = 4;
// Farther than this from the domain is not rounding either.
constexpr double kOutside = 1e-4;
constexpr std::size_t kStraysKept = 64;
constexpr std::size_t kMostAtoms = 64;

bool same_point(const Vec3& a, const Vec3& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])}) <= 1e-5;
}

/// Samples with a density, on the square.
OwnSamples draw_own(const SamplingPair& pair, std::size_t count, Random& random) {
  OwnSamples points;
  draw_in_batches(pair, random, count, [&](std::span<const Record> samples) {
    for (const Record& s : samples) {
      if (s && s->mass == 0 && is_finite(s->x))
        points.push_back(pair.domain.chart().to_square(s->x));
    }
  });
  return points;
}

/// How many to draw so that about `wanted` are neither rejected nor atoms.
std::size_t draws_for(const SamplingPair& pair, std::size_t wanted, Random& random) {
  constexpr std::size_t kTries = 4096;
  const std::size_t used = draw_own(pair, kTries, random).size();
  return std::clamp(wanted * kTries / std::max<std::size_t>(used, 1), wanted, kMostDrawn);
}

int log2_of(std::size_t bins) {
  int depth = 0;
  while ((std::size_t{1} << depth) < bins) ++depth;
  return depth;
}

/// A function of the domain, per unit of the chart's square.
///
/// @param chart  kept by the caller
Many<double(Point2)> per_square(const Chart& chart, const Many<double(Vec3)>& function) {
  const auto in_spans = [&chart, function](std::span<const Point2> p, std::span<double> out) {
    std::vector<Vec3> x(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) x[i] = chart.from_square(p[i]);
    function(x, out);
    for (std::size_t i = 0; i < p.size(); ++i) out[i] *= chart.element(p[i]);
  };
  return {in_spans, function.batch()};
}

/// @param function  empty: the pair's own density
MassIntegral integrate_over(const BinTree& tree, const SamplingPair& pair,
                            const Many<double(Vec3)>& function, std::size_t own,
                            const ContractOptions& options, double error) {
  const Chart& chart = pair.domain.chart();
  Random random = random_for(options.seed, Stream::own_nodes);
  MassQuestion question;
  question.integrand = per_square(chart, function ? function : pair.pdf);
  if (function) question.density = per_square(chart, pair.pdf);
  question.draw_own = [&](std::size_t count) { return draw_own(pair, count, random); };
  question.bins_at = [&](std::span<const Point2> p, std::span<std::size_t> bins) {
    tree.locate(p, bins);
  };
  question.bins = tree.bins();
  question.dimension = pair.domain.dimension();
  question.target = error;
  question.good_enough = std::max(error, std::min(kLooseMassErrors * error, kLooseMassError));
  question.max_evaluations = options.evaluations;
  question.own = own;
  question.seed = options.seed;
  return integrate_mass(question, tree.cells(pair.domain.breaks()));
}

}  // namespace

double resolved_mass_error(const ContractOptions& options) {
  return kMassErrorPerDeviation * options.deviation;
}

double promised_mass_error(const ContractOptions& options) {
  return std::max(kStrictMassError, kMassErrorPerTolerance * options.mass_tolerance.value_or(0));
}

double mass_error(const ContractOptions& options) {
  return std::min(resolved_mass_error(options), promised_mass_error(options));
}

BinnedPair::BinnedPair(const SamplingPair& pair, const ContractOptions& options, double mass_error)
    : pair_(pair),
      random_(random_for(options.seed, Stream::samples)),
      depth_(log2_of(pair.domain.size() > 0 ? pair.domain.size()
                                            : static_cast<std::size_t>(options.finest_bins))) {
  if (pair.domain.size() > 0) {
    tabulate_discrete();
  } else {
    integrate_density(options, mass_error);
    measure_rounding(options.seed);
    measure_lattice();
  }
  counts_.bins.assign(std::size_t{1} << depth_, 0);
  for (const Atom& atom : pair.atoms) counts_.atoms.push_back({atom, 0});
}

void BinnedPair::tabulate_discrete() {
  expected_.value.assign(std::size_t{1} << depth_, 0.0);
  expected_.variance.assign(std::size_t{1} << depth_, 0.0);
  std::vector<Vec3> points(pair_.domain.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {static_cast<double>(i), 0, 0};
  const std::vector<double> probabilities = ask(pair_.pdf, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double probability = probabilities[i];
    expected_.value[i] = probability;
    expected_.total += probability;
    expected_.finite = expected_.finite && std::isfinite(probability) && probability >= 0;
  }
  // Each probability is rounded in proportion to itself; two roundings each.
  expected_.variance_of_total = std::pow(2 * pair_.epsilon * expected_.total, 2);
  expected_.evaluations = pair_.domain.size();
}

void BinnedPair::integrate_density(const ContractOptions& options, double mass_error) {
  Random random = random_for(options.seed, Stream::pilot);
  const std::size_t own = draws_for(pair_, std::max(kPilotsPerBin << depth_, kLeastPilots), random);
  std::vector<Point2> pilot = draw_own(pair_, own, random);
  tree_.emplace(pilot, depth_, pair_.domain.dimension(), pair_.epsilon);
  on_lines_ =
      share_on_lines(pilot, static_cast<std::size_t>(pair_.domain.dimension()), pair_.epsilon);
  expected_ = integrate_over(*tree_, pair_, {}, own, options, mass_error);
}

MassIntegral integrate_over_domain(const SamplingPair& pair, const Many<double(Vec3)>& function,
                                   const ContractOptions& options, double error) {
  // Cells to begin with: no test needs their masses one by one, they are halved where it matters.
  constexpr int kDepth = 8;
  constexpr std::size_t kOwn = 1 << 14;
  Random random = random_for(options.seed, Stream::energy_pilot);
  const std::size_t own = draws_for(pair, kOwn, random);
  std::vector<Point2> pilot = draw_own(pair, own, random);
  const BinTree tree(pilot, kDepth, pair.domain.dimension(), pair.epsilon);
  return integrate_over(tree, pair, function, own, options, error);
}

void BinnedPair::measure_rounding(std::uint64_t seed) {
  constexpr int kPoints = 500;
  Random random = random_for(seed, Stream::rounding);
  std::vector<Vec3> points, moved;
  draw_in_batches(pair_, random, kPoints, [&](std::span<const Record> samples) {
    for (const Record& s : samples) {
      if (has_density(s)) points.push_back(s->x);
    }
  });
  for (const Vec3& x : points) {
    const double angle = 2 * std::numbers::pi * random.uniform();
    moved.push_back(pair_.domain.chart().near(x, pair_.epsilon, angle));
  }
  const std::vector<double> here = ask(pair_.pdf, points), beside = ask(pair_.pdf, moved);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(here[i] > 0 && beside[i] > 0)) continue;
    sum += std::min(1.0, std::abs(beside[i] / here[i] - 1));
    ++count;
  }
  rounding_ = count > 0 ? sum / count : 0;
}

void BinnedPair::measure_lattice() {
  constexpr std::size_t kDirections = 4;
  const Chart& chart = pair_.domain.chart();
  const double step = kLatticeStep * pair_.epsilon;
  lattice_.assign(tree_->bins(), 0.0);
  for (std::size_t bin = 0; bin < tree_->bins(); ++bin) {
    const Box& box = tree_->box(bin);
    const Point2 middle{(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2};
    const Vec3 x = chart.from_square(middle);
    Point2 moved{};
    for (std::size_t k = 0; k < kDirections; ++k) {
      const double angle = static_cast<double>(k) * std::numbers::pi / kDirections;
      const Point2 p = chart.to_square(chart.near(x, step, angle));
      for (std::size_t d = 0; d < 2; ++d) {
        const double by = std::abs(p[d] - middle[d]);
        moved[d] = std::max(moved[d], std::min(by, 1 - by));  // the other way round
      }
    }
    double square = 0;
    for (int d = 0; d < pair_.domain.dimension(); ++d) {
      const auto at = static_cast<std::size_t>(d);
      const double width = box.high[at] - box.low[at];
      square += width > moved[at] ? std::pow(moved[at] / width, 2) / 6 : 1;
    }
    lattice_[bin] = square * std::pow(expected_.value[bin], 2);
  }
}

void BinnedPair::draw(std::uint64_t count_of_samples) {
  draw_in_batches(pair_, random_, count_of_samples,
                  [&](std::span<const Record> samples) { count(samples); });
  counts_.drawn += count_of_samples;
}

void BinnedPair::count(std::span<const Record> samples) {
  points_.clear();
  for (const Record& sample : samples) {
    if (!sample) {
      ++counts_.rejected;
    } else if (sample->mass > 0) {
      count_atom(*sample);
    } else if (is_finite(sample->x)) {
      points_.push_back(sample->x);
    } else {
      ++counts_.not_finite;
      counts_.not_finite_at = sample->x;
    }
  }
  densities_.resize(points_.size());
  ask(pair_.pdf, std::span<const Vec3>(points_), std::span<double>(densities_));
  count_points(points_, densities_);
}

void BinnedPair::count_atom(const SampleRecord& sample) {
  for (AtomCount& a : counts_.atoms) {
    if (same_point(a.atom.x, sample.x)) {
      ++a.drawn;
      return;
    }
  }
  if (counts_.atoms.size() < kMostAtoms) {
    counts_.atoms.push_back({{sample.x, sample.mass}, 1});
  } else {
    ++counts_.stray;
  }
}

std::vector<bool> positive_near(const SamplingPair& pair, const std::vector<Vec3>& points) {
  // A float direction that rounding put outside the support is within a few 2^-24 of it.
  constexpr double kRoundingDistance = 2e-6;
  constexpr std::size_t kDirections = 8;
  std::vector<Vec3> around;
  for (const Vec3& x : points) {
    for (std::size_t k = 0; k < kDirections; ++k) {
      const double angle = static_cast<double>(k) * std::numbers::pi / 4;
      around.push_back(pair.domain.chart().near(x, kRoundingDistance, angle));
    }
  }
  const std::vector<double> densities = ask(pair.pdf, around);
  std::vector<bool> positive(points.size());
  for (std::size_t i = 0; i < densities.size(); ++i) {
    if (densities[i] > 0) positive[i / kDirections] = true;
  }
  return positive;
}

bool BinnedPair::inside(const Vec3& x) const {
  return tree_ ? pair_.domain.chart().distance(x) <= kOutside
               : x[0] >= 0 && x[0] < static_cast<double>(pair_.domain.size());
}

void BinnedPair::count_points(const std::vector<Vec3>& points,
                              const std::vector<double>& densities) {
  const auto see_stray = [this](const Vec3& x) {
    ++counts_.stray;
    if (counts_.strays.size() < kStraysKept) counts_.strays.push_back(x);
  };
  std::vector<Vec3> doubtful;
  inside_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& x = points[i];
    if (!(densities[i] >= 0) || std::isinf(densities[i])) {
      ++counts_.not_finite;
      counts_.not_finite_at = x;
      continue;
    }
    if (!inside(x)) {
      see_stray(x);
      continue;
    }
    inside_.push_back(x);
    if (densities[i] == 0) doubtful.push_back(x);
  }
  count_in_bins(inside_);
  const std::vector<bool> rounded =
      tree_ ? positive_near(pair_, doubtful) : std::vector<bool>(doubtful.size());
  for (std::size_t i = 0; i < doubtful.size(); ++i) {
    if (!rounded[i]) see_stray(doubtful[i]);
  }
}

void BinnedPair::count_in_bins(const std::vector<Vec3>& points) {
  if (!tree_) {
    for (const Vec3& x : points) ++counts_.bins[static_cast<std::size_t>(x[0])];
    return;
  }
  squares_.resize(points.size());
  bins_.resize(points.size());
  const Chart& chart = pair_.domain.chart();
  for (std::size_t i = 0; i < points.size(); ++i) squares_[i] = chart.to_square(points[i]);
  tree_->locate(squares_, bins_);
  for (const std::size_t bin : bins_) ++counts_.bins[bin];
}

std::vector<std::vector<BinnedPair::Node>> BinnedPair::nodes() const {
  constexpr int kSteps = 2;
  std::vector<std::vector<Node>> nodes(expected_.value.size());
  if (!tree_) {
    for (std::size_t bin = 0; bin < nodes.size(); ++bin) {
      nodes[bin] = {{{static_cast<double>(bin), 0, 0}, expected_.value[bin], 1}};
    }
    return nodes;
  }
  const Chart& chart = pair_.domain.chart();
  const int second = pair_.domain.dimension() == 1 ? 1 : kSteps;
  std::vector<Vec3> points;
  for (std::size_t bin = 0; bin < nodes.size(); ++bin) {
    const Box& box = tree_->box(bin);
    const double area = (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]) / (kSteps * second);
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < second; ++j) {
        const Point2 p = {box.low[0] + (box.high[0] - box.low[0]) * (i + 0.5) / kSteps,
                          box.low[1] + (box.high[1] - box.low[1]) * (j + 0.5) / second};
        points.push_back(chart.from_square(p));
        nodes[bin].push_back({points.back(), 0, chart.element(p) * area});
      }
    }
  }
  const std::vector<double> pdfs = ask(pair_.pdf, points);
  auto pdf = pdfs.begin();
  for (std::size_t bin = 0; bin < nodes.size(); ++bin) {
    double total = 0;
    for (Node& n : nodes[bin]) total += n.mass = *pdf++ * n.measure;
    for (Node& n : nodes[bin]) n.mass = total > 0 ? n.mass / total * expected_.value[bin] : 0;
  }
  return nodes;
}

Box BinnedPair::box_of(int depth, std::size_t bin) const {
  const int finer = depth_ - depth;
  const std::size_t first = bin << finer, last = ((bin + 1) << finer) - 1;
  if (!tree_) return {{static_cast<double>(first), 0}, {static_cast<double>(last + 1), 1}};
  // The leaves below one node of the tree, of which the first lies lowest and the last highest.
  return {tree_->box(first).low, tree_->box(last).high};
}

Vec3 BinnedPair::center(int depth, std::size_t bin) const {
  // The finest bin in the middle of the coarser one's range stands for it.
  const int finer = depth_ - depth;
  const std::size_t fine = (bin << finer) + ((std::size_t{1} << finer) >> 1);
  if (!tree_) return {static_cast<double>(fine), 0, 0};
  const Box& box = tree_->box(fine);
  return pair_.domain.chart().from_square(
      {(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2});
}

}  // namespace plumbline::verify
