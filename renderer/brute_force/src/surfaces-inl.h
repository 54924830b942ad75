/// The arithmetic of rays and surfaces, the same for sixteen rays against one surface and for one
/// ray against several. Compiled once for each instruction set, as Highway's headers are.
#if defined(PLUMBLINE_BRUTE_FORCE_SURFACES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUMBLINE_BRUTE_FORCE_SURFACES_INL_H
#undef PLUMBLINE_BRUTE_FORCE_SURFACES_INL_H
#else
#define PLUMBLINE_BRUTE_FORCE_SURFACES_INL_H
#endif

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include <plumbline/renderer/core/scene/geometry.h>
#include "tables.h"

HWY_BEFORE_NAMESPACE();
namespace plumbline::renderer::brute_force::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = HWY_CAPPED(float, embree::kPacket);
using V = hn::VFromD<Floats>;
using M = decltype(hn::MaskFromVec(V()));
using Indices = hn::RebindToUnsigned<Floats>;
using I = hn::VFromD<Indices>;

constexpr Floats kFloats{};
constexpr Indices kIndices{};

struct Vec {
  V x, y, z;
};

HWY_INLINE Vec all(const Vec3f& a) {
  return {hn::Set(kFloats, a.x), hn::Set(kFloats, a.y), hn::Set(kFloats, a.z)};
}

HWY_INLINE Vec times(V a, const Vec& b) {
  return {hn::Mul(a, b.x), hn::Mul(a, b.y), hn::Mul(a, b.z)};
}

HWY_INLINE Vec minus(const Vec& a, const Vec& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

// Products and sums apart: a fused one would round otherwise, and not every instruction set has it.
HWY_INLINE V plus_product(V sum, V a, V b) { return hn::Add(sum, hn::Mul(a, b)); }

HWY_INLINE V inner(const Vec& a, const Vec& b) {
  return plus_product(plus_product(hn::Mul(a.x, b.x), a.y, b.y), a.z, b.z);
}

/// One primitive for all lanes, or as many as there are lanes.
struct One {
  std::size_t i;

  HWY_INLINE V operator()(const Column& c) const { return hn::Set(kFloats, c[i]); }
  HWY_INLINE Vec operator()(const Column3& c) const {
    return {(*this)(c.x), (*this)(c.y), (*this)(c.z)};
  }
};

struct Several {
  std::size_t first;

  HWY_INLINE V operator()(const Column& c) const { return hn::LoadU(kFloats, c.from(first)); }
  HWY_INLINE Vec operator()(const Column3& c) const {
    return {(*this)(c.x), (*this)(c.y), (*this)(c.z)};
  }
};

struct Rays {
  Vec origin, direction;
  V reach;       // largest coordinate of the origin
  V per_length;  // 1/|d|², 1 but for rounding

  HWY_INLINE Rays(const Vec& o, const Vec& d)
      : origin(o),
        direction(d),
        reach(hn::Max(hn::Max(hn::Abs(o.x), hn::Abs(o.y)), hn::Abs(o.z))),
        per_length(hn::Div(hn::Set(kFloats, 1.0f), inner(d, d))) {}
};

/// A distance as a fraction, whose denominator is positive: most surfaces are not the nearest, and
/// a division takes as long as all else that tells so.
struct Distance {
  V over, under;

  HWY_INLINE M is_before(const Distance& other) const {
    return hn::And(hn::Ge(over, hn::Set(kFloats, kNearest)),
                   hn::Lt(hn::Mul(over, other.under), hn::Mul(other.over, under)));
  }
};

/// Where rays meet the plane of a flat surface.
struct Crossing {
  Vec to_corner;
  Distance distance;  // `under` is the cosine

  template <class Pick, std::size_t N>
  HWY_INLINE Crossing(const Flats<N>& flats, Pick pick, const Rays& rays)
      : to_corner(minus(pick(flats.corner), rays.origin)) {
    const Vec normal = pick(flats.normal);
    const V across = inner(normal, rays.direction);
    const V sign = hn::And(across, hn::SignBit(kFloats));
    distance.over = hn::Xor(inner(normal, to_corner), sign);
    distance.under = hn::Xor(across, sign);
  }
};

/// Where in the plane that is, times the cosine; and how far inside the nearest edge, which may be
/// wrong by `slack`.
struct Place {
  V u, v, inside, slack;

  template <class Pick, std::size_t N>
  HWY_INLINE Place(const Flats<N>& flats, Pick pick, const Rays& rays, const Crossing& at) {
    const V under = at.distance.under;
    const Vec offset = minus(times(at.distance.over, rays.direction), times(under, at.to_corner));
    u = inner(pick(flats.along_u), offset);
    v = inner(pick(flats.along_v), offset);
    const V farthest = N == 3 ? hn::Add(u, v) : hn::Max(u, v);
    inside = hn::Min(hn::Min(u, v), hn::Sub(under, farthest));
    slack = plus_product(pick(flats.slack), rays.reach, pick(flats.slack_by_origin));
  }
};

HWY_INLINE M may_be_inside(const Place& place) {
  return hn::Ge(hn::Add(place.inside, place.slack), hn::Zero(kFloats));
}

/// Round surfaces: a distance, and NaN where they are missed.
template <class Pick>
HWY_INLINE Distance meet(const Disks& disks, Pick pick, const Rays& rays) {
  const Vec normal = pick(disks.normal), to_center = minus(pick(disks.center), rays.origin);
  const V t = hn::Div(inner(normal, to_center), inner(normal, rays.direction));
  const Vec p = minus(times(t, rays.direction), to_center);
  const M inside = hn::Lt(inner(p, p), pick(disks.radius_squared));
  return {hn::IfThenElse(inside, t, hn::NaN(kFloats)), hn::Set(kFloats, 1.0f)};
}

template <class Pick>
HWY_INLINE Distance meet(const Spheres& spheres, Pick pick, const Rays& rays) {
  const Vec to_center = minus(pick(spheres.center), rays.origin);
  const V middle = hn::Mul(inner(to_center, rays.direction), rays.per_length);
  const Vec aside = minus(to_center, times(middle, rays.direction));
  const V left = hn::Sub(pick(spheres.radius_squared), inner(aside, aside));
  const V half = hn::Sqrt(hn::Mul(left, rays.per_length));  // NaN where the ray passes by
  const V front = hn::Sub(middle, half), back = hn::Add(middle, half);
  const M is_outside = hn::Ge(front, hn::Set(kFloats, kNearest));
  return {hn::IfThenElse(is_outside, front, back), hn::Set(kFloats, 1.0f)};
}

/// A fraction in [0, 1], also where rounding takes it outside, or 0/0.
HWY_INLINE V share(V over, V under) {
  const V zero = hn::Zero(kFloats), one = hn::Set(kFloats, 1.0f);
  const V x = hn::Div(over, under);
  return hn::IfThenElse(hn::Gt(x, zero), hn::IfThenElse(hn::Lt(x, one), x, one), zero);
}

}  // namespace plumbline::renderer::brute_force::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
