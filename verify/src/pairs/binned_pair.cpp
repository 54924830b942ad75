#include "pairs/binned_pair.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumbline::verify {

namespace {

// With 4096 bins, a corner of the support that holds 5e-5 of the mass is missed by all pilot
// samples twice in a million times; a quarter of them missed one of 3.5e-5 in one run of ten.
constexpr std::size_t kPilotsPerBin = 64;
constexpr std::uint64_t kMaxEvaluations = 6'000'000;
// A float direction that rounding put outside the support is within a few 2^-24 of it.
constexpr double kRoundingDistance = 2e-6;
// Farther than this from the domain is not rounding either.
constexpr double kOutside = 1e-4;
constexpr std::size_t kStraysKept = 64;
constexpr std::size_t kMostAtoms = 64;

bool finite(const Vec3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

bool same_point(const Vec3& a, const Vec3& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])}) <= 1e-5;
}

std::vector<Point2> draw_pilot(const SamplingPair& pair, std::size_t count, std::uint64_t seed) {
  Random random(seed, 1);
  std::vector<Point2> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto s = pair.next(random);
    if (s && s->mass == 0 && finite(s->x)) points.push_back(pair.domain.chart().to_square(s->x));
  }
  return points;
}

int log2_of(std::size_t bins) {
  int depth = 0;
  while ((std::size_t{1} << depth) < bins) ++depth;
  return depth;
}

/// Cells follow the pilot points where the edge of a support may run or the points are uneven, and
/// are whole bins elsewhere.
///
/// @param promise_mass  whether the function integrates to the share of points in a cell
CubatureResult integrate_over(const BinTree& tree, const Chart& chart,
                              const std::function<double(const Vec3&)>& function,
                              std::vector<Point2>& pilot, bool promise_mass, double error) {
  const auto on_square = [&](const Point2& p) {
    return chart.element(p) * function(chart.from_square(p));
  };
  std::vector<Cell> cells;
  for (std::size_t bin = 0; bin < tree.bins(); ++bin) {
    for (const Cell& cell : tree.cells(bin, chart.break_line(), pilot)) {
      const bool has_points = cell.first < cell.last;
      if (has_points && shows_zero(on_square, cell.box)) {
        add_cells_around_points(cell, pilot, cells);
      } else {
        add_cells_of_even_points(cell, pilot, cells);
      }
    }
  }
  for (Cell& cell : cells) {
    if (!promise_mass) cell.first = cell.last = 0;
  }
  return integrate(on_square, cells, pilot, tree.bins(), error, kMaxEvaluations);
}

}  // namespace

BinnedPair::BinnedPair(const SamplingPair& pair, int finest_bins, double mass_error,
                       std::uint64_t seed)
    : pair_(pair),
      random_(seed, 2),
      depth_(log2_of(pair.domain.size() > 0 ? pair.domain.size()
                                            : static_cast<std::size_t>(finest_bins))) {
  if (pair.domain.size() > 0) {
    tabulate_discrete();
  } else {
    integrate_density(mass_error, seed);
    measure_rounding(seed);
  }
  counts_.bins.assign(std::size_t{1} << depth_, 0);
  for (const Atom& atom : pair.atoms) counts_.atoms.push_back({atom, 0});
}

void BinnedPair::tabulate_discrete() {
  expected_.value.assign(std::size_t{1} << depth_, 0.0);
  expected_.error.assign(std::size_t{1} << depth_, 0.0);
  for (std::size_t i = 0; i < pair_.domain.size(); ++i) {
    const double probability = pair_.pdf({static_cast<double>(i), 0, 0});
    expected_.value[i] = probability;
    expected_.total += probability;
    expected_.finite = expected_.finite && std::isfinite(probability) && probability >= 0;
  }
  // Each probability is rounded in proportion to itself; two roundings each.
  expected_.total_error = 2 * pair_.epsilon * expected_.total;
  expected_.evaluations = pair_.domain.size();
}

void BinnedPair::integrate_density(double mass_error, std::uint64_t seed) {
  std::vector<Point2> pilot = draw_pilot(pair_, kPilotsPerBin << depth_, seed);
  tree_.emplace(pilot, depth_, pair_.domain.dimension());
  expected_ = integrate_over(*tree_, pair_.domain.chart(), pair_.pdf, pilot, true, mass_error);
}

