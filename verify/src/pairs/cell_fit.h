#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plumbline/verify/detail/domain.h>

namespace plumbline::verify {

struct Box {
  Point2 low{0, 0}, high{1, 1};

  double area() const { return (high[0] - low[0]) * (high[1] - low[1]); }
};

/// A function on a box in Legendre polynomials up to the third degree in each coordinate, through
/// its values at Gauss's nodes. Its integral is Gauss's rule, exact up to the seventh degree.
class CellFit {
 public:
  static constexpr std::size_t kNodes = 4;  // per dimension

  /// Points of one box that a fit takes: Gauss's nodes, then probes on its border.
  static constexpr std::size_t points(int dimension) { return dimension == 1 ? 4 + 2 : 16 + 8; }

  /// Adds the points of a box.
  static void add_points(const Box& box, int dimension, std::vector<Point2>& points);

  /// @param dimension  1: the function depends on the first coordinate alone
  /// @param values     of the function at the points of the box
  CellFit(const Box& box, int dimension, std::span<const double> values);

  double integral() const { return area_ * coefficients_[0][0]; }
  double at(const Point2& p) const;

  /// Root mean square of what the fit may be off by: of the part of the highest degree, far more
  /// than what is left where the function is smooth, or of what probes on the border show beyond
  /// the nodes.
  double tail() const { return tail_; }

  /// The coordinate along which the highest degree weighs more.
  std::size_t rough_dimension() const { return rough_; }

  bool finite() const { return finite_; }

 private:
  void fit(int dimension, std::span<const double> values);
  void probe_border(int dimension, std::span<const double> values);

  Point2 center_, scale_;
  double area_ = 0, tail_ = 0;
  std::size_t rough_ = 0;
  bool finite_ = true;
  std::array<std::array<double, kNodes>, kNodes> coefficients_{};  // of x, of y
};

}  // namespace plumbline::verify
