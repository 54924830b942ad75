#include <plumbline/renderer/core/scene/exact_shape.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <plumbline/renderer/core/scene/geometry.h>

namespace plumbline::renderer {
namespace {

constexpr double kMissed = std::numeric_limits<double>::infinity();

double first_after_start(double a, double b) {
  const double near = std::min(a, b), far = std::max(a, b);
  constexpr auto kStart = static_cast<double>(kNearest);
  return near > kStart ? near : (far > kStart ? far : kMissed);
}

}  // namespace

ExactShape::ExactShape(const Vec3d& center, double radius)
    : outline_(Outline::sphere), origin_(center), radius_(radius) {
  const double d = length(center);
  from_center_ = d > 0 ? center * (-radius / d) : Vec3d{0, 0, radius};
  anchor_ = center + from_center_;
}

ExactShape::ExactShape(Outline outline, const Vec3d& origin, const Vec3d& u, const Vec3d& v)
    : outline_(outline), origin_(origin), u_(u), v_(v) {
  const Vec3d n = cross(u, v);
  normal_ = normalize(n);
  along_u_ = cross(v, n) / length_squared(n);
  along_v_ = cross(n, u) / length_squared(n);
  height_ = dot(normal_, origin);
}

ExactShape ExactShape::moved(const Vec3d& center, double scale) const {
  const Vec3d to = (origin_ - center) * scale;
  return is_flat() ? ExactShape(outline_, to, u_ * scale, v_ * scale)
                   : ExactShape(to, radius_ * scale);
}

void ExactShape::lay_onto(const ExactShape& other) {
  if (!is_flat()) {
    *this = other;
    return;
  }
  const double side = dot(normal_, other.normal_) < 0 ? -1.0 : 1.0;
  normal_ = other.normal_ * side;
  height_ = other.height_ * side;
}

// |o + t d − centre|² = r² with all lengths counted from the anchor, so that a ray that starts near
// a huge sphere sees its curve and not the difference of two squares of its radius; and with the
// distance at which a ray passes the centre of a small one far away, for the same reason.
double ExactShape::sphere_distance(const Vec3d& o, const Vec3d& d) const {
  const Vec3d m = o - anchor_;
  const double a = length_squared(d), b = dot(m, d) + dot(from_center_, d);
  const double c = length_squared(m) + 2 * dot(m, from_center_);
  double quarter = b * b - a * c;
  if (length_squared(m) > radius_ * radius_) {
    const Vec3d passes = (o - origin_) - d * (dot(o - origin_, d) / a);
    quarter = a * (radius_ * radius_ - length_squared(passes));
  }
  if (!(quarter >= 0)) return kMissed;
  const double q = -(b + std::copysign(std::sqrt(quarter), b));
  return first_after_start(q / a, c / q);
}

double ExactShape::distance(const Ray& ray) const {
  const Vec3d o = vec_cast<double>(ray.origin), d = vec_cast<double>(ray.direction);
  if (!is_flat()) return sphere_distance(o, d);
  const double t = (height_ - dot(normal_, o)) / dot(normal_, d);
  if (!(t > static_cast<double>(kNearest))) return kMissed;
  const Vec3d q = o + d * t - origin_;
  const double s = dot(q, along_u_), r = dot(q, along_v_);
  const bool inside = outline_ == Outline::disk       ? s * s + r * r <= 1
                      : outline_ == Outline::triangle ? s >= 0 && r >= 0 && s + r <= 1
                                                      : s >= 0 && r >= 0 && s <= 1 && r <= 1;
  if (!inside) return kMissed;
  return t;
}

ExactShape::Point ExactShape::point(const Ray& ray, double distance) const {
  const Vec3d p = vec_cast<double>(ray.origin) + vec_cast<double>(ray.direction) * distance;
  if (is_flat()) return {p, normal_};
  const Vec3d m = p - anchor_, n = normalize(m + from_center_);
  const double outside = (length_squared(m) + 2 * dot(m, from_center_)) / (2 * radius_);
  return {p - n * outside, n};
}

ExactShape::Box ExactShape::box() const {
  const auto [low_x, high_x] = range(origin_.x, u_.x, v_.x);
  const auto [low_y, high_y] = range(origin_.y, u_.y, v_.y);
  const auto [low_z, high_z] = range(origin_.z, u_.z, v_.z);
  return {{low_x, low_y, low_z}, {high_x, high_y, high_z}};
}

std::pair<double, double> ExactShape::range(double o, double u, double v) const {
  if (outline_ == Outline::triangle) return std::minmax({o, o + u, o + v});
  if (outline_ == Outline::parallelogram) return std::minmax({o, o + u, o + u + v, o + v});
  const double half = is_flat() ? std::hypot(u, v) : radius_;
  return {o - half, o + half};
}

namespace {

/// One ray of those that Embree asks for together.
Ray ray_of(RTCRayN* rays, unsigned n, unsigned i) {
  return {{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
          {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)}};
}

const ExactShape& shape_of(void* shapes, unsigned index) {
  return (*static_cast<const std::vector<ExactShape>*>(shapes))[index];
}

void find_bounds(const RTCBoundsFunctionArguments* asked) {
  const auto [low, high] = shape_of(asked->geometryUserPtr, asked->primID).box();
  const auto below = [](double x) { return static_cast<float>(x - std::abs(x) * 0x1p-22); };
  const auto above = [](double x) { return static_cast<float>(x + std::abs(x) * 0x1p-22); };
  RTCBounds& bounds = *asked->bounds_o;
  bounds.lower_x = below(low.x);
  bounds.lower_y = below(low.y);
  bounds.lower_z = below(low.z);
  bounds.upper_x = above(high.x);
  bounds.upper_y = above(high.y);
  bounds.upper_z = above(high.z);
}

void intersect(const RTCIntersectFunctionNArguments* asked) {
  const unsigned n = asked->N;
  RTCRayN* rays = RTCRayHitN_RayN(asked->rayhit, n);
  RTCHitN* hits = RTCRayHitN_HitN(asked->rayhit, n);
  const ExactShape& shape = shape_of(asked->geometryUserPtr, asked->primID);
  for (unsigned i = 0; i < n; ++i) {
    if (asked->valid[i] != -1) continue;
    const auto t = static_cast<float>(shape.distance(ray_of(rays, n, i)));
    float& nearest = RTCRayN_tfar(rays, n, i);
    const bool first_of_two = t == nearest && RTCHitN_geomID(hits, n, i) == asked->geomID &&
                              asked->primID < RTCHitN_primID(hits, n, i);
    if (!(t < nearest || first_of_two)) continue;
    nearest = t;
    RTCHitN_primID(hits, n, i) = asked->primID;
    RTCHitN_geomID(hits, n, i) = asked->geomID;
  }
}

void occlude(const RTCOccludedFunctionNArguments* asked) {
  const ExactShape& shape = shape_of(asked->geometryUserPtr, asked->primID);
  for (unsigned i = 0; i < asked->N; ++i) {
    float& end = RTCRayN_tfar(asked->ray, asked->N, i);
    const bool blocked = asked->valid[i] == -1 &&
                         shape.distance(ray_of(asked->ray, asked->N, i)) < static_cast<double>(end);
    if (blocked) end = -std::numeric_limits<float>::infinity();
  }
}

}  // namespace

RTCGeometry make_exact_geometry(RTCDevice device, const std::vector<ExactShape>& shapes) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(shapes.size()));
  rtcSetGeometryUserData(geometry, const_cast<std::vector<ExactShape>*>(&shapes));
  rtcSetGeometryBoundsFunction(geometry, find_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcSetGeometryOccludedFunction(geometry, occlude);
  return geometry;
}

}  // namespace plumbline::renderer