CubatureResult integrate_over_domain(const SamplingPair& pair,
                                     const std::function<double(const Vec3&)>& function,
                                     int finest_bins, double error, std::uint64_t seed) {
  const int depth = log2_of(static_cast<std::size_t>(finest_bins));
  std::vector<Point2> pilot = draw_pilot(pair, kPilotsPerBin << depth, seed);
  const BinTree tree(pilot, depth, pair.domain.dimension());
  return integrate_over(tree, pair.domain.chart(), function, pilot, false, error);
}

void BinnedPair::measure_rounding(std::uint64_t seed) {
  constexpr int kPoints = 500;
  Random random(seed, 10);
  double sum = 0;
  int count = 0;
  for (int i = 0; i < kPoints; ++i) {
    const auto s = pair_.next(random);
    if (!s || s->mass > 0 || !finite(s->x)) continue;
    const double here = pair_.pdf(s->x);
    const double beside = pair_.pdf(
        pair_.domain.chart().near(s->x, pair_.epsilon, 2 * std::numbers::pi * random.uniform()));
    if (!(here > 0 && beside > 0)) continue;
    sum += std::min(1.0, std::abs(beside / here - 1));
    ++count;
  }
  rounding_ = count > 0 ? sum / count : 0;
}

void BinnedPair::draw(std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto sample = pair_.next(random_);
    if (!sample) {
      ++counts_.rejected;
    } else if (sample->mass > 0) {
      count_atom(*sample);
    } else {
      count_point(sample->x);
    }
  }
  counts_.drawn += count;
}

void BinnedPair::count_atom(const PairSample& sample) {
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

bool BinnedPair::is_stray(const Vec3& x) const {
  if (!tree_) return true;
  for (int k = 0; k < 8; ++k) {
    const double angle = k * std::numbers::pi / 4;
    if (pair_.pdf(pair_.domain.chart().near(x, kRoundingDistance, angle)) > 0) return false;
  }
  return true;
}

void BinnedPair::count_point(const Vec3& x) {
  const double density = finite(x) ? pair_.pdf(x) : -1;
  if (!(density >= 0) || std::isinf(density)) {
    ++counts_.not_finite;
    counts_.not_finite_at = x;
    return;
  }
  const bool inside = tree_ ? pair_.domain.chart().distance(x) <= kOutside
                            : x[0] >= 0 && x[0] < static_cast<double>(pair_.domain.size());
  if (!inside || (density == 0 && is_stray(x))) {
    ++counts_.stray;
    if (counts_.strays.size() < kStraysKept) counts_.strays.push_back(x);
  }
  if (inside) ++counts_.bins[locate(x)];
}

std::size_t BinnedPair::locate(const Vec3& x) const {
  return tree_ ? tree_->locate(pair_.domain.chart().to_square(x)) : static_cast<std::size_t>(x[0]);
}

std::vector<BinnedPair::Node> BinnedPair::nodes_of(std::size_t bin) const {
  constexpr int kSteps = 2;
  if (!tree_) return {{{static_cast<double>(bin), 0, 0}, expected_.value[bin], 1}};
  const Box& box = tree_->box(bin);
  const Chart& chart = pair_.domain.chart();
  const int second = pair_.domain.dimension() == 1 ? 1 : kSteps;
  const double area = (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]) / (kSteps * second);
  std::vector<Node> nodes;
  double total = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < second; ++j) {
      const Point2 p = {box.low[0] + (box.high[0] - box.low[0]) * (i + 0.5) / kSteps,
                        box.low[1] + (box.high[1] - box.low[1]) * (j + 0.5) / second};
      const Vec3 x = chart.from_square(p);
      const double measure = chart.element(p) * area, mass = pair_.pdf(x) * measure;
      nodes.push_back({x, mass, measure});
      total += mass;
    }
  }
  for (Node& n : nodes) n.mass = total > 0 ? n.mass / total * expected_.value[bin] : 0;
  return nodes;
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
