#include <plumbline/renderer/core/scene/geometry.h>

#include <new>
#include <string>

#include <plumbline/renderer/core/errors.h>

namespace plumbline::renderer {
namespace {

struct SurfacePoint {
  Vec3f position, normal;
  float magnitude;  // what ray_offset asks for
};

SurfacePoint point_of_plane(const Corners& corners, float u, float v, const Vec3f& normal) {
  const Vec3f position = position_on_plane(corners, u, v);
  return {position, normal, plane_magnitude(position, corners.v0, normal)};
}

/// @param raw  o + t·d
SurfacePoint point_of_sphere(const Sphere& sphere, const Vec3d& raw, float facing) {
  const Vec3d center = vec_cast<double>(sphere.center);
  const Vec3d n = normalize(raw - center);
  const Vec3f position = vec_cast<float>(center + n * static_cast<double>(sphere.radius));
  return {position, vec_cast<float>(n) * facing,
          std::max(max_norm(sphere.center), sphere.radius) + max_norm(position)};
}

SurfacePoint point_of_disk(const Disk& disk, const Vec3d& raw, const Vec3f& normal) {
  const Vec3d n = vec_cast<double>(normal);
  const Vec3f position = vec_cast<float>(raw - n * dot(n, raw - vec_cast<double>(disk.center)));
  return {position, normal, plane_magnitude(position, disk.center, normal)};
}

/// As exact as a point in single precision can be.
SurfacePoint point_of_exact(const ExactShape& shape, const Ray& ray, float facing) {
  const ExactShape::Point p = shape.point(ray, shape.distance(ray));
  const Vec3f position = vec_cast<float>(p.position);
  return {position, vec_cast<float>(p.normal) * facing, max_norm(position)};
}

RTCRay embree_ray(const Ray& ray) {
  RTCRay r{};
  r.org_x = ray.origin.x;
  r.org_y = ray.origin.y;
  r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x;
  r.dir_y = ray.direction.y;
  r.dir_z = ray.direction.z;
  r.tnear = kNearest;
  r.tfar = ray.t_max;
  r.mask = ~0u;
  return r;
}

}  // namespace

SceneGeometry::~SceneGeometry() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  if (device_ != nullptr) rtcReleaseDevice(device_);
}

void SceneGeometry::attach(GeometryId id, RTCGeometryType type, RTCFormat format, const void* items,
                           std::size_t item_size, std::size_t item_count,
                           const std::function<void(RTCGeometry)>& more) {
  if (item_count == 0) return;
  RTCGeometry geometry = rtcNewGeometry(device_, type);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, format, items, 0, item_size,
                             item_count);
  if (more) more(geometry);
  attach(id, geometry);
}

void SceneGeometry::attach(GeometryId id, RTCGeometry geometry) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, id);
  rtcReleaseGeometry(geometry);
}

void SceneGeometry::check_device() const {
  switch (const RTCError error = rtcGetDeviceError(device_)) {
    case RTC_ERROR_NONE:
      return;
    case RTC_ERROR_OUT_OF_MEMORY:
      throw std::bad_alloc();
    case RTC_ERROR_UNKNOWN:
      throw MachineError(
          "Embree failed for a reason of its own; is the number of threads limited?");
    default:
      throw InputError("Embree refuses the scene (error " + std::to_string(error) +
                       "): are its coordinates within the range of float?");
  }
}

void SceneGeometry::build() {
  // Embree reads 16 bytes at the last vertex of a float3 buffer: keep one spare element allocated.
  vertices.reserve(vertices.size() + 1);
  disk_normals.reserve(disk_normals.size() + 1);

  device_ = rtcNewDevice(nullptr);
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  attach(kSpheres, RTC_GEOMETRY_TYPE_SPHERE_POINT, RTC_FORMAT_FLOAT4, spheres.data(),
         sizeof(Sphere), spheres.size(), {});
  const auto attach_flat = [&](GeometryId id, RTCGeometryType type, RTCFormat format,
                               const auto& indices) {
    if (indices.empty()) return;
    attach(id, type, RTC_FORMAT_FLOAT3, vertices.data(), sizeof(Vec3f), vertices.size(),
           [&](RTCGeometry geometry) {
             rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, format, indices.data(),
                                        0, sizeof(indices[0]), indices.size());
           });
  };
  attach_flat(kRectangles, RTC_GEOMETRY_TYPE_QUAD, RTC_FORMAT_UINT4, rectangles);
  attach_flat(kTriangles, RTC_GEOMETRY_TYPE_TRIANGLE, RTC_FORMAT_UINT3, triangles);
  attach(kDisks, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT, RTC_FORMAT_FLOAT4, disks.data(),
         sizeof(Disk), disks.size(), [&](RTCGeometry geometry) {
           rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3,
                                      disk_normals.data(), 0, sizeof(Vec3f), disk_normals.size());
         });
  if (!exact.empty()) attach(kExact, make_exact_geometry(device_, exact));
  rtcCommitScene(scene_);
  check_device();
  find_planes();
}

