#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <plumbline/verify/detail/vector_access.h>

namespace plumbline::verify {

using Point2 = std::array<double, 2>;

/// A map of the unit square onto a domain, on which bins and cubature work. For domains of one
/// dimension only the first coordinate counts.
class Chart {
 public:
  virtual ~Chart() = default;

  virtual Vec3 from_square(const Point2& p) const = 0;
  virtual Point2 to_square(const Vec3& x) const = 0;

  /// Measure of the domain per unit of the square at p: density over the square = density over the
  /// domain · element.
  virtual double element(const Point2& p) const = 0;

  /// A point at about the given distance from x in the domain (or just outside), in direction
  /// `angle`. Tells a point that rounding put beside the support from one that is nowhere near it.
  virtual Vec3 near(const Vec3& x, double distance, double angle) const = 0;

  /// How far x is from the domain, in the units of its coordinates; 0 inside.
  virtual double distance(const Vec3& x) const = 0;
};

/// Where a sampling pair lives, with the measure of its density. A point is three numbers, of which
/// domains of lower dimension use the first ones.
class Domain {
 public:
  /// [low, high], density per unit. @throws std::invalid_argument unless low < high
  static Domain interval(double low = 0, double high = 1);

  /// [0, ∞), density per unit: distances of free flight. Points are finite.
  ///
  /// @param scale  about the size of what is sampled, in the same units. Bins follow the samples
  ///               whatever it is; one that is off by thousands costs evaluations
  /// @throws std::invalid_argument unless 0 < scale < ∞
  static Domain half_line(double scale = 1);

  /// (−∞, ∞), density per unit.
  ///
  /// @param center, scale  about where, and how wide, what is sampled lies
  /// @throws std::invalid_argument unless they are finite and scale > 0
  static Domain line(double center = 0, double scale = 1);

  /// 0, 1, …, size − 1, a probability each. @throws std::invalid_argument for size 0
  static Domain discrete(std::size_t size);

  /// [0, 1]², density per area.
  static Domain unit_square();

  /// Disk around the origin, density per area.
  static Domain disk(double radius = 1);

  /// x, y ≥ 0, x + y ≤ 1: barycentric coordinates of a triangle, density per their area (½ in all).
  static Domain triangle();

  /// Unit directions, density per steradian.
  static Domain sphere();

  /// Unit directions with z ≥ 0 (upper) or z ≤ 0, density per steradian. Points on the other side
  /// are outside; a BSDF that also transmits lives on the sphere.
  static Domain hemisphere(bool upper = true);

  /// Unit directions, density per steradian, on the square (θ/π, φ/2π) of a latitude-longitude map,
  /// with breaks at the edges of its pixels.
  ///
  /// @param up     direction of θ = 0, unit; rows run from it to −up
  /// @param start  direction at right angles to it from which azimuths are counted, either way
  /// @throws std::invalid_argument for a map without pixels, or directions that are not at right
  ///         angles
  static Domain equirectangular(std::size_t columns, std::size_t rows, const Vec3& up = {0, 0, 1},
                                const Vec3& start = {1, 0, 0});

  /// Unit directions, density per steradian, on the square of an octahedral map with breaks at the
  /// edges of its pixels: z from the middle outwards, the lower half folded over the corners.
  ///
  /// @source Cigolle et al. 2014 (JCGT 3:2), "oct"
  /// @throws std::invalid_argument for a map without pixels
  static Domain octahedral(std::size_t pixels_per_side);

  /// Points of a surface, density per area, by a chart of one's own.
  ///
  /// @param from_square   [0, 1]² onto the surface
  /// @param to_square     its inverse
  /// @param area_element  area per unit of the square at a point of the square
  static Domain surface(std::function<Vec3(const Point2&)> from_square,
                        std::function<Point2(const Vec3&)> to_square,
                        std::function<double(const Point2&)> area_element);

  const std::string& name() const { return name_; }
  int dimension() const { return dimension_; }     ///< 0 (discrete), 1 or 2
  std::size_t size() const { return size_; }       ///< number of points if discrete, else 0
  bool directions() const { return directions_; }  ///< points are unit vectors
  const Chart& chart() const { return *chart_; }   ///< not for discrete domains

  /// Coordinates of the square, per dimension and ascending, at which a density may jump or bend:
  /// the horizon of the sphere, the edges of a map's pixels. What lies between them is integrated
  /// by a rule for smooth functions. Unstated jumps cost certainty, not truth: the interval gets
  /// wider.
  const std::array<std::vector<double>, 2>& breaks() const { return breaks_; }

  /// The same domain with further lines, in the coordinates of its chart's square: for `sphere`
  /// ((1 − z)/2, φ/2π), for an interval its share from 0 to 1, for a half-line x/(scale + x), for a
  /// line ½ + atan((x − center)/scale)/π, for a disk (r²/R², φ/2π).
  Domain with_breaks(const std::vector<double>& first,
                     const std::vector<double>& second = {}) const;

 private:
  Domain(std::string name, int dimension, std::shared_ptr<const Chart> chart);
  static Domain of_directions(std::string name, std::shared_ptr<const Chart> chart);

  std::string name_;
  int dimension_ = 2;
  std::size_t size_ = 0;
  bool directions_ = false;
  std::shared_ptr<const Chart> chart_;
  std::array<std::vector<double>, 2> breaks_;
};

}  // namespace plumbline::verify
