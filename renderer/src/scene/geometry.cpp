#include "geometry.h"

#include <limits>
#include <new>
#include <string>

namespace plumbline::renderer {
namespace {

/// Error of a plane's position near p as Embree sees it: it subtracts the ray origin from a corner,
/// so the rounding error along the normal is that of the corner's coordinates weighted by the
/// normal. A wall aligned with an axis has none, however large it is.
float plane_magnitude(const Vec3f& p, const Vec3f& corner, const Vec3f& normal) {
  const Vec3f d = corner - p;
  return max_norm(p) + std::abs(normal.x * d.x) + std::abs(normal.y * d.y) +
         std::abs(normal.z * d.z);
}

RTCRay embree_ray(const Ray& ray) {
  RTCRay r{};
  r.org_x = ray.origin.x;
  r.org_y = ray.origin.y;
  r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x;
  r.dir_y = ray.direction.y;
  r.dir_z = ray.direction.z;
  // Embree counts a hit at 0: a ray from a point that lies on its plane without rounding, as in the
  // middle of a scene, needs no offset and must not meet that plane.
  r.tnear = std::numeric_limits<float>::min();
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
    default:
      throw InputError("Embree refuses the scene (error " + std::to_string(error) +
                       "): are its coordinates within the range of float?");
  }
}

void SceneGeometry::build() {
  // Embree reads 16 bytes at the last vertex of a float3 buffer: keep one spare element allocated.
  rectangle_corners.reserve(rectangle_corners.size() + 1);
  mesh_vertices.reserve(mesh_vertices.size() + 1);
  disk_normals.reserve(disk_normals.size() + 1);

  device_ = rtcNewDevice(nullptr);
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  const auto set_indices = [](RTCGeometry geometry, RTCFormat format, const void* items,
                              std::size_t item_size, std::size_t item_count) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, format, items, 0, item_size,
                               item_count);
  };
  attach(kSpheres, RTC_GEOMETRY_TYPE_SPHERE_POINT, RTC_FORMAT_FLOAT4, spheres.data(),
         sizeof(Sphere), spheres.size(), {});
  attach(kRectangles, RTC_GEOMETRY_TYPE_QUAD, RTC_FORMAT_FLOAT3, rectangle_corners.data(),
         sizeof(Vec3f), rectangle_corners.size(), [&](RTCGeometry geometry) {
           set_indices(geometry, RTC_FORMAT_UINT4, rectangle_indices.data(),
                       4 * sizeof(std::uint32_t), rectangle_indices.size() / 4);
         });
  attach(kDisks, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT, RTC_FORMAT_FLOAT4, disks.data(),
         sizeof(Disk), disks.size(), [&](RTCGeometry geometry) {
           rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3,
                                      disk_normals.data(), 0, sizeof(Vec3f), disk_normals.size());
         });
  attach(kTriangles, RTC_GEOMETRY_TYPE_TRIANGLE, RTC_FORMAT_FLOAT3, mesh_vertices.data(),
         sizeof(Vec3f), mesh_vertices.size(), [&](RTCGeometry geometry) {
           set_indices(geometry, RTC_FORMAT_UINT3, triangles.data(), sizeof(Triangle),
                       triangles.size());
         });
  rtcCommitScene(scene_);
  check_device();
}

SurfaceHit SceneGeometry::surface_hit(const RTCRayHit& hit) const {
  const unsigned kind = hit.hit.geomID;
  const unsigned index = hit.hit.primID;
  const Primitive& primitive = primitives[kind][index];

  // Points are recomputed from the primitive in double: o + t·d has the rounding error of t, which
  // far from the camera is larger than any offset could repair.
  Vec3f position, normal;
  float magnitude = 0;
  const double u = static_cast<double>(hit.hit.u), v = static_cast<double>(hit.hit.v);
  if (kind == kTriangles || kind == kRectangles) {
    const Vec3f* corner = rectangle_corners.data() + 4 * std::size_t{index};
    const bool is_triangle = kind == kTriangles;
    const Vec3f v0 = is_triangle ? mesh_vertices[triangles[index][0]] : corner[0];
    const Vec3f v1 = is_triangle ? mesh_vertices[triangles[index][1]] : corner[1];
    const Vec3f v2 = is_triangle ? mesh_vertices[triangles[index][2]] : corner[3];
    const Vec3d e1 = vec_cast<double>(v1) - vec_cast<double>(v0);
    const Vec3d e2 = vec_cast<double>(v2) - vec_cast<double>(v0);
    position = vec_cast<float>(vec_cast<double>(v0) + e1 * u + e2 * v);
    normal = vec_cast<float>(normalize(cross(e1, e2)));
    magnitude = plane_magnitude(position, v0, normal);
  } else {
    const auto& ray = hit.ray;
    const Vec3d raw =
        vec_cast<double>(Vec3f{ray.org_x, ray.org_y, ray.org_z}) +
        vec_cast<double>(Vec3f{ray.dir_x, ray.dir_y, ray.dir_z}) * static_cast<double>(ray.tfar);
    if (kind == kSpheres) {
      const Sphere& sphere = spheres[index];
      const Vec3d n = normalize(raw - vec_cast<double>(sphere.center));
      position =
          vec_cast<float>(vec_cast<double>(sphere.center) + n * static_cast<double>(sphere.radius));
      normal = vec_cast<float>(n);
      magnitude = std::max(max_norm(sphere.center), sphere.radius) + max_norm(position);
    } else {
      const Disk& disk = disks[index];
      normal = disk_normals[index];
      const Vec3d n = vec_cast<double>(normal);
      position = vec_cast<float>(raw - n * dot(n, raw - vec_cast<double>(disk.center)));
      magnitude = plane_magnitude(position, disk.center, normal);
    }
  }
  return {position, normal * primitive.facing, ray_offset(magnitude), primitive.bsdf,
          primitive.light};
}

std::optional<SurfaceHit> SceneGeometry::intersect(const Ray& ray) const {
  RTCRayHit ray_hit{};
  ray_hit.ray = embree_ray(ray);
  ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree::intersect(scene_, ray_hit);
  if (ray_hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return surface_hit(ray_hit);
}

bool SceneGeometry::occluded(const Ray& ray) const {
  RTCRay r = embree_ray(ray);
  embree::occluded(scene_, r);
  return r.tfar < 0;
}

}  // namespace plumbline::renderer
