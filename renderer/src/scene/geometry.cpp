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

/// Embree counts a hit at 0: a ray from a point that lies on its plane without rounding, as in the
/// middle of a scene, needs no offset and must not meet that plane.
constexpr float kNearest = std::numeric_limits<float>::min();

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

using embree::kPacket;

/// Up to here rays of one octant share most of what they visit, so that walking the tree together
/// pays: measured 1.3 times as fast in the Cornell box, alike at 3,000 triangles, half as fast at a
/// million.
constexpr std::size_t kFewPrimitives = 4096;

/// Rays of a packet that have values of their own.
struct ValidLanes {
  alignas(64) int lanes[kPacket];

  explicit ValidLanes(std::size_t count) {
    for (std::size_t k = 0; k < kPacket; ++k) lanes[k] = k < count ? -1 : 0;
  }
};

void prepare(RTCRay16& packet) {
  packet = {};
  for (std::size_t k = 0; k < kPacket; ++k) {
    packet.tnear[k] = kNearest;
    packet.mask[k] = ~0u;
  }
}

void load(RTCRay16& packet, const RayLanes& rays, std::size_t first) {
  for (std::size_t k = 0; k < kPacket; ++k) {
    packet.org_x[k] = rays.origin.x[first + k];
    packet.org_y[k] = rays.origin.y[first + k];
    packet.org_z[k] = rays.origin.z[first + k];
    packet.dir_x[k] = rays.direction.x[first + k];
    packet.dir_y[k] = rays.direction.y[first + k];
    packet.dir_z[k] = rays.direction.z[first + k];
    packet.tfar[k] = rays.t_max[first + k];
  }
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
  find_normals();
  std::size_t count = 0;
  for (const auto& of_kind : primitives) count += of_kind.size();
  if (count <= kFewPrimitives) coherence_ = embree::Coherence::coherent;
}

std::array<Vec3f, 3> SceneGeometry::corners(unsigned kind, std::size_t index) const {
  if (kind == kTriangles) {
    const Triangle& t = triangles[index];
    return {mesh_vertices[t[0]], mesh_vertices[t[1]], mesh_vertices[t[2]]};
  }
  const Vec3f* corner = rectangle_corners.data() + 4 * index;
  return {corner[0], corner[1], corner[3]};
}

void SceneGeometry::find_normals() {
  for (const unsigned kind : {kTriangles, kRectangles}) {
    for (std::size_t i = 0; i < primitives[kind].size(); ++i) {
      const auto [v0, v1, v2] = corners(kind, i);
      const Vec3d e1 = vec_cast<double>(v1) - vec_cast<double>(v0);
      const Vec3d e2 = vec_cast<double>(v2) - vec_cast<double>(v0);
      Primitive& primitive = primitives[kind][i];
      primitive.normal = vec_cast<float>(normalize(cross(e1, e2))) * primitive.facing;
    }
  }
  for (std::size_t i = 0; i < disks.size(); ++i) primitives[kDisks][i].normal = disk_normals[i];
}

SurfaceHit SceneGeometry::surface_hit(const Ray& ray, const PrimitiveHit& hit) const {
  const Primitive& primitive = primitives[hit.kind][hit.index];
  // Points are recomputed from the primitive in double: o + t·d has the rounding error of t, which
  // far from the camera is larger than any offset could repair.
  Vec3f position, normal = primitive.normal;
  float magnitude = 0;
  if (hit.kind == kTriangles || hit.kind == kRectangles) {
    const auto [v0, v1, v2] = corners(hit.kind, hit.index);
    const Vec3d e1 = vec_cast<double>(v1) - vec_cast<double>(v0);
    const Vec3d e2 = vec_cast<double>(v2) - vec_cast<double>(v0);
    position = vec_cast<float>(vec_cast<double>(v0) + e1 * static_cast<double>(hit.u) +
                               e2 * static_cast<double>(hit.v));
    magnitude = plane_magnitude(position, v0, normal);
  } else {
    const Vec3d raw =
        vec_cast<double>(ray.origin) + vec_cast<double>(ray.direction) * static_cast<double>(hit.t);
    if (hit.kind == kSpheres) {
      const Sphere& sphere = spheres[hit.index];
      const Vec3d n = normalize(raw - vec_cast<double>(sphere.center));
      position =
          vec_cast<float>(vec_cast<double>(sphere.center) + n * static_cast<double>(sphere.radius));
      normal = vec_cast<float>(n) * primitive.facing;
      magnitude = std::max(max_norm(sphere.center), sphere.radius) + max_norm(position);
    } else {
      const Disk& disk = disks[hit.index];
      const Vec3d n = vec_cast<double>(normal);
      position = vec_cast<float>(raw - n * dot(n, raw - vec_cast<double>(disk.center)));
      magnitude = plane_magnitude(position, disk.center, normal);
    }
  }
  const bool front = dot(normal, ray.direction) < 0;
  return {position, normal, ray_offset(magnitude), primitive.bsdf,
          front ? primitive.light : primitive.light_behind};
}

std::optional<SurfaceHit> SceneGeometry::intersect(const Ray& ray) const {
  RTCRayHit ray_hit;
  ray_hit.ray = embree_ray(ray);
  ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree::intersect(scene_, ray_hit);
  const RTCHit& hit = ray_hit.hit;
  if (hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return surface_hit(ray, {hit.geomID, hit.primID, hit.u, hit.v, ray_hit.ray.tfar});
}

bool SceneGeometry::occluded(const Ray& ray) const {
  RTCRay r = embree_ray(ray);
  embree::occluded(scene_, r);
  return r.tfar < 0;
}

void SceneGeometry::intersect(const RayLanes& rays, std::size_t count, HitLanes& hits) const {
  alignas(64) RTCRayHit16 packet;
  prepare(packet.ray);
  for (std::size_t first = 0; first < count; first += kPacket) {
    const std::size_t size = std::min(kPacket, count - first);
    load(packet.ray, rays, first);
    for (unsigned& id : packet.hit.geomID) id = RTC_INVALID_GEOMETRY_ID;
    embree::intersect(scene_, ValidLanes(size).lanes, packet, coherence_);
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t i = first + k;
      hits.bsdf[i] = kNoHit;
      if (packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
      const SurfaceHit hit = surface_hit({rays.origin[i], rays.direction[i]},
                                         {packet.hit.geomID[k], packet.hit.primID[k],
                                          packet.hit.u[k], packet.hit.v[k], packet.ray.tfar[k]});
      hits.position.set(i, hit.position);
      hits.normal.set(i, hit.normal);
      hits.offset[i] = hit.offset;
      hits.bsdf[i] = hit.bsdf;
      hits.light[i] = hit.light;
    }
  }
}

void SceneGeometry::occluded(const RayLanes& rays, std::size_t count,
                             Lanes<std::uint8_t>& blocked) const {
  alignas(64) RTCRay16 packet;
  prepare(packet);
  for (std::size_t first = 0; first < count; first += kPacket) {
    const std::size_t size = std::min(kPacket, count - first);
    load(packet, rays, first);
    embree::occluded(scene_, ValidLanes(size).lanes, packet, embree::Coherence::none);
    for (std::size_t k = 0; k < size; ++k) blocked[first + k] = packet.tfar[k] < 0 ? 1 : 0;
  }
}

}  // namespace plumbline::renderer
