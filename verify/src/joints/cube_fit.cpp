#include "joints/cube_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plumbline::verify {

namespace {

// Nodes per coefficient: enough that what they leave says how far the fit is off.
constexpr std::size_t kNodesPerTerm = 4;

/// The root of x^(d+1) = x + 1, whose powers spread a sequence evenly in d dimensions.
double spread_root(std::size_t dimension) {
  double x = 1.5;
  for (int i = 0; i < 60; ++i) x = std::pow(1 + x, 1 / static_cast<double>(dimension + 1));
  return x;
}

double inner_product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

CubeFitter::CubeFitter(std::size_t dimension)
    : dimension_(dimension), terms_(1 + 2 * dimension + dimension * (dimension - 1) / 2) {
  const double root = spread_root(dimension);
  for (std::size_t i = 0; i < kNodesPerTerm * terms_; ++i) {
    CubePoint& t = nodes_.emplace_back();
    for (std::size_t d = 0; d < dimension; ++d) {
      const double step = std::pow(root, -static_cast<double>(d + 1));
      const double place = 0.5 + static_cast<double>(i + 1) * step;
      t[d] = 2 * (place - std::floor(place)) - 1;
    }
  }
  solve();
  for (std::size_t d = 0; d < dimension; ++d) {
    halves_.push_back(make_half(d, false));
    halves_.push_back(make_half(d, true));
  }
}

CubeFitter::Row CubeFitter::terms_at(const CubePoint& t) const {
  Row row{};
  row[0] = 1;
  std::size_t k = 1;
  for (std::size_t d = 0; d < dimension_; ++d) row[k++] = t[d];
  for (std::size_t d = 0; d < dimension_; ++d) row[k++] = t[d] * t[d] - 1.0 / 3;
  for (std::size_t d = 0; d < dimension_; ++d) {
    for (std::size_t e = d + 1; e < dimension_; ++e) row[k++] = t[d] * t[e];
  }
  return row;
}

/// (AᵀA)⁻¹Aᵀ by Gauss and Jordan: AᵀA is nearly diagonal, as the nodes are even.
void CubeFitter::solve() {
  std::vector<Row> rows;
  for (const CubePoint& t : nodes_) rows.push_back(terms_at(t));
  std::array<Row, kMostTerms> normal{}, inverse{};
  for (std::size_t i = 0; i < terms_; ++i) {
    inverse[i][i] = 1;
    for (std::size_t j = 0; j < terms_; ++j) {
      for (const Row& row : rows) normal[i][j] += row[i] * row[j];
    }
  }
  for (std::size_t i = 0; i < terms_; ++i) {
    const double pivot = normal[i][i];
    for (std::size_t j = 0; j < terms_; ++j) normal[i][j] /= pivot, inverse[i][j] /= pivot;
    for (std::size_t k = 0; k < terms_; ++k) {
      const double factor = k == i ? 0 : normal[k][i];
      for (std::size_t j = 0; j < terms_; ++j) {
        normal[k][j] -= factor * normal[i][j];
        inverse[k][j] -= factor * inverse[i][j];
      }
    }
  }
  for (const Row& row : rows) {
    Row& to = projection_.emplace_back();
    for (std::size_t i = 0; i < terms_; ++i) {
      for (std::size_t j = 0; j < terms_; ++j) to[i] += inverse[i][j] * row[j];
    }
  }
}

CubeFitter::Half CubeFitter::make_half(std::size_t d, bool upper) const {
  Half half;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if ((nodes_[i][d] > 0) == upper) half.members.push_back(i);
  }
  for (std::size_t k = 0; k <= dimension_; ++k) {
    std::vector<double> column;
    for (const std::size_t i : half.members) column.push_back(k == 0 ? 1 : nodes_[i][k - 1]);
    for (const std::vector<double>& before : half.basis) {
      const double along = inner_product(column, before);
      for (std::size_t i = 0; i < column.size(); ++i) column[i] -= along * before[i];
    }
    const double length = std::sqrt(inner_product(column, column));
    for (double& c : column) c /= length;
    half.basis.push_back(std::move(column));
  }
  return half;
}

double CubeFitter::rest_of(const Half& half, std::span<const double> values) {
  std::vector<double> column;
  column.reserve(half.members.size());
  for (const std::size_t i : half.members) column.push_back(values[i]);
  double rest = inner_product(column, column);
  for (const std::vector<double>& b : half.basis) rest -= std::pow(inner_product(column, b), 2);
  return std::sqrt(std::max(rest, 0.0));
}

void CubeFitter::add_nodes(const CubeBox& box, std::vector<CubePoint>& points) const {
  for (const CubePoint& t : nodes_) {
    CubePoint& p = points.emplace_back(box.center());
    for (std::size_t d = 0; d < dimension_; ++d) p[d] += t[d] * box.size(d) / 2;
  }
}

CubeFit CubeFitter::fit(std::span<const double> values) const {
  CubeFit fit;
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t k = 0; k < terms_; ++k) fit.coefficients[k] += projection_[i][k] * values[i];
  }
  double squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Row row = terms_at(nodes_[i]);
    double off = values[i];
    for (std::size_t k = 0; k < terms_; ++k) off -= row[k] * fit.coefficients[k];
    squares += off * off;
  }
  fit.rest = std::sqrt(squares / static_cast<double>(values.size() - terms_));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < dimension_; ++d) {
    const double rest = rest_of(halves_[2 * d], values) + rest_of(halves_[2 * d + 1], values);
    if (rest < least) least = rest, fit.cut = d;
  }
  return fit;
}

double CubeFitter::at(const CubeFit& fit, const CubeBox& box, const CubePoint& p) const {
  CubePoint t{};
  for (std::size_t d = 0; d < dimension_; ++d) {
    t[d] = (2 * p[d] - box.low[d] - box.high[d]) / std::max(box.size(d), 1e-300);
  }
  const Row row = terms_at(t);
  double value = 0;
  for (std::size_t k = 0; k < terms_; ++k) value += row[k] * fit.coefficients[k];
  return value;
}

}  // namespace plumbline::verify
