#include <plumbline/renderer/assembly/description.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <plumbline/renderer/brute_force/brute_force.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/core/scene/geometry.h>
#include <plumbline/renderer/placement/placement.h>

namespace plumbline::renderer {
namespace {

/// Axis-aligned bounds in double, grown point by point.
struct Bounds {
  Vec3d low{kInfinity, kInfinity, kInfinity};
  Vec3d high{-kInfinity, -kInfinity, -kInfinity};

  void add(const Vec3d& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }

  void add(const Vec3d& center, double radius) {
    add(center - Vec3d{radius, radius, radius});
    add(center + Vec3d{radius, radius, radius});
  }

  bool empty() const { return !(low.x <= high.x); }
  Vec3d center() const { return empty() ? Vec3d{} : (low + high) * 0.5; }
  double radius() const { return empty() ? 0.0 : length(high - low) / 2; }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
};

Bounds bounds_of(const std::vector<ShapeDescription>& shapes) {
  struct Grow {
    Bounds bounds;
    void operator()(const SphereShape& s) { bounds.add(s.center, s.radius); }
    void operator()(const DiskShape& s) { bounds.add(s.center, s.radius); }
    void operator()(const RectangleShape& s) {
      bounds.add(s.origin);
      bounds.add(s.origin + s.edge_u);
      bounds.add(s.origin + s.edge_v);
      bounds.add(s.origin + s.edge_u + s.edge_v);
    }
    void operator()(const MeshShape& s) {
      for (const Vec3d& v : s.vertices) bounds.add(v);
    }
  } grow;
  for (const ShapeDescription& shape : shapes) std::visit(grow, shape.geometry);
  return grow.bounds;
}

/// Turns a description into the buffers, moving and scaling everything on the way.
class SceneBuilder {
 public:
  SceneBuilder(SceneGeometry& geometry, const Placement& placement)
      : geometry_(geometry), placement_(placement) {}

  void add(const ShapeDescription& shape) {
    shape_ = &shape;
    std::visit(*this, shape.geometry);
    ++group_;
  }

  void add(const PointDescription& point) {
    add_light(PointLight{local(point.position),
                         rgb_cast<float>(point.intensity * sqr(placement_.scale))});
    ++group_;
  }

  /// @return index of the environment's light, or kNoLight
  std::uint32_t add_environment(const SceneDescription& scene) {
    const Rgbf sky = rgb_cast<float>(scene.environment.value_or(Rgbd{}));
    if (scene.environment_map) return add_light(*scene.environment_map);
    if (scene.sun) {
      return add_light(SunAndSky::make(vec_cast<float>(scene.sun->direction), scene.sun->half_angle,
                                       rgb_cast<float>(scene.sun->radiance), sky));
    }
    return scene.environment ? add_light(ConstantEnvironment{sky}) : kNoLight;
  }

  LightSet take_lights(LightSelection selection, double scene_radius) {
    return {std::move(lights_), groups_, selection, scene_radius};
  }

  void operator()(const SphereShape& s) {
    const Sphere sphere{local(s.center), static_cast<float>(s.radius * placement_.scale)};
    const bool exact = add_exact([&] { return surface_of(s); });
    if (!exact) geometry_.spheres.push_back(sphere);
    add_primitive(exact ? kExact : kSpheres, s.flip_normals, [&](const Rgbf& radiance) {
      return SphereLight{sphere.center, sphere.radius, s.flip_normals, radiance};
    });
  }

  void operator()(const RectangleShape& s) {
    if (add_exact([&] { return surface_of(s); })) {
      const Vec3f o = local(s.origin), u = scaled(s.edge_u), v = scaled(s.edge_v);
      return add_primitive(kExact, s.flip_normals, [&](const Rgbf& radiance) {
        return rectangle_light(o, u, v, s.flip_normals, radiance);
      });
    }
    const auto first = static_cast<std::uint32_t>(geometry_.vertices.size());
    for (const Vec3d& corner :
         {s.origin, s.origin + s.edge_u, s.origin + s.edge_u + s.edge_v, s.origin + s.edge_v}) {
      geometry_.vertices.push_back(local(corner));
    }
    geometry_.rectangles.push_back({first, first + 1, first + 2, first + 3});
    add_primitive(kRectangles, s.flip_normals, [&](const Rgbf& radiance) {
      // From the rounded corners: the light must be the surface that rays hit.
      const Vec3f o = geometry_.vertices[first];
      const Vec3f u = geometry_.vertices[first + 1] - o;
      const Vec3f v = geometry_.vertices[first + 3] - o;
      return rectangle_light(o, u, v, s.flip_normals, radiance);
    });
  }

  void operator()(const DiskShape& s) {
    const Disk disk{local(s.center), static_cast<float>(s.radius * placement_.scale)};
    const Vec3f normal = vec_cast<float>(s.normal);
    const bool exact = add_exact([&] { return surface_of(s); });
    if (!exact) {
      geometry_.disks.push_back(disk);
      geometry_.disk_normals.push_back(normal);
    }
    add_primitive(exact ? kExact : kDisks, false, [&](const Rgbf& radiance) {
      return DiskLight{disk.center, normal, disk.radius, radiance};
    });
  }

