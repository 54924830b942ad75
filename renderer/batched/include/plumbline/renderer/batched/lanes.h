#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <plumbline/renderer/core/math.h>

/// Values of many rays side by side, component by component, so that loops over them vectorise.
namespace plumbline::renderer {

/// Rays that are traced and shaded together: enough to fill packets after sorting, few enough that
/// their state stays in a core's cache. A multiple of the packets' width.
inline constexpr std::size_t kBatch = 2048;

template <class T, std::size_t N = kBatch>
struct alignas(64) Lanes : std::array<T, N> {};

template <std::size_t N = kBatch>
struct Vec3LanesOf {
  Lanes<float, N> x, y, z;

  Vec3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const Vec3f& v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

using Vec3Lanes = Vec3LanesOf<>;

struct RgbLanes {
  Lanes<float> r, g, b;

  Rgbf operator[](std::size_t i) const { return {r[i], g[i], b[i]}; }
  void set(std::size_t i, const Rgbf& c) {
    r[i] = c.r;
    g[i] = c.g;
    b[i] = c.b;
  }
};

using IndexLanes = Lanes<std::uint32_t>;

struct RayLanes {
  Vec3Lanes origin, direction;
};

inline constexpr std::uint32_t kNoHit = 0xffffffffu;

/// What a nearest-hit query finds, in the order of tracing; `bsdf` is kNoHit where a ray escapes,
/// and the rest then without a meaning.
struct HitLanes {
  Vec3Lanes position, normal;
  Lanes<float> offset;
  IndexLanes bsdf, light;
};

inline constexpr std::uint32_t kOctants = 8;

/// Order in which rays walk the tree alike: the signs of their direction, in [0, kOctants).
inline std::uint32_t octant(const Vec3f& d) {
  return (d.x < 0 ? 1u : 0u) | (d.y < 0 ? 2u : 0u) | (d.z < 0 ? 4u : 0u);
}

}  // namespace plumbline::renderer
