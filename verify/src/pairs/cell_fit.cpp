#include "pairs/cell_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace plumbline::verify {

namespace {

constexpr std::size_t kNodes = CellFit::kNodes;
using Row = std::array<double, kNodes>;

/// Gauss–Legendre with four nodes on [−1, 1]: x² = 3/7 ± 2/7 √(6/5). Weights for the mean, half of
/// (18 ± √30)/36.
constexpr Row kPlaces = {-0.86113631159405257522, -0.33998104358485626480, 0.33998104358485626480,
                         0.86113631159405257522};
constexpr Row kWeights = {0.17392742256872692869, 0.32607257743127307131, 0.32607257743127307131,
                          0.17392742256872692869};

/// Legendre polynomials that are orthonormal for the mean over [−1, 1]: √(2i + 1) P_i.
Row legendre(double x) {
  return {1.0, std::sqrt(3.0) * x, std::sqrt(5.0) * (1.5 * x * x - 0.5),
          std::sqrt(7.0) * x * (2.5 * x * x - 1.5)};
}

const std::array<Row, kNodes> kAtPlaces = {legendre(kPlaces[0]), legendre(kPlaces[1]),
                                           legendre(kPlaces[2]), legendre(kPlaces[3])};

// The outermost nodes leave 0.069 of the width beyond them; a jump there would never be seen.
constexpr double kUnseen = 0.0694;
constexpr double kInside = 1 - 1e-6;  // not on the line along which two cells meet

/// A point of the border: of each coordinate −1, 0 or 1, where it lies.
struct Side {
  int s, t;
};

/// Corners and middles of the sides.
std::vector<Side> sides_of(int dimension) {
  std::vector<Side> sides;
  for (const int s : {-1, 0, 1}) {
    for (const int t : {-1, 0, 1}) {
      if ((s != 0 || t != 0) && (dimension == 2 || t == 0)) sides.push_back({s, t});
    }
  }
  return sides;
}

const std::array<std::vector<Side>, 2> kSidesByDimension = {sides_of(1), sides_of(2)};

const std::vector<Side>& border(int dimension) {
  return kSidesByDimension[static_cast<std::size_t>(dimension - 1)];
}

Point2 center_of(const Box& box) {
  return {(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2};
}

Point2 scale_of(const Box& box) {
  return {(box.high[0] - box.low[0]) / 2, (box.high[1] - box.low[1]) / 2};
}

Point2 border_point(const Point2& center, const Point2& scale, const Side& side) {
  return {center[0] + kInside * side.s * scale[0], center[1] + kInside * side.t * scale[1]};
}

}  // namespace

void CellFit::add_points(const Box& box, int dimension, std::vector<Point2>& points) {
  const Point2 center = center_of(box), scale = scale_of(box);
  for (const double x : kPlaces) {
    if (dimension == 1) {
      points.push_back({center[0] + scale[0] * x, center[1]});
      continue;
    }
    for (const double y : kPlaces) {
      points.push_back({center[0] + scale[0] * x, center[1] + scale[1] * y});
    }
  }
  for (const Side& side : border(dimension)) points.push_back(border_point(center, scale, side));
}

CellFit::CellFit(const Box& box, int dimension, std::span<const double> values)
    : center_(center_of(box)), scale_(scale_of(box)), area_(box.area()) {
  const std::size_t nodes = dimension == 1 ? kNodes : kNodes * kNodes;
  fit(dimension, values.first(nodes));
  probe_border(dimension, values.subspan(nodes));
}

void CellFit::fit(int dimension, std::span<const double> values) {
  const std::size_t across = dimension == 1 ? 1 : kNodes;
  for (std::size_t k = 0; k < kNodes; ++k) {
    Row along_y{};
    for (std::size_t l = 0; l < across; ++l) {
      double value = values[k * across + l];
      if (!std::isfinite(value)) {
        finite_ = false;
        value = 0;
      }
      if (dimension == 1) {
        along_y[0] = value;
      } else {
        for (std::size_t j = 0; j < kNodes; ++j) {
          along_y[j] += kWeights[l] * value * kAtPlaces[l][j];
        }
      }
    }
    for (std::size_t i = 0; i < kNodes; ++i) {
      for (std::size_t j = 0; j < kNodes; ++j) {
        coefficients_[i][j] += kWeights[k] * kAtPlaces[k][i] * along_y[j];
      }
    }
  }
  double of_x = 0, of_y = 0;
  for (std::size_t i = 0; i < kNodes; ++i) {
    of_x += coefficients_[kNodes - 1][i] * coefficients_[kNodes - 1][i];
    of_y += coefficients_[i][kNodes - 1] * coefficients_[i][kNodes - 1];
  }
  tail_ = std::sqrt(of_x + of_y);
  rough_ = of_x >= of_y ? 0 : 1;
}

void CellFit::probe_border(int dimension, std::span<const double> values) {
  std::array<double, 2> squares{};
  double largest = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Side& side = border(dimension)[i];
    if (!std::isfinite(values[i])) {
      finite_ = false;
      continue;
    }
    const double apart = values[i] - at(border_point(center_, scale_, side));
    const double off = apart * apart;
    largest = std::max(largest, off);
    if (side.s != 0) squares[0] += off;
    if (side.t != 0) squares[1] += off;
  }
  const double at_border = std::sqrt(kUnseen * largest);
  if (at_border <= tail_) return;
  tail_ = at_border;
  rough_ = squares[0] >= squares[1] ? 0 : 1;
}

double CellFit::at(const Point2& p) const {
  const Row x = legendre(scale_[0] > 0 ? (p[0] - center_[0]) / scale_[0] : 0);
  const Row y = legendre(scale_[1] > 0 ? (p[1] - center_[1]) / scale_[1] : 0);
  double sum = 0;
  for (std::size_t i = 0; i < kNodes; ++i) {
    double along_y = 0;
    for (std::size_t j = 0; j < kNodes; ++j) along_y += coefficients_[i][j] * y[j];
    sum += x[i] * along_y;
  }
  return sum;
}

}  // namespace plumbline::verify