  void operator()(const MeshShape& s) {
    const auto first = static_cast<std::uint32_t>(geometry_.vertices.size());
    for (const Vec3d& v : s.vertices) geometry_.vertices.push_back(local(v));
    for (const Triangle& t : s.triangles) {
      if (add_exact([&] { return surface_of(s, t); })) {
        add_primitive(kExact, s.flip_normals, [&](const Rgbf& radiance) {
          const Vec3d &a = s.vertices[t[0]], ab = s.vertices[t[1]] - a, ac = s.vertices[t[2]] - a;
          return triangle_light(local(a), scaled(ab), scaled(ac), s.flip_normals, radiance);
        });
        continue;
      }
      const Triangle moved{t[0] + first, t[1] + first, t[2] + first};
      geometry_.triangles.push_back(moved);
      add_primitive(kTriangles, s.flip_normals, [&](const Rgbf& radiance) {
        const Vec3f v0 = geometry_.vertices[moved[0]];
        const Vec3f e1 = geometry_.vertices[moved[1]] - v0;
        const Vec3f e2 = geometry_.vertices[moved[2]] - v0;
        return triangle_light(v0, e1, e2, s.flip_normals, radiance);
      });
    }
  }

 private:
  static float facing(bool flip_normals) { return flip_normals ? -1.0f : 1.0f; }

  Vec3f local(const Vec3d& p) const {
    return vec_cast<float>((p - placement_.center) * placement_.scale);
  }
  Vec3f scaled(const Vec3d& v) const { return vec_cast<float>(v * placement_.scale); }

  RectangleLight rectangle_light(const Vec3f& o, const Vec3f& u, const Vec3f& v, bool flip,
                                 const Rgbf& radiance) const {
    const Vec3f normal = facing(flip) * normalize(cross(u, v));
    return {o, u, v, normal, radiance, shape_->light_by_solid_angle, shape_->light_two_sided};
  }

  TriangleLight triangle_light(const Vec3f& v0, const Vec3f& e1, const Vec3f& e2, bool flip,
                               const Rgbf& radiance) const {
    const Vec3f normal = facing(flip) * normalize(cross(e1, e2));
    return {v0, e1, e2, normal, radiance, shape_->light_by_solid_angle};
  }

  /// Counts a surface, and adds it if it is one of those that have to be exact.
  template <class Surface>
  bool add_exact(const Surface& surface) {
    const auto found = placement_.exact.find(surface_++);
    if (found == placement_.exact.end()) return false;
    const auto& [number, first] = *found;
    exact_indices_.emplace(number, geometry_.exact.size());
    geometry_.exact.push_back(surface().moved(placement_.center, placement_.scale));
    if (first != number) geometry_.exact.back().lay_onto(geometry_.exact[exact_indices_.at(first)]);
    return true;
  }

  template <class MakeLight>
  void add_primitive(GeometryId id, bool flip_normals, const MakeLight& make_light) {
    std::uint32_t light = kNoLight;
    if (shape_->radiance && !is_black(*shape_->radiance)) {
      light = add_light(make_light(rgb_cast<float>(*shape_->radiance)));
    }
    const std::uint32_t behind = shape_->light_two_sided ? light : kNoLight;
    geometry_.primitives[id].push_back({shape_->bsdf, light, behind, facing(flip_normals)});
  }

  std::uint32_t add_light(const Light& light) {
    lights_.push_back(light);
    groups_.push_back(group_);
    return static_cast<std::uint32_t>(lights_.size()) - 1;
  }

  SceneGeometry& geometry_;
  const Placement& placement_;
  std::size_t surface_ = 0;                           // number of the next one
  std::map<std::size_t, std::size_t> exact_indices_;  // in the geometry, by number
  const ShapeDescription* shape_ = nullptr;
  std::vector<Light> lights_;
  std::vector<std::uint32_t> groups_;  // number of the shape that each light belongs to
  std::uint32_t group_ = 0;
};

/// By the number of primitives alone, never by a clock: a scene has the same bits every time.
bool wants_brute_force(Accelerator accelerator, const SceneGeometry& geometry) {
  const bool can = brute_force_can_trace(geometry);
  if (accelerator == Accelerator::brute_force && !can) {
    throw InputError(
        "--accelerator brute_force: the scene has surfaces that single precision cannot hold, "
        "which are traced in double by embree");
  }
  return accelerator == Accelerator::automatic
             ? can && geometry.primitive_count() <= kMostForBruteForce
             : accelerator == Accelerator::brute_force;
}

}  // namespace

Scene make_scene(const SceneDescription& description) {
  if (!description.bsdfs) throw std::invalid_argument("a scene needs a table of BSDFs");
  const Bounds bounds = bounds_of(description.shapes);
  const Placement placement =
      place({description.shapes, description.points, description.camera, description.file},
            bounds.center());
  SceneParts parts;
  parts.geometry = std::make_unique<SceneGeometry>();
  SceneBuilder builder(*parts.geometry, placement);
  for (const ShapeDescription& shape : description.shapes) builder.add(shape);
  for (const PointDescription& point : description.points) builder.add(point);
  parts.geometry->build();
  if (wants_brute_force(description.accelerator, *parts.geometry)) {
    parts.geometry->use(make_brute_force(*parts.geometry));
  }
  parts.environment = builder.add_environment(description);
  parts.lights =
      builder.take_lights(description.light_selection, bounds.radius() * placement.scale);
  parts.bsdfs = description.bsdfs;
  parts.camera = Camera(description.camera, placement.center, placement.scale);
  parts.shape_count = description.shapes.size();
  return Scene(std::move(parts));
}

Accelerator accelerator_of(const Scene& scene) {
  return scene.geometry().uses_embree() ? Accelerator::embree : Accelerator::brute_force;
}

}  // namespace plumbline::renderer
