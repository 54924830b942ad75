#include "pairs/edge_rule.h"

#include <array>
#include <cmath>
#include <numbers>

namespace plumbline::verify {

namespace {

struct Node {
  double x, kronrod, gauss;
};
/// On [0, 1].
constexpr std::array<Node, 7> kNodes = {{
    {0.5 - 0.480245634354010142, 0.0523281130132336326, 0},
    {0.5 - 0.387298334620741689, 0.134244044934166720, 5.0 / 18},
    {0.5 - 0.217121874673401279, 0.200698707387981111, 0},
    {0.5, 0.225458269329237071, 8.0 / 18},
    {0.5 + 0.217121874673401279, 0.200698707387981111, 0},
    {0.5 + 0.387298334620741689, 0.134244044934166720, 5.0 / 18},
    {0.5 + 0.480245634354010142, 0.0523281130132336326, 0},
}};

struct Pair {
  double kronrod = 0, gauss = 0;
  double unknown = 0;  // by how much the place of the edges leaves it open
  double error() const { return std::abs(kronrod - gauss) + unknown; }
};

/// f along one line through the box.
class Line {
 public:
  Line(const std::function<double(const Point2&)>& f, std::size_t along, double beside)
      : f_(f), along_(along), beside_(beside) {}

  Pair integrate(double low, double high) {
    constexpr int kProbes = 4;
    double start = low;
    bool inside = positive(low), starts_at_edge = false;
    for (int i = 1; i <= kProbes; ++i) {
      const double from = low + (high - low) * (i - 1) / kProbes;
      const double to = i == kProbes ? high : low + (high - low) * i / kProbes;
      if (positive(to) == inside) continue;
      const double edge = bisect(from, to, inside);
      if (inside) add(start, edge, starts_at_edge, true);
      start = edge;
      starts_at_edge = true;
      inside = !inside;
    }
    if (inside) add(start, high, starts_at_edge, false);
    return sum_;
  }

  std::uint64_t evaluations() const { return evaluations_; }

 private:
  double at(double x) {
    ++evaluations_;
    return along_ == 0 ? f_({x, beside_}) : f_({beside_, x});
  }

  // A density like 1/√distance is off by the square root of what the edge is off by.
  static constexpr int kHalvings = 30;

  bool positive(double x) { return at(x) != 0; }

  double bisect(double from, double to, bool inside_at_from) {
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (from + to) / 2;
      (positive(middle) == inside_at_from ? from : to) = middle;
    }
    return inside_at_from ? from : to;
  }

  void add(double low, double high, bool edge_at_low, bool edge_at_high) {
    const double length = high - low;
    const Pair before = sum_;
    for (const Node& n : kNodes) {
      double x = n.x, slope = 1;
      if (edge_at_low && edge_at_high) {
        x = std::pow(std::sin(std::numbers::pi / 2 * n.x), 2);
        slope = std::numbers::pi / 2 * std::sin(std::numbers::pi * n.x);
      } else if (edge_at_low) {
        x = n.x * n.x;
        slope = 2 * n.x;
      } else if (edge_at_high) {
        x = 1 - n.x * n.x;
        slope = 2 * n.x;
      }
      const double value = at(low + length * x) * slope * length;
      sum_.kronrod += n.kronrod * value;
      sum_.gauss += n.gauss * value;
    }
    if (edge_at_low || edge_at_high) {
      sum_.unknown += std::ldexp(std::abs(sum_.kronrod - before.kronrod), -kHalvings / 2);
    }
  }

  const std::function<double(const Point2&)>& f_;
  std::size_t along_;
  double beside_;
  Pair sum_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace

EdgeEstimate integrate_across_edge(const std::function<double(const Point2&)>& f, const Box& box,
                                   std::size_t across) {
  const std::size_t beside = 1 - across;
  const double width = box.high[beside] - box.low[beside];
  EdgeEstimate e;
  Pair sum;
  for (const Node& n : kNodes) {
    Line line(f, across, box.low[beside] + width * n.x);
    const Pair along = line.integrate(box.low[across], box.high[across]);
    sum.kronrod += n.kronrod * width * along.kronrod;
    sum.gauss += n.gauss * width * along.kronrod;
    e.across += n.kronrod * width * along.error();
    e.evaluations += line.evaluations();
  }
  e.value = sum.kronrod;
  e.beside = sum.error();
  return e;
}

}  // namespace plumbline::verify
