#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <plumbline/renderer/math.h>
#include <plumbline/renderer/scene/embree.h>
#include <plumbline/renderer/scene/ray.h>
#include <plumbline/renderer/scene/scene.h>

namespace plumbline::renderer {

struct Sphere {
  Vec3f center;
  float radius;  // after the centre, as Embree's sphere buffer wants it
};

struct Disk {
  Vec3f center;
  float radius;
};

using Triangle = std::array<std::uint32_t, 3>;
using Rectangle = std::array<std::uint32_t, 4>;

/// What a primitive belongs to. `facing` is +1 where the front side is Embree's own, −1 where
/// flipped.
struct Primitive {
  std::uint32_t bsdf;
  std::uint32_t light, light_behind;  ///< what emits from the front side, and from the other
  float facing;
  Vec3f normal{};  ///< of what is flat: unit, of the front side

  /// What emits from the side that a ray with this direction hits.
  std::uint32_t light_towards(const Vec3f& front, const Vec3f& direction) const {
    return dot(front, direction) < 0 ? light : light_behind;
  }
};

/// Embree geometry ids, in the order of attachment.
enum GeometryId : unsigned { kSpheres, kRectangles, kDisks, kTriangles, kGeometryKinds };

/// Where Embree says that a ray meets a primitive.
struct PrimitiveHit {
  unsigned kind, index;
  float u, v, t;
};

/// Three corners of something flat: u runs from the first to the second, v from the first to the
/// third.
struct Corners {
  Vec3f v0, v1, v2;
};

/// Buffers that Embree reads in place, what belongs to each primitive, and the rays' way in.
class SceneGeometry {
 public:
  std::vector<Sphere> spheres;
  std::vector<Disk> disks;
  std::vector<Vec3f> disk_normals;
  std::vector<Vec3f> vertices;        ///< of rectangles and triangles
  std::vector<Rectangle> rectangles;  ///< indices of o, o + u, o + u + v, o + v
  std::vector<Triangle> triangles;
  std::array<std::vector<Primitive>, kGeometryKinds> primitives;

  SceneGeometry() = default;
  SceneGeometry(const SceneGeometry&) = delete;
  SceneGeometry& operator=(const SceneGeometry&) = delete;
  ~SceneGeometry();

  /// Hands the buffers to Embree; they may not change after.
  /// @throws InputError where Embree refuses them, std::bad_alloc
  void build();

  std::optional<SurfaceHit> intersect(const Ray& ray) const;
  bool occluded(const Ray& ray) const;
  void intersect(const RayLanes& rays, const IndexLanes& order, std::size_t count,
                 HitLanes& hits) const;
  void occluded(const RayLanes& rays, const Lanes<float>& t_max, const IndexLanes& order,
                std::size_t count, Lanes<std::uint8_t>& blocked) const;
  RTCScene embree_scene() const { return scene_; }

 private:
  void attach(GeometryId id, RTCGeometryType type, RTCFormat format, const void* items,
              std::size_t item_size, std::size_t item_count,
              const std::function<void(RTCGeometry)>& more);
  void check_device() const;
  void find_normals();
  Corners corners(unsigned kind, std::size_t index) const;
  SurfaceHit surface_hit(const Ray& ray, const PrimitiveHit& hit) const;
  void surface_hits(const RTCRayHit16& packet, const RayLanes& rays, const std::uint32_t* order,
                    std::size_t first, std::size_t count, HitLanes& hits) const;

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  embree::Coherence coherence_ = embree::Coherence::none;
};

}  // namespace plumbline::renderer
