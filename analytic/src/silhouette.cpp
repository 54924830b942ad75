#include <plumbline/analytic/silhouette.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumbline::analytic {
namespace {

using Point = std::array<double, 2>;

double cross2(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }
double dot2(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1]; }

Point between(const Point& a, const Point& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

double sector(const Point& a, const Point& b) { return 0.5 * std::atan2(cross2(a, b), dot2(a, b)); }

/// Signed area that the triangle (origin, a, b) shares with the unit disk. The edge is cut where it
/// crosses the circle: an inner piece bounds a triangle, an outer piece a circular sector.
double edge_area(const Point& a, const Point& b) {
  const Point edge = {b[0] - a[0], b[1] - a[1]};
  const double length2 = dot2(edge, edge);
  if (length2 == 0) return 0;
  // |a + t·edge|² = 1. The discriminant as length² − cross², which does not cancel for short edges.
  const double half_b = dot2(a, edge);
  const double area2 = cross2(a, edge);
  const double discriminant = length2 - area2 * area2;
  if (!(discriminant > 0)) return sector(a, b);
  const double root = std::sqrt(discriminant);
  const double enter = std::clamp((-half_b - root) / length2, 0.0, 1.0);
  const double leave = std::clamp((-half_b + root) / length2, 0.0, 1.0);
  const Point p = between(a, b, enter);
  const Point q = between(a, b, leave);
  return (enter > 0 ? sector(a, p) : 0) + 0.5 * cross2(p, q) + (leave < 1 ? sector(q, b) : 0);
}

}  // namespace

double unit_disk_polygon_area(const std::array<Point, 4>& corners) {
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    area += edge_area(corners[i], corners[(i + 1) % corners.size()]);
  }
  return area;
}

// A direction w hits the sphere when its angle to the centre's direction c is at most σ, sin σ =
// R/d: (w·c)² ≥ cos²σ |w|². On the image plane w = (l, u, 1), and the condition is a quadric
//   pᵀ A p − 2 bᵀ p + k ≤ 0,  A = cos²σ I − c₂ c₂ᵀ,  b = c₂ c_f,  k = cos²σ − c_f²,
// with c₂ = (c_l, c_u). It is an ellipse when A is positive definite: cos²σ > |c₂|² = 1 − c_f²,
// that is c_f > sin σ, the whole sphere in front of the pinhole. Its centre is A⁻¹b, and completing
// the square leaves (p − centre)ᵀ A (p − centre) ≤ bᵀA⁻¹b − k, mapped onto the unit disk by the
// Cholesky factor.
SphereSilhouette::SphereSilhouette(const Camera& camera, const Vec3& center, double radius)
    : camera_(camera) {
  const Vec3 offset = center - camera.origin;
  const double distance = std::sqrt(dot(offset, offset));
  const Vec3 c = offset * (1 / distance);
  const double cf = dot(c, camera.forward);
  const double sin_sigma = radius / distance;
  if (!(radius > 0 && sin_sigma < 1 && cf > sin_sigma)) {
    throw std::invalid_argument("the sphere is not wholly in front of the camera");
  }
  const double cl = dot(c, camera.left);
  const double cu = dot(c, camera.up);
  const double cos2 = (1 - sin_sigma) * (1 + sin_sigma);
  // A has the eigenvalues cos²σ (across c₂) and cos²σ − |c₂|² = c_f² − sin²σ (along it).
  const double along = (cf - sin_sigma) * (cf + sin_sigma);
  center_left_ = cl * cf / along;
  center_up_ = cu * cf / along;
  // bᵀA⁻¹b − k = c_f² |c₂|²/along − (cos²σ − c_f²) = cos²σ sin²σ/along.
  const double size2 = cos2 * sin_sigma * sin_sigma / along;
  const double a_ll = (cos2 - cl * cl) / size2;
  const double a_lu = -cl * cu / size2;
  scale_ll_ = std::sqrt(a_ll);
  scale_lu_ = a_lu / scale_ll_;
  scale_uu_ = std::sqrt(cos2 * along) / (size2 * scale_ll_);  // det A = cos²σ · along
}

Point SphereSilhouette::to_unit_disk(double x, double y) const {
  const double l = camera_.plane_left(x) - center_left_;
  const double u = camera_.plane_up(y) - center_up_;
  return {scale_ll_ * l + scale_lu_ * u, scale_uu_ * u};
}

double SphereSilhouette::coverage(const FilmBox& box) const {
  const double shared =
      unit_disk_polygon_area({to_unit_disk(box.x0, box.y0), to_unit_disk(box.x1, box.y0),
                              to_unit_disk(box.x1, box.y1), to_unit_disk(box.x0, box.y1)});
  const double pitch = camera_.pixel_pitch();
  const double whole =
      (box.x1 - box.x0) * (box.y1 - box.y0) * pitch * pitch * scale_ll_ * scale_uu_;
  // Left runs against x and up against y: two flips keep the orientation.
  return std::clamp(shared / whole, 0.0, 1.0);
}

}  // namespace plumbline::analytic
