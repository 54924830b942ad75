#include "binned_pair.h"

#include <cmath>
#include <numbers>

namespace plumbline::verify {

namespace {

constexpr std::size_t kPilotsPerBin = 16;
constexpr std::uint64_t kMaxEvaluations = 6'000'000;
// A float direction that rounding put outside the support is within a few 2^-24 of it.
constexpr double kRoundingDistance = 2e-6;

bool finite(const Vec3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

std::vector<Point2> draw_pilot(const ChartedPair& pair, std::size_t count, std::uint64_t seed) {
  Random random(seed, 1);
  std::vector<Point2> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = pair.sample(random);
    if (x && finite(*x)) points.push_back(pair.chart->to_square(*x));
  }
  return points;
}

}  // namespace

BinnedPair::BinnedPair(const ChartedPair& pair, int depth, double mass_error, std::uint64_t seed)
    : pair_(pair),
      random_(seed, 2),
      pilot_(draw_pilot(pair, kPilotsPerBin << depth, seed)),
      tree_(pilot_, depth) {
  const double measure = pair.chart->measure();
  const auto density = [&](const Point2& p) {
    return measure * pair.density(pair.chart->from_square(p));
  };
  std::vector<Cell> cells;
  for (std::size_t bin = 0; bin < tree_.bins(); ++bin) {
    if (shows_zero(density, tree_.box(bin))) {
      tree_.add_cells_around_points(bin, pilot_, cells);
    } else {
      cells.push_back(tree_.cell(bin));
    }
  }
  expected_ = integrate(density, cells, pilot_, tree_.bins(), mass_error, kMaxEvaluations);
  counts_.bins.assign(tree_.bins(), 0);
}

void BinnedPair::draw(std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto x = pair_.sample(random_);
    if (x) {
      classify(*x);
    } else {
      ++counts_.rejected;
    }
  }
  counts_.drawn += count;
}

void BinnedPair::classify(const Vec3& x) {
  const double density = finite(x) ? pair_.density(x) : -1;
  if (!(density >= 0) || std::isinf(density)) {
    ++counts_.not_finite;
    counts_.not_finite_at = x;
    return;
  }
  if (density == 0) {
    bool near_support = false;
    for (int k = 0; k < 8 && !near_support; ++k) {
      const double angle = k * std::numbers::pi / 4;
      near_support = pair_.density(pair_.chart->near(x, kRoundingDistance, angle)) > 0;
    }
    if (!near_support) {
      ++counts_.stray;
      counts_.stray_at = x;
    }
  }
  ++counts_.bins[tree_.locate(pair_.chart->to_square(x))];
}

Vec3 BinnedPair::center(int depth, std::size_t bin) const {
  // The finest bin in the middle of the coarser one's range stands for it.
  const int finer = tree_.depth() - depth;
  const std::size_t fine = (bin << finer) + ((std::size_t{1} << finer) >> 1);
  const Box& box = tree_.box(fine);
  return pair_.chart->from_square({(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2});
}

}  // namespace plumbline::verify
