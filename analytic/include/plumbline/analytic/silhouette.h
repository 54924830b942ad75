#pragma once

#include <array>

#include <plumbline/analytic/camera.h>
#include <plumbline/analytic/pixel_oracle.h>

namespace plumbline::analytic {

/// Outline of a sphere in a perspective image: an ellipse on the film, and exact areas cut out of
/// it.
class SphereSilhouette {
 public:
  /// @throws std::invalid_argument unless the whole sphere lies in front of the camera, so that its
  ///         outline is an ellipse
  SphereSilhouette(const Camera& camera, const Vec3& center, double radius);

  /// Fraction of the box that the sphere covers, in [0, 1].
  double coverage(const FilmBox& box) const;

 private:
  std::array<double, 2> to_unit_disk(double x, double y) const;

  Camera camera_;
  double center_left_ = 0, center_up_ = 0;             // of the ellipse, on the image plane
  double scale_ll_ = 1, scale_lu_ = 0, scale_uu_ = 1;  // upper triangular map onto the unit disk
};

/// Area shared by the unit disk around the origin and a polygon.
///
/// @param corners  in order; counter-clockwise gives a positive area
double unit_disk_polygon_area(const std::array<std::array<double, 2>, 4>& corners);

}  // namespace plumbline::analytic
