#include "pairs/cubature.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "pairs/edge_rule.h"

namespace plumbline::verify {

namespace {

using Integrand = std::function<double(const Point2&)>;

struct Estimate {
  Cell cell;
  double value = 0, error = 0;
  int split = 0;  // dimension to halve
  int depth = 0;
  bool sees_zero = false;
  double cut_off = 0;  // value at an edge of the support that runs through
  std::uint64_t evaluations = 0;

  bool operator<(const Estimate& other) const { return error < other.error; }
};

/// Where a cell shows the density to be 0, and where not.
class SupportEdge {
 public:
  void see(double s, double t, double value) {
    Group& group = value == 0 ? zero_ : positive_;
    group.sum = {group.sum[0] + s, group.sum[1] + t};
    ++group.count;
    largest_ = std::max(largest_, std::abs(value));
  }

  bool sees_zero() const { return zero_.count > 0; }
  bool crosses() const { return sees_zero() && positive_.count > 0; }
  double largest() const { return largest_; }

  /// The dimension along which zeros lie apart from the rest.
  std::size_t across() const { return apart(0) >= apart(1) ? 0 : 1; }

 private:
  struct Group {
    Point2 sum{0, 0};
    double count = 0;
  };
  double apart(std::size_t d) const {
    return std::abs(zero_.sum[d] / zero_.count - positive_.sum[d] / positive_.count);
  }
  Group zero_, positive_;
  double largest_ = 0;
};

/// Genz–Malik 1980, Table 1 with n = 2: λ₂ = √(9/70), λ₃ = λ₄ = √(9/10), λ₅ = √(9/19).
///
/// @param border  look at corners and sides too: an edge of the support may be near
Estimate apply_rule(const Integrand& f, const Cell& cell, bool border) {
  static const double kL2 = std::sqrt(9.0 / 70), kL4 = std::sqrt(9.0 / 10),
                      kL5 = std::sqrt(9.0 / 19);
  constexpr double kW1 = -3816.0 / 19683, kW2 = 980.0 / 6561, kW3 = 1020.0 / 19683,
                   kW4 = 200.0 / 19683, kW5 = 6859.0 / 19683 / 4;
  constexpr double kE1 = -971.0 / 729, kE2 = 245.0 / 486, kE3 = 65.0 / 1458, kE4 = 25.0 / 729;

  const Box& box = cell.box;
  const Point2 center{(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2};
  const Point2 half{(box.high[0] - box.low[0]) / 2, (box.high[1] - box.low[1]) / 2};
  SupportEdge edge;
  const auto at = [&](double s, double t) {
    const double value = f({center[0] + s * half[0], center[1] + t * half[1]});
    edge.see(s, t, value);
    return value;
  };
  const double f0 = at(0, 0);
  double sum2 = 0, sum3 = 0;
  Point2 fourth;
  for (std::size_t d = 0; d < 2; ++d) {
    const double s = d == 0 ? 1 : 0, t = d == 0 ? 0 : 1;
    const double inner = at(kL2 * s, kL2 * t) + at(-kL2 * s, -kL2 * t);
    const double outer = at(kL4 * s, kL4 * t) + at(-kL4 * s, -kL4 * t);
    sum2 += inner;
    sum3 += outer;
    // Ratio λ₂²/λ₄² = 1/7 cancels the second difference.
    fourth[d] = std::abs(inner - 2 * f0 - (outer - 2 * f0) / 7);
  }
  const double sum4 = at(kL4, kL4) + at(kL4, -kL4) + at(-kL4, kL4) + at(-kL4, -kL4);
  const double sum5 = at(kL5, kL5) + at(kL5, -kL5) + at(-kL5, kL5) + at(-kL5, -kL5);

  const double area = 4 * half[0] * half[1];
  const double degree7 = area * (kW1 * f0 + kW2 * sum2 + kW3 * sum3 + kW4 * sum4 + kW5 * sum5);
  const double degree5 = area * (kE1 * f0 + kE2 * sum2 + kE3 * sum3 + kE4 * sum4);
  Estimate e{cell, degree7, std::abs(degree7 - degree5), fourth[0] >= fourth[1] ? 0 : 1};
  e.evaluations = 17;
  if (border) {
    for (const double s : {-1.0, 0.0, 1.0}) {
      for (const double t : {-1.0, 0.0, 1.0}) {
        if (s != 0 || t != 0) at(s, t);
      }
    }
    e.evaluations += 8;
  }
  e.sees_zero = edge.sees_zero();
  if (edge.crosses()) {
    const std::size_t across = edge.across();
    const EdgeEstimate lines = integrate_across_edge(f, box, across);
    e.value = lines.value;
    e.error = lines.across + lines.beside;
    e.evaluations += lines.evaluations;
    e.split = static_cast<int>(lines.across > lines.beside ? across : 1 - across);
    e.cut_off = edge.largest();
  }
  return e;
}

// The outermost nodes leave 0.026 of a cell beyond them, on each side. What an edge cuts off there
// without showing at a corner or the middle of a side is a sliver of less than half a side.
constexpr double kUnseen = 0.026 * 0.026 / 8;

class Integrator {
 public:
  Integrator(const Integrand& f, std::vector<Point2>& points, std::size_t bins)
      : f_(f), points_(points) {
    result_.value.assign(bins, 0.0);
    result_.error.assign(bins, 0.0);
  }

  void add(const Cell& cell, int depth) {
    Estimate e = apply_rule(f_, cell, cell.edge_doubt > 0 || cell.doubt > 0);
    e.depth = depth;
    if (e.value == 0) e.split = depth % 2;
    heed_points(e);
    heed_slivers(e);
    // Next to an edge, or far from all pilot points, agreeing nodes prove little.
    const bool crosses = e.cut_off > 0;
    const bool has_points = e.cell.first < e.cell.last;
    if (crosses ? !has_points : e.value == 0 || e.cell.edge_doubt > 0) {
      e.error = std::max(e.error, e.cell.doubt);
    }
    if (!crosses) e.error = std::max(e.error, e.cell.edge_doubt);
    result_.evaluations += e.evaluations;
    count_error(e, 1);
    queue_.push(e);
  }

  void refine(double target, std::uint64_t max_evaluations) {
    while (!(error() <= target) && result_.evaluations < max_evaluations && !queue_.empty()) {
      const Estimate worst = queue_.top();
      if (!std::isfinite(worst.error)) break;
      queue_.pop();
      count_error(worst, -1);
      Cell low = worst.cell, high = worst.cell;
      const std::size_t d = static_cast<std::size_t>(worst.split);
      const double middle = (low.box.low[d] + low.box.high[d]) / 2;
      low.box.high[d] = high.box.low[d] = middle;
      const auto at = [&](std::size_t i) {
        return points_.begin() + static_cast<std::ptrdiff_t>(i);
      };
      const auto cut = std::partition(at(low.first), at(low.last),
                                      [&](const Point2& p) { return p[d] < middle; });
      low.last = high.first = static_cast<std::size_t>(cut - points_.begin());
      divide_doubt(worst, low);
      divide_doubt(worst, high);
      add(low, worst.depth + 1);
      add(high, worst.depth + 1);
    }
  }

  CubatureResult finish() {
    sum_ = sum_squares_ = 0;  // again, without the rounding of all the updates
    for (; !queue_.empty(); queue_.pop()) {
      const Estimate& e = queue_.top();
      result_.finite = result_.finite && std::isfinite(e.value);
      result_.value[e.cell.bin] += e.value;
      result_.error[e.cell.bin] += e.error;
      result_.total += e.value;
      count_error(e, 1);
    }
    result_.total_error = error();
    return result_;
  }

 private:
  static void divide_doubt(const Estimate& parent, Cell& child) {
    child.doubt = parent.cell.doubt / 8;
    const double area =
        (child.box.high[0] - child.box.low[0]) * (child.box.high[1] - child.box.low[1]);
    child.edge_doubt = kUnseen * area * parent.cut_off;
  }

  void count_error(const Estimate& e, int sign) {
    sum_ += sign * e.error;
    sum_squares_ += sign * e.error * e.error;
  }

  double error() const { return 2 * std::sqrt(std::max(0.0, sum_squares_)) + 0.05 * sum_; }

  /// Raises the error of a cell that shows improbably little for its points: with λ expected, c
  /// points come with probability below 0.05 if λ < (c − 0.8)/4.
  void heed_points(Estimate& e) const {
    constexpr int kMaxDepth = 16;
    if (e.depth >= kMaxDepth || e.cell.first == e.cell.last) return;
    const double total = static_cast<double>(points_.size());
    const double count = static_cast<double>(e.cell.last - e.cell.first);
    if (!(e.value * total < (count - 0.8) / 4)) return;
    e.error = std::max(e.error, count / total - e.value);
  }

  /// Raises the error of a cell where a density far above the mean that the rule finds shows
  /// between its nodes and the border: at the middles of the sides, at the corners, or at a pilot
  /// point.
  void heed_slivers(Estimate& e) {
    constexpr double kFarAbove = 32;
    constexpr int kMaxDepth = 64;
    if (e.depth >= kMaxDepth || points_.empty()) return;
    const Box& box = e.cell.box;
    const double area = (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]);
    const Point2 middle{(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2};
    const auto at = [&](double x, double y) { return f_({x, y}); };
    const double across = std::max(at(box.low[0], middle[1]), at(box.high[0], middle[1]));
    const double along = std::max(at(middle[0], box.low[1]), at(middle[0], box.high[1]));
    double elsewhere = std::max({at(box.low[0], box.low[1]), at(box.low[0], box.high[1]),
                                 at(box.high[0], box.low[1]), at(box.high[0], box.high[1])});
    result_.evaluations += 8;
    if (e.cell.first < e.cell.last) elsewhere = std::max(elsewhere, f_(points_[e.cell.first]));
    const double largest = std::max({across, along, elsewhere});
    if (!(largest * area > kFarAbove * e.value)) return;
    const double count = static_cast<double>(std::max(e.cell.last - e.cell.first, std::size_t{1}));
    e.error =
        std::max(e.error, std::min(largest * area, count / static_cast<double>(points_.size())));
    e.split = across == along ? e.depth % 2 : (across > along ? 0 : 1);
    if (elsewhere > 4 * std::max(across, along)) e.split = e.depth % 2;
  }

  const Integrand& f_;
  std::vector<Point2>& points_;
  std::priority_queue<Estimate> queue_;
  double sum_ = 0, sum_squares_ = 0;
  CubatureResult result_;
};

}  // namespace

bool shows_zero(const Integrand& f, const Box& box) {
  return apply_rule(f, Cell{box, 0, 0, 0}, true).sees_zero;
}

CubatureResult integrate(const Integrand& f, const std::vector<Cell>& cells,
                         std::vector<Point2>& points, std::size_t bins, double target,
                         std::uint64_t max_evaluations) {
  Integrator integrator(f, points, bins);
  for (const Cell& cell : cells) integrator.add(cell, 0);
  integrator.refine(target, max_evaluations);
  return integrator.finish();
}

}  // namespace plumbline::verify
