#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/scene/embree.h>
#include <plumbline/renderer/core/scene/exact_shape.h>
#include <plumbline/renderer/core/scene/ray_engine.h>
#include <plumbline/renderer/core/scene/surface_hit.h>

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

/// Three corners of something flat: u runs from the first to the second, v from the first to the
/// third.
struct Corners {
  Vec3f v0, v1, v2;
};

/// What a primitive belongs to, and all that is asked of a flat one where a ray meets it, in one
/// line of the cache. `facing` is +1 where the front side is Embree's own, −1 where flipped.
struct alignas(64) Primitive {
  std::uint32_t bsdf;
  std::uint32_t light, light_behind;  ///< what emits from the front side, and from the other
  float facing;
  Vec3f normal{};     ///< of what is flat: unit, of the front side
  Corners corners{};  ///< of a triangle or rectangle

  /// What emits from the side that a ray with this direction hits.
  std::uint32_t light_towards(const Vec3f& front, const Vec3f& direction) const {
    return dot(front, direction) < 0 ? light : light_behind;
  }
};

/// Embree geometry ids, in the order of attachment.
enum GeometryId : unsigned { kSpheres, kRectangles, kDisks, kTriangles, kExact, kGeometryKinds };

inline bool is_flat(unsigned kind) { return kind == kTriangles || kind == kRectangles; }

/// Embree counts a hit at 0: a ray from a point that lies on its plane without rounding, as in the
/// middle of a scene, needs no offset and must not meet that plane.
inline constexpr float kNearest = std::numeric_limits<float>::min();

/// Recomputed in double from the primitive: o + t·d has the rounding error of t, which far from the
/// camera is larger than any offset could repair.
inline Vec3f position_on_plane(const Corners& corners, float u, float v) {
  const Vec3d v0 = vec_cast<double>(corners.v0);
  const Vec3d e1 = vec_cast<double>(corners.v1) - v0, e2 = vec_cast<double>(corners.v2) - v0;
  return vec_cast<float>(v0 + e1 * static_cast<double>(u) + e2 * static_cast<double>(v));
}

/// Error of a plane's position near p as Embree sees it: it subtracts the ray origin from a corner,
/// so the rounding error along the normal is that of the corner's coordinates weighted by the
/// normal. A wall aligned with an axis has none, however large it is.
inline float plane_magnitude(const Vec3f& p, const Vec3f& corner, const Vec3f& normal) {
  const Vec3f d = corner - p;
  return max_norm(p) + std::abs(normal.x * d.x) + std::abs(normal.y * d.y) +
         std::abs(normal.z * d.z);
}

/// Buffers that Embree reads in place, what belongs to each primitive, and the rays' way in.
class SceneGeometry {
 public:
  std::vector<Sphere> spheres;
  std::vector<Disk> disks;
  std::vector<Vec3f> disk_normals;
  std::vector<Vec3f> vertices;        ///< of rectangles and triangles
  std::vector<Rectangle> rectangles;  ///< indices of o, o + u, o + u + v, o + v
  std::vector<Triangle> triangles;
  std::vector<ExactShape> exact;  ///< in the order in which the scene names them
  std::array<std::vector<Primitive>, kGeometryKinds> primitives;

  SceneGeometry() = default;
  SceneGeometry(const SceneGeometry&) = delete;
  SceneGeometry& operator=(const SceneGeometry&) = delete;
  ~SceneGeometry();

  /// Hands the buffers to Embree; they may not change after.
  /// @throws InputError where Embree refuses them, std::bad_alloc
  void build();

  /// From now on all rays are answered by this, and none by Embree. After `build`.
  void use(std::unique_ptr<RayEngine> engine) { engine_ = std::move(engine); }
  bool uses_embree() const { return engine_ == nullptr; }

  std::optional<SurfaceHit> intersect(const Ray& ray) const;
  bool occluded(const Ray& ray) const;

  /// Sixteen rays at once, as Embree's functions of that name take them.
  /// @param valid  −1 for each ray that takes part; 0 for others, whose `tfar` is negative
  void intersect(const int (&valid)[embree::kPacket], RTCRayHit16& rays,
                 embree::Coherence coherence) const;
  void occluded(const int (&valid)[embree::kPacket], RTCRay16& rays) const;

  /// How many surfaces rays are traced against.
  std::size_t primitive_count() const;

  /// The point of a primitive that a ray meets.
  SurfaceHit surface_hit(const Ray& ray, const PrimitiveHit& hit) const;

  RTCScene embree_scene() const { return scene_; }

 private:
  void attach(GeometryId id, RTCGeometry geometry);
  void attach(GeometryId id, RTCGeometryType type, RTCFormat format, const void* items,
              std::size_t item_size, std::size_t item_count,
              const std::function<void(RTCGeometry)>& more);
  void check_device() const;
  void find_planes();

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::unique_ptr<RayEngine> engine_;
};

}  // namespace plumbline::renderer
