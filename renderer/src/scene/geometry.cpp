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

/// A point recomputed in double from its primitive: o + t·d has the rounding error of t, which far
/// from the camera is larger than any offset could repair.
struct SurfacePoint {
  Vec3f position, normal;
  float magnitude;  // what ray_offset asks for
};

bool is_flat(unsigned kind) { return kind == kTriangles || kind == kRectangles; }

Vec3f position_on_plane(const Corners& corners, float u, float v) {
  const Vec3d v0 = vec_cast<double>(corners.v0);
  const Vec3d e1 = vec_cast<double>(corners.v1) - v0, e2 = vec_cast<double>(corners.v2) - v0;
  return vec_cast<float>(v0 + e1 * static_cast<double>(u) + e2 * static_cast<double>(v));
}

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

void load(RTCRay16& packet, const RayLanes& rays, const std::uint32_t* order) {
  for (std::size_t k = 0; k < kPacket; ++k) {
    const std::uint32_t i = order[k];
    packet.org_x[k] = rays.origin.x[i];
    packet.org_y[k] = rays.origin.y[i];
    packet.org_z[k] = rays.origin.z[i];
    packet.dir_x[k] = rays.direction.x[i];
    packet.dir_y[k] = rays.direction.y[i];
    packet.dir_z[k] = rays.direction.z[i];
  }
}

void store(HitLanes& hits, std::size_t i, const SurfaceHit& hit) {
  hits.position.set(i, hit.position);
  hits.normal.set(i, hit.normal);
  hits.offset[i] = hit.offset;
  hits.bsdf[i] = hit.bsdf;
  hits.light[i] = hit.light;
}

/// Corners of the flat surfaces that a packet hits, side by side.
struct CornerLanes {
  Vec3LanesOf<kPacket> v0{}, v1{}, v2{};

  void set(std::size_t k, const Corners& corners) {
    v0.set(k, corners.v0);
    v1.set(k, corners.v1);
    v2.set(k, corners.v2);
  }
};

/// Positions and offsets of hits from `first` on; what is not flat gets numbers without a meaning.
[[gnu::flatten]] void find_flat_points(const CornerLanes& corners, const RTCRayHit16& packet,
                                       std::size_t first, HitLanes& hits) {
  for (std::size_t k = 0; k < kPacket; ++k) {
    const Vec3f v0 = corners.v0[k];
    const Vec3f position =
        position_on_plane({v0, corners.v1[k], corners.v2[k]}, packet.hit.u[k], packet.hit.v[k]);
    hits.position.set(first + k, position);
    hits.offset[first + k] = ray_offset(plane_magnitude(position, v0, hits.normal[first + k]));
  }
}

}  // namespace

inline Corners SceneGeometry::corners(unsigned kind, std::size_t index) const {
  const bool triangle = kind == kTriangles;
  const std::uint32_t* i = triangle ? triangles[index].data() : rectangles[index].data();
  return {vertices[i[0]], vertices[i[1]], vertices[i[triangle ? 2 : 3]]};
}

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
  rtcCommitScene(scene_);
  check_device();
  find_normals();
  std::size_t count = 0;
  for (const auto& of_kind : primitives) count += of_kind.size();
  if (count <= kFewPrimitives) coherence_ = embree::Coherence::coherent;
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
  const Vec3d raw =
      vec_cast<double>(ray.origin) + vec_cast<double>(ray.direction) * static_cast<double>(hit.t);
  SurfacePoint point;
  if (is_flat(hit.kind)) {
    point = point_of_plane(corners(hit.kind, hit.index), hit.u, hit.v, primitive.normal);
  } else if (hit.kind == kSpheres) {
    point = point_of_sphere(spheres[hit.index], raw, primitive.facing);
  } else {
    point = point_of_disk(disks[hit.index], raw, primitive.normal);
  }
  return {point.position, point.normal, ray_offset(point.magnitude), primitive.bsdf,
          primitive.light_towards(point.normal, ray.direction)};
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

void SceneGeometry::surface_hits(const RTCRayHit16& packet, const RayLanes& rays,
                                 const std::uint32_t* order, std::size_t first, std::size_t count,
                                 HitLanes& hits) const {
  CornerLanes flat;
  for (std::size_t k = 0; k < count; ++k) {
    const unsigned kind = packet.hit.geomID[k], index = packet.hit.primID[k];
    hits.bsdf[first + k] = kNoHit;
    if (!is_flat(kind)) continue;
    const Primitive& primitive = primitives[kind][index];
    flat.set(k, corners(kind, index));
    hits.normal.set(first + k, primitive.normal);
    hits.bsdf[first + k] = primitive.bsdf;
    hits.light[first + k] = primitive.light_towards(primitive.normal, rays.direction[order[k]]);
  }
  find_flat_points(flat, packet, first, hits);
  for (std::size_t k = 0; k < count; ++k) {
    const unsigned kind = packet.hit.geomID[k];
    if (kind == RTC_INVALID_GEOMETRY_ID || is_flat(kind)) continue;
    const Ray ray{rays.origin[order[k]], rays.direction[order[k]]};
    store(hits, first + k,
          surface_hit(ray, {kind, packet.hit.primID[k], packet.hit.u[k], packet.hit.v[k],
                            packet.ray.tfar[k]}));
  }
}

void SceneGeometry::intersect(const RayLanes& rays, const IndexLanes& order, std::size_t count,
                              HitLanes& hits) const {
  alignas(64) RTCRayHit16 packet;
  prepare(packet.ray);
  for (std::size_t first = 0; first < count; first += kPacket) {
    const std::size_t size = std::min(kPacket, count - first);
    load(packet.ray, rays, &order[first]);
    for (float& t_max : packet.ray.tfar) t_max = std::numeric_limits<float>::infinity();
    for (unsigned& id : packet.hit.geomID) id = RTC_INVALID_GEOMETRY_ID;
    embree::intersect(scene_, ValidLanes(size).lanes, packet, coherence_);
    surface_hits(packet, rays, &order[first], first, size, hits);
  }
}

void SceneGeometry::occluded(const RayLanes& rays, const Lanes<float>& t_max,
                             const IndexLanes& order, std::size_t count,
                             Lanes<std::uint8_t>& blocked) const {
  alignas(64) RTCRay16 packet;
  prepare(packet);
  for (std::size_t first = 0; first < count; first += kPacket) {
    const std::size_t size = std::min(kPacket, count - first);
    load(packet, rays, &order[first]);
    for (std::size_t k = 0; k < kPacket; ++k) packet.tfar[k] = t_max[order[first + k]];
    embree::occluded(scene_, ValidLanes(size).lanes, packet, embree::Coherence::none);
    for (std::size_t k = 0; k < kPacket; ++k) blocked[first + k] = packet.tfar[k] < 0 ? 1 : 0;
  }
}

}  // namespace plumbline::renderer
