#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <plumbline/verify/joint.h>

/// The unit cube of the charts of a product's factors, on which bins and cells are cut.
namespace plumbline::verify {

inline constexpr std::size_t kMostDimensions = 4;

/// Coordinates beyond the last dimension are ½.
using CubePoint = std::array<double, kMostDimensions>;

/// Sides beyond the last dimension are [0, 1].
struct CubeBox {
  CubePoint low{}, high{1, 1, 1, 1};

  double size(std::size_t d) const { return high[d] - low[d]; }
  double volume() const { return size(0) * size(1) * size(2) * size(3); }
  CubePoint center() const {
    CubePoint p{};
    for (std::size_t d = 0; d < p.size(); ++d) p[d] = (low[d] + high[d]) / 2;
    return p;
  }
};

/// The charts of all factors as one.
class Cube {
 public:
  explicit Cube(const JointDomain& domain);

  std::size_t dimension() const { return axes_.size(); }

  JointPoint from_cube(const CubePoint& p) const;
  CubePoint to_cube(const JointPoint& x) const;

  /// Measure of the product per unit of the cube.
  double element(const CubePoint& p) const;

  /// The largest distance of a factor's point from its domain, in the units of `near`.
  double distance(const JointPoint& x) const;

  /// All factors moved by about the distance, in units of a factor's size: of an interval the
  /// larger of its ends.
  ///
  /// @param angles  in which each goes
  JointPoint near(const JointPoint& x, double distance,
                  const std::array<double, kMostDimensions>& angles) const;

  /// The same in one of `ways()` ways: eight directions in a plane, two on a line, each with each
  /// of the others'. In a corner of a box few of them lead inside.
  JointPoint near(const JointPoint& x, double distance, std::size_t way) const;
  std::size_t ways() const;

  /// Coordinates along a dimension at which a density may jump or bend.
  const std::vector<double>& breaks(std::size_t d) const;

 private:
  struct Axis {
    std::size_t factor, side;
  };

  const std::vector<Domain>& factors_;
  std::vector<Axis> axes_;
  std::vector<double> scales_;  // what a distance of a factor is in its coordinates
};

}  // namespace plumbline::verify
