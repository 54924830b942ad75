#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "joints/cube.h"

/// Quadratic fits on the cells of an integral in up to four dimensions.
namespace plumbline::verify {

/// 1, tᵢ, tᵢ² − ⅓, tᵢtⱼ in four dimensions.
inline constexpr std::size_t kMostTerms = 15;

/// A quadratic on a box, in coordinates t from −1 to 1. All terms but the first integrate to 0.
struct CubeFit {
  std::array<double, kMostTerms> coefficients{};
  double rest = 0;      ///< root mean square of what it leaves at its nodes
  std::size_t cut = 0;  ///< dimension in which halves would be fitted best

  double mean() const { return coefficients[0]; }
};

/// Where a fit is made, the same in every cell: random corrections are what makes an integral true.
///
/// @source nodes: Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"
class CubeFitter {
 public:
  /// @param dimension  1 to 4
  explicit CubeFitter(std::size_t dimension);

  std::size_t nodes() const { return nodes_.size(); }
  void add_nodes(const CubeBox& box, std::vector<CubePoint>& points) const;

  /// @param values  at the nodes
  CubeFit fit(std::span<const double> values) const;

  /// Value of a fit at a point of its box.
  double at(const CubeFit& fit, const CubeBox& box, const CubePoint& p) const;

 private:
  using Row = std::array<double, kMostTerms>;

  /// One half of the nodes, with an orthonormal basis of the linear functions on them.
  struct Half {
    std::vector<std::size_t> members;
    std::vector<std::vector<double>> basis;
  };

  Row terms_at(const CubePoint& t) const;
  void solve();
  Half make_half(std::size_t d, bool upper) const;
  static double rest_of(const Half& half, std::span<const double> values);

  std::size_t dimension_, terms_;
  std::vector<CubePoint> nodes_;  // t
  std::vector<Row> projection_;   // of the values at each node onto the coefficients
  std::vector<Half> halves_;      // lower and upper of each dimension
};

}  // namespace plumbline::verify
