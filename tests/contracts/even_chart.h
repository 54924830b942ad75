#pragma once

#include <array>
#include <functional>
#include <vector>

namespace plumbline::tests {

using Direction = std::array<double, 3>;
using SquarePoint = std::array<double, 2>;

/// A map of the unit square onto directions under which a density that is constant in pieces
/// becomes 1 on the square: bins and cubature that work there see no jumps. It is written from the
/// pieces that the density ought to have, in double and without the code under test. A density with
/// other pieces jumps on the square, and a cubature does not certify it.
struct EvenChart {
  std::function<Direction(const SquarePoint&)> from_square;
  std::function<SquarePoint(const Direction&)> to_square;
  std::function<double(const SquarePoint&)> solid_angle;  ///< per unit of the square [sr]
};

/// The pixels of a latitude-longitude image, each as likely as its weight times its solid angle.
///
/// @param weights  row by row from the top, ≥ 0, not all 0
/// @param axes     orthonormal: the left edge of the image is −axes[2], a quarter to the right
///                 axes[0], the top axes[1]
EvenChart pixel_chart(int width, int height, const std::vector<double>& weights,
                      const std::array<Direction, 3>& axes);

/// Half for the cone of directions around the unit vector `axis`, half for those beside it.
EvenChart cone_chart(const Direction& axis, double one_minus_cos);

}  // namespace plumbline::tests
