#include "surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <plumbline/renderer/core/errors.h>

namespace plumbline::renderer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Distance over size of a surface, up to which single precision holds it as if it were exact: ray
/// offsets (ray_offset: 2⁻²⁰ of the distance) are 1/500 of its size. The same of the size of a
/// surface over that of details beside it.
constexpr double kPrecise = 0x1p11;

/// Up to here it keeps its shape: ray offsets are a thirtieth of its size.
constexpr double kRecognizable = 0x1p15;

/// Lengths in the renderer's space, the longest over the shortest: products of three and quotients
/// of four of them are normal numbers in single precision.
constexpr double kLongest = 0x1p40;

/// Shortest lengths that need no scale: those of scenes in metres.
constexpr double kUsual = 0x1p20;

double farthest_coordinate(const Vec3d& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// A shape as seen from afar.
struct Extent {
  Vec3d center;
  double reach = 0;  ///< half its longest side [m]
  double size = 0;   ///< half its shortest side [m]; of a mesh the same as its reach
  std::size_t first_surface = 0;

  double at_least_from(const Vec3d& p) const { return std::max(length(p - center) - reach, 0.0); }
};

class Placer {
 public:
  Placer(const PlacedParts& scene, const Vec3d& middle) : scene_(scene), middle_(middle) {
    for (const ShapeDescription& shape : scene.shapes) measure(shape);
  }

  Placement place() {
    Placement p;
    if (scene_.shapes.empty()) return p;
    p.center = choose_center();
    p.scale = choose_scale(p.center);
    for (const PointDescription& point : scene_.points) check_intensity(point, p.scale);
    mark_exact(p);
    return p;
  }

 private:
  void measure(const ShapeDescription& shape) {
    Vec3d low{kInfinity, kInfinity, kInfinity}, high = -low;
    Extent extent;
    extent.first_surface = surfaces_;
    for_each_surface(shape, [&](const ExactShape& surface) {
      ++surfaces_;
      const auto box = surface.box();
      grow(low, high, box);
      extent.size = size_of(surface);
      const double d = renderer::at_least_from(surface, scene_.camera.origin);
      if (d > 0) camera_clearance_ = std::min(camera_clearance_, d);
    });
    extent.center = (low + high) * 0.5;
    extent.reach = length(high - low) / 2;
    if (std::holds_alternative<MeshShape>(shape.geometry)) extent.size = extent.reach;
    if (std::holds_alternative<SphereShape>(shape.geometry)) extent.reach = extent.size;
    extents_.push_back(extent);
  }

  static void grow(Vec3d& low, Vec3d& high, const ExactShape::Box& box) {
    low = {std::min(low.x, box.low.x), std::min(low.y, box.low.y), std::min(low.z, box.low.z)};
    high = {std::max(high.x, box.high.x), std::max(high.y, box.high.y),
            std::max(high.z, box.high.z)};
  }

  /// Two that one picture cannot hold: a shape, and what it is too far from or too large beside.
  struct Conflict {
    std::size_t shape;
    std::string other;
    std::string why;
  };

  [[noreturn]] void refuse(const Conflict& c) const {
    throw InputError(fmt::format("{} {} {}", place_in_file(scene_, c.shape), c.why, c.other));
  }

  /// The middle of the scene if the picture is right with it, else the camera, whose view is then,
  /// else a shape's, for what is seen from very far.
  Vec3d choose_center() const {
    for (const double limit : {kPrecise, kRecognizable}) {
      for (const Vec3d& center : {middle_, scene_.camera.origin}) {
        if (!conflict(center, limit)) return center;
      }
    }
    constexpr std::size_t kMostTried = 256;
    for (std::size_t i = 0; i < std::min(extents_.size(), kMostTried); ++i) {
      if (!conflict(extents_[i].center, kRecognizable)) return extents_[i].center;
    }
    refuse(*conflict(scene_.camera.origin, kRecognizable));
  }

  static bool is_within(double limit, const Extent& e, const Vec3d& center) {
    return farthest_coordinate(e.center - center) <= limit * e.size;
  }

  /// What of the picture would be wrong with that centre.
  std::optional<Conflict> conflict(const Vec3d& center, double limit) const {
    const Vec3d& camera = scene_.camera.origin;
    if (farthest_coordinate(camera - center) > limit * camera_clearance_) {
      return Conflict{0, "the camera", "is too far from"};
    }
    const double pixel = 2 * scene_.camera.tan_half_fov_x / scene_.camera.width;
    double unresolved = 0;  // solid angle from the camera, over π
    for (std::size_t i = 0; i < extents_.size(); ++i) {
      const Extent& e = extents_[i];
      if (is_within(limit, e, center)) continue;
      unresolved += sqr(e.reach / std::max(length(e.center - camera) - e.reach, e.reach));
      if (unresolved > sqr(pixel / 4)) {
        return Conflict{i, renderer::name_of(scene_, other_than(i, center)), kTooFar};
      }
      if (!scene_.shapes[i].radiance) continue;
      const double offset = 0x1p-20 * farthest_coordinate(e.center - center);
      for (std::size_t j = 0; j < extents_.size(); ++j) {
        if (j == i || extents_[j].at_least_from(e.center) > 64 * offset) continue;
        return Conflict{i, renderer::name_of(scene_, j),
                        "emits so far from the rest that single precision does not tell it from"};
      }
    }
    return std::nullopt;
  }

  static constexpr const char* kTooFar =
      "is too small and too far for a picture in single precision that also holds";

  /// The shape nearest to a place, but for one.
  std::size_t other_than(std::size_t shape, const Vec3d& place) const {
    std::size_t nearest = shape;
    double least = kInfinity;
    for (std::size_t i = 0; i < extents_.size(); ++i) {
      const double d = extents_[i].at_least_from(place);
      if (i == shape || !(d < least)) continue;
      least = d;
      nearest = i;
    }
    return nearest;
  }

  static std::string name_of(const PointDescription& point) {
    return point.line == 0 ? "a point light"
                           : fmt::format("<emitter type=\"point\"> on line {}", point.line) +
                                 of_file(point.file);
  }

  /// Of intensities in the renderer's space, which have to be normal numbers.
  void check_intensity(const PointDescription& point, double scale) const {
    for (const double channel : {point.intensity.r, point.intensity.g, point.intensity.b}) {
      const double local = channel * sqr(scale);
      if (local == 0 || (local >= 1e-30 && local <= 1e30)) continue;
      throw InputError(fmt::format("{}: {} is too {} for single precision in a scene of its size",
                                   scene_.file.string(), name_of(point),
                                   local < 1 ? "dark" : "bright"));
    }
  }

  double choose_scale(const Vec3d& center) const {
    std::size_t smallest = 0, farthest = 0;
    double shortest = kInfinity, longest = 0;
    for (std::size_t i = 0; i < extents_.size(); ++i) {
      const Extent& e = extents_[i];
      const double to_end = farthest_coordinate(e.center - center) + e.reach;
      if (to_end > longest) longest = to_end, farthest = i;
      if (is_within(kRecognizable, e, center) && e.size < shortest) shortest = e.size, smallest = i;
    }
    std::string far_name = renderer::name_of(scene_, farthest);
    const auto reach_to = [&](const Vec3d& p, const std::string& what) {
      if (farthest_coordinate(p - center) <= longest) return;
      longest = farthest_coordinate(p - center);
      far_name = what;
    };
    reach_to(scene_.camera.origin, "the camera");
    for (const PointDescription& point : scene_.points) reach_to(point.position, name_of(point));
    if (longest > kLongest * shortest) {
      refuse({smallest, far_name,
              fmt::format("is {:.2g} times smaller than single precision can hold beside",
                          longest / shortest)});
    }
    const bool usual = shortest >= 1 / kUsual && shortest <= kUsual && longest <= kLongest;
    return usual ? 1 : std::exp2(-std::round(std::log2(shortest)));
  }

  /// Small and far, or so large that its points are coarser than the details beside it.
  void mark_exact(Placement& p) const {
    double smallest = kInfinity;
    for (const Extent& e : extents_) smallest = std::min(smallest, e.size);
    for (std::size_t i = 0; i < extents_.size(); ++i) {
      std::size_t surface = extents_[i].first_surface;
      for_each_surface(scene_.shapes[i], [&](const ExactShape& s) {
        const double out = farthest_coordinate(s.origin() - p.center);
        const bool far = !is_within(kPrecise, extents_[i], p.center);
        if (far || is_large(i, s, out, smallest, p.center)) p.exact.emplace(surface, surface);
        ++surface;
      });
    }
  }

  bool is_large(std::size_t shape, const ExactShape& s, double out, double smallest,
                const Vec3d& center) const {
    const double reach = reach_of(s);
    // Of what is small against the distance from the centre, that distance is what counts.
    if (reach < out / 64) return false;
    double detail = kInfinity;
    std::string beside;
    const auto look = [&](double length, const auto& name) {
      if (!(length > 0 && length < detail)) return;
      detail = length;
      if (reach > kPrecise * detail) beside = name();
    };
    look(renderer::at_least_from(s, scene_.camera.origin),
         [] { return std::string("the camera"); });
    for (const PointDescription& point : scene_.points) {
      look(renderer::at_least_from(s, point.position), [&] { return name_of(point); });
    }
    for (std::size_t j = 0; reach > kPrecise * smallest && j < extents_.size(); ++j) {
      const double gap =
          std::max(renderer::at_least_from(s, extents_[j].center) - extents_[j].reach, 0.0);
      if (j != shape) look(gap + extents_[j].size, [&] { return renderer::name_of(scene_, j); });
    }
    if (beside.empty()) return false;
    check_emitter(shape, s, detail, center, beside);
    return true;
  }

  /// Lights are sampled in single precision, from their corners or centre: how high a point lies
  /// over a huge one has to be left of it. Seen from inside, a sphere has no such place.
  void check_emitter(std::size_t shape, const ExactShape& s, double detail, const Vec3d& center,
                     const std::string& beside) const {
    if (!scene_.shapes[shape].radiance) return;
    const auto* sphere = std::get_if<SphereShape>(&scene_.shapes[shape].geometry);
    if (sphere != nullptr && sphere->flip_normals) return;
    const Vec3d o = s.origin() - center, n = s.normal();
    const double rounded = sphere != nullptr
                               ? length(o)
                               : std::abs(n.x * o.x) + std::abs(n.y * o.y) + std::abs(n.z * o.z);
    if (rounded <= kRecognizable * detail) return;
    refuse({shape, beside, "emits and is too large for single precision to sample it beside"});
  }

  const PlacedParts& scene_;
  Vec3d middle_;
  std::vector<Extent> extents_;
  std::size_t surfaces_ = 0;
  double camera_clearance_ = kInfinity;  // from the nearest surface that it does not lie on
};

}  // namespace

Placement place(const PlacedParts& scene, const Vec3d& middle) {
  Placement placement = Placer(scene, middle).place();
  find_coincident(scene, placement);
  return placement;
}

}  // namespace plumbline::renderer
