#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "joints/cube.h"

namespace plumbline::verify {

JointDomain::JointDomain(std::vector<Domain> factors) : factors_(std::move(factors)) {
  if (factors_.empty()) throw std::invalid_argument("JointDomain: needs at least one factor");
  for (const Domain& factor : factors_) {
    if (factor.dimension() == 0) {
      throw std::invalid_argument(
          "JointDomain: a discrete factor has no density; check one pair for each of its items, "
          "with the density given the item");
    }
    dimension_ += factor.dimension();
  }
  if (dimension_ > static_cast<int>(kMostDimensions)) {
    throw std::invalid_argument(
        "JointDomain: " + name() + " has " + std::to_string(dimension_) +
        " dimensions, at most 4 are checked at once; hold some of them fixed and check the density "
        "given those");
  }
}

JointDomain JointDomain::box(const std::vector<Interval>& sides) {
  std::vector<Domain> factors;
  factors.reserve(sides.size());
  for (const Interval& side : sides) factors.push_back(Domain::interval(side.low, side.high));
  return JointDomain(std::move(factors));
}

std::string JointDomain::name() const {
  std::string name;
  for (const Domain& factor : factors_) name += (name.empty() ? "" : " × ") + factor.name();
  return name;
}

namespace {

/// Wavelengths in nanometres and lengths in metres are rounded in proportion to themselves.
double scale_of(const Domain& factor) {
  if (factor.name() != "interval") return 1;
  const Chart& chart = factor.chart();
  return std::max(std::abs(chart.from_square({0, 0.5})[0]),
                  std::abs(chart.from_square({1, 0.5})[0]));
}

std::size_t directions_of(const Domain& factor) { return factor.dimension() == 1 ? 2 : 8; }

}  // namespace

Cube::Cube(const JointDomain& domain) : factors_(domain.factors()) {
  for (std::size_t f = 0; f < factors_.size(); ++f) {
    const auto sides = static_cast<std::size_t>(factors_[f].dimension());
    for (std::size_t side = 0; side < sides; ++side) axes_.push_back({f, side});
    scales_.push_back(scale_of(factors_[f]));
  }
}

namespace {

/// Visits each factor with its part of a point of the cube.
template <class See>
void see_factors(const std::vector<Domain>& factors, const CubePoint& p, const See& see) {
  std::size_t axis = 0;
  for (std::size_t f = 0; f < factors.size(); ++f) {
    const bool plane = factors[f].dimension() == 2;
    see(f, Point2{p[axis], plane ? p[axis + 1] : 0.5});
    axis += plane ? 2 : 1;
  }
}

}  // namespace

JointPoint Cube::from_cube(const CubePoint& p) const {
  JointPoint x{};
  see_factors(factors_, p,
              [&](std::size_t f, const Point2& q) { x[f] = factors_[f].chart().from_square(q); });
  return x;
}

CubePoint Cube::to_cube(const JointPoint& x) const {
  CubePoint p{0.5, 0.5, 0.5, 0.5};
  std::size_t axis = 0;
  for (std::size_t f = 0; f < factors_.size(); ++f) {
    const Point2 q = factors_[f].chart().to_square(x[f]);
    for (int side = 0; side < factors_[f].dimension(); ++side) {
      p[axis++] = q[static_cast<std::size_t>(side)];
    }
  }
  return p;
}

double Cube::element(const CubePoint& p) const {
  double product = 1;
  see_factors(factors_, p,
              [&](std::size_t f, const Point2& q) { product *= factors_[f].chart().element(q); });
  return product;
}

double Cube::distance(const JointPoint& x) const {
  double largest = 0;
  for (std::size_t f = 0; f < factors_.size(); ++f) {
    const double distance = factors_[f].chart().distance(x[f]) / scales_[f];
    if (!(distance <= largest)) largest = distance;
  }
  return largest;
}

JointPoint Cube::near(const JointPoint& x, double distance,
                      const std::array<double, kMostDimensions>& angles) const {
  JointPoint y{};
  for (std::size_t f = 0; f < factors_.size(); ++f) {
    y[f] = factors_[f].chart().near(x[f], distance * scales_[f], angles[f]);
  }
  return y;
}

JointPoint Cube::near(const JointPoint& x, double distance, std::size_t way) const {
  std::array<double, kMostDimensions> angles{};
  for (std::size_t f = 0; f < factors_.size(); ++f) {
    const std::size_t directions = directions_of(factors_[f]);
    angles[f] = 2 * std::numbers::pi * static_cast<double>(way % directions) /
                static_cast<double>(directions);
    way /= directions;
  }
  return near(x, distance, angles);
}

std::size_t Cube::ways() const {
  std::size_t product = 1;
  for (const Domain& factor : factors_) product *= directions_of(factor);
  return product;
}

const std::vector<double>& Cube::breaks(std::size_t d) const {
  return factors_[axes_[d].factor].breaks()[axes_[d].side];
}

}  // namespace plumbline::verify