void SceneGeometry::find_planes() {
  for (const unsigned kind : {kTriangles, kRectangles}) {
    for (std::size_t i = 0; i < primitives[kind].size(); ++i) {
      const bool is_triangle = kind == kTriangles;
      const std::uint32_t* at = is_triangle ? triangles[i].data() : rectangles[i].data();
      const Vec3f &v0 = vertices[at[0]], &v1 = vertices[at[1]],
                  &v2 = vertices[at[is_triangle ? 2 : 3]];
      const Vec3d e1 = vec_cast<double>(v1) - vec_cast<double>(v0);
      const Vec3d e2 = vec_cast<double>(v2) - vec_cast<double>(v0);
      Primitive& primitive = primitives[kind][i];
      primitive.corners = {v0, v1, v2};
      primitive.normal = vec_cast<float>(normalize(cross(e1, e2))) * primitive.facing;
    }
  }
  for (std::size_t i = 0; i < disks.size(); ++i) primitives[kDisks][i].normal = disk_normals[i];
}

SurfaceHit SceneGeometry::surface_hit(const Ray& ray, const PrimitiveHit& hit) const {
  const Primitive& primitive = primitives[hit.kind][hit.index];
  const Vec3d raw =
      vec_cast<double>(ray.origin) + vec_cast<double>(ray.direction) * static_cast<double>(hit.t);
  SurfacePoint point;
  if (is_flat(hit.kind)) {
    point = point_of_plane(primitive.corners, hit.u, hit.v, primitive.normal);
  } else if (hit.kind == kSpheres) {
    point = point_of_sphere(spheres[hit.index], raw, primitive.facing);
  } else if (hit.kind == kExact) {
    point = point_of_exact(exact[hit.index], ray, primitive.facing);
  } else {
    point = point_of_disk(disks[hit.index], raw, primitive.normal);
  }
  return {point.position, point.normal, ray_offset(point.magnitude), primitive.bsdf,
          primitive.light_towards(point.normal, ray.direction)};
}

std::optional<SurfaceHit> SceneGeometry::intersect(const Ray& ray) const {
  if (engine_) {
    const std::optional<PrimitiveHit> hit = engine_->intersect(ray);
    if (!hit) return std::nullopt;
    return surface_hit(ray, *hit);
  }
  RTCRayHit ray_hit;
  ray_hit.ray = embree_ray(ray);
  ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree::intersect(scene_, ray_hit);
  const RTCHit& hit = ray_hit.hit;
  if (hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return surface_hit(ray, {hit.geomID, hit.primID, hit.u, hit.v, ray_hit.ray.tfar});
}

bool SceneGeometry::occluded(const Ray& ray) const {
  if (engine_) return engine_->occluded(ray);
  RTCRay r = embree_ray(ray);
  embree::occluded(scene_, r);
  return r.tfar < 0;
}

void SceneGeometry::intersect(const int (&valid)[embree::kPacket], RTCRayHit16& rays,
                              embree::Coherence coherence) const {
  if (engine_) return engine_->intersect(rays);
  embree::intersect(scene_, valid, rays, coherence);
}

void SceneGeometry::occluded(const int (&valid)[embree::kPacket], RTCRay16& rays) const {
  if (engine_) return engine_->occluded(rays);
  embree::occluded(scene_, valid, rays, embree::Coherence::none);
}

std::size_t SceneGeometry::primitive_count() const {
  std::size_t count = 0;
  for (const auto& of_kind : primitives) count += of_kind.size();
  return count;
}

}  // namespace plumbline::renderer
