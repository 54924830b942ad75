#pragma once

#include <utility>
#include <vector>

#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/scene/embree.h>
#include <plumbline/renderer/core/scene/ray.h>

namespace plumbline::renderer {

/// A surface in double, for what single precision cannot hold beside the rest of its scene: a floor
/// that reaches far beyond what stands on it, something small and far, or one of two surfaces in
/// one place. Rays stay in single precision; what they meet of it is found without further
/// rounding.
class ExactShape {
 public:
  enum class Outline { sphere, disk, triangle, parallelogram };

  /// A sphere.
  ExactShape(const Vec3d& center, double radius);

  /// Something flat. Of a disk `origin` is the centre and the edges are radii.
  /// @param u, v  edges from `origin`: perpendicular, but for triangles
  ExactShape(Outline outline, const Vec3d& origin, const Vec3d& u, const Vec3d& v);

  /// The same moved and scaled: (x − center)·scale.
  ExactShape moved(const Vec3d& center, double scale) const;

  /// Distance [m] of the first point that a ray meets after its start; infinity where it misses.
  double distance(const Ray& ray) const;

  /// Puts it where `other` is to the last digit, which it was but for rounding: flat both, or
  /// spheres.
  void lay_onto(const ExactShape& other);

  struct Point {
    Vec3d position, normal;  ///< unit, outwards or along u × v
  };
  /// The point at that distance.
  Point point(const Ray& ray, double distance) const;

  bool is_flat() const { return outline_ != Outline::sphere; }
  const Vec3d& normal() const { return normal_; }  ///< of what is flat
  const Vec3d& origin() const { return origin_; }  ///< corner or centre
  const Vec3d& u() const { return u_; }            ///< edges
  const Vec3d& v() const { return v_; }
  Outline outline() const { return outline_; }
  double radius() const { return radius_; }  ///< of a sphere

  /// Box around it.
  struct Box {
    Vec3d low, high;
  };
  Box box() const;

 private:
  /// Of a coordinate, of which it and the edges have these.
  std::pair<double, double> range(double o, double u, double v) const;
  double sphere_distance(const Vec3d& o, const Vec3d& d) const;

  Outline outline_;
  Vec3d origin_, u_, v_;
  Vec3d normal_{};
  Vec3d along_u_{}, along_v_{};  // products with a vector in the plane give its share of each edge
  double height_ = 0;            // of the plane over the origin, along the normal
  double radius_ = 0;
  Vec3d anchor_{},
      from_center_{};  // point of a sphere nearest to the origin; there from the centre
};

/// Hands them to Embree, which asks them for each ray. Of two that lie equally far the first
/// counts.
/// @param shapes  kept, not copied
RTCGeometry make_exact_geometry(RTCDevice device, const std::vector<ExactShape>& shapes);

}  // namespace plumbline::renderer
