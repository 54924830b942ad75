#include "kernels.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include <plumbline/renderer/core/scene/geometry.h>

// This file is compiled once for each instruction set, by including itself.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "surfaces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plumbline::renderer::brute_force::HWY_NAMESPACE {

/// As many of a packet's rays as fit into a vector, from lane `first` on.
struct PacketRays {
  const RTCRay16& packet;
  std::size_t first;
  Rays rays;

  HWY_INLINE PacketRays(const RTCRay16& p, std::size_t from)
      : packet(p),
        first(from),
        rays({hn::LoadU(kFloats, p.org_x + from), hn::LoadU(kFloats, p.org_y + from),
              hn::LoadU(kFloats, p.org_z + from)},
             {hn::LoadU(kFloats, p.dir_x + from), hn::LoadU(kFloats, p.dir_y + from),
              hn::LoadU(kFloats, p.dir_z + from)}) {}

  HWY_INLINE Distance farthest() const {
    return {hn::LoadU(kFloats, packet.tfar + first), hn::Set(kFloats, 1.0f)};
  }
};

/// Tells which of the lanes that pass an edge within rounding really meet a surface, and where.
template <std::size_t N>
HWY_NOINLINE M decide(const std::array<Vec3d, N>& outline, const PacketRays& lanes, M asked,
                      V under, Place& place) {
  alignas(64) float answers[embree::kPacket], cosine[embree::kPacket];
  alignas(64) float u[embree::kPacket], v[embree::kPacket];
  hn::Store(hn::IfThenElse(asked, hn::Set(kFloats, 1.0f), hn::Zero(kFloats)), kFloats, answers);
  hn::Store(under, kFloats, cosine);
  hn::Store(place.u, kFloats, u);
  hn::Store(place.v, kFloats, v);
  for (std::size_t k = 0; k < hn::Lanes(kFloats); ++k) {
    if (answers[k] == 0) continue;
    const RTCRay16& rays = lanes.packet;
    const std::size_t i = lanes.first + k;
    const auto inside = place_inside(outline, Vec3f{rays.org_x[i], rays.org_y[i], rays.org_z[i]},
                                     Vec3f{rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]});
    if (!inside) {
      answers[k] = 0;
      continue;
    }
    u[k] = inside->x * cosine[k];
    v[k] = inside->y * cosine[k];
  }
  place.u = hn::Load(kFloats, u);
  place.v = hn::Load(kFloats, v);
  return hn::Gt(hn::Load(kFloats, answers), hn::Zero(kFloats));
}

/// The nearest hits so far of as many rays as fit into a vector.
struct Nearest {
  Distance distance;
  V u, v;  // on a flat surface, times distance.under
  I kind, index;

  HWY_INLINE explicit Nearest(const Distance& farthest)
      : distance(farthest),
        u(hn::Zero(kFloats)),
        v(u),
        kind(hn::Set(kIndices, RTC_INVALID_GEOMETRY_ID)),
        index(kind) {}

  HWY_INLINE void take(M hit, const Distance& d, unsigned of_kind, std::size_t number) {
    distance.over = hn::IfThenElse(hit, d.over, distance.over);
    distance.under = hn::IfThenElse(hit, d.under, distance.under);
    const auto is_hit = hn::RebindMask(kIndices, hit);
    kind = hn::IfThenElse(is_hit, hn::Set(kIndices, of_kind), kind);
    index = hn::IfThenElse(is_hit, hn::Set(kIndices, static_cast<std::uint32_t>(number)), index);
  }

  HWY_INLINE void take_place(M hit, const Place& place) {
    u = hn::IfThenElse(hit, place.u, u);
    v = hn::IfThenElse(hit, place.v, v);
  }

  HWY_INLINE bool is_settled() const { return false; }
};

/// Where rays that have met nothing yet end: those that have at −∞.
struct Any {
  Distance distance;

  HWY_INLINE explicit Any(const Distance& farthest) : distance(farthest) {}

  HWY_INLINE void take(M hit, const Distance&, unsigned, std::size_t) {
    const V blocked = hn::Set(kFloats, -std::numeric_limits<float>::infinity());
    distance.over = hn::IfThenElse(hit, blocked, distance.over);
  }

  HWY_INLINE void take_place(M, const Place&) {}

  HWY_INLINE bool is_settled() const {
    return hn::AllTrue(kFloats, hn::Lt(distance.over, hn::Zero(kFloats)));
  }
};

template <std::size_t N, class Found>
HWY_INLINE void meet_flats(const Flats<N>& flats, const PacketRays& lanes, Found& found) {
  for (std::size_t i = 0; i < flats.outlines.size(); ++i) {
    const Crossing crossing(flats, One{i}, lanes.rays);
    M hit = crossing.distance.is_before(found.distance);
    if (hn::AllFalse(kFloats, hit)) continue;
    Place place(flats, One{i}, lanes.rays, crossing);
    hit = hn::And(hit, may_be_inside(place));
    if (hn::AllFalse(kFloats, hit)) continue;
    const M close = hn::And(hit, hn::Le(place.inside, place.slack));
    if (HWY_UNLIKELY(!hn::AllFalse(kFloats, close))) {
      const V under = crossing.distance.under;
      hit = hn::Or(hn::AndNot(close, hit), decide(flats.outlines[i], lanes, close, under, place));
    }
    found.take(hit, crossing.distance, N == 3 ? kTriangles : kRectangles, i);
    found.take_place(hit, place);
    if (found.is_settled()) return;
  }
}

template <class Surfaces, class Found>
HWY_INLINE void meet_round(const Surfaces& surfaces, unsigned kind, const PacketRays& lanes,
                           Found& found) {
  for (std::size_t i = 0; i < surfaces.radius_squared.size(); ++i) {
    const Distance distance = meet(surfaces, One{i}, lanes.rays);
    found.take(distance.is_before(found.distance), distance, kind, i);
  }
}

template <class Found>
HWY_INLINE Found meet_all(const Tables& tables, const RTCRay16& packet, std::size_t first) {
  const PacketRays lanes(packet, first);
  Found found(lanes.farthest());
  meet_flats(tables.rectangles, lanes, found);
  meet_flats(tables.triangles, lanes, found);
  meet_round(tables.disks, kDisks, lanes, found);
  meet_round(tables.spheres, kSpheres, lanes, found);
  return found;
}

void intersect_packet(const Tables& tables, RTCRayHit16& rays) {
  for (std::size_t first = 0; first < embree::kPacket; first += hn::Lanes(kFloats)) {
    const auto found = meet_all<Nearest>(tables, rays.ray, first);
    const V under = found.distance.under;
    hn::StoreU(found.kind, kIndices, rays.hit.geomID + first);
    hn::StoreU(found.index, kIndices, rays.hit.primID + first);
    hn::StoreU(share(found.u, under), kFloats, rays.hit.u + first);
    hn::StoreU(share(found.v, under), kFloats, rays.hit.v + first);
    hn::StoreU(hn::Div(found.distance.over, under), kFloats, rays.ray.tfar + first);
  }
}

void occluded_packet(const Tables& tables, RTCRay16& rays) {
  for (std::size_t first = 0; first < embree::kPacket; first += hn::Lanes(kFloats)) {
    hn::StoreU(meet_all<Any>(tables, rays, first).distance.over, kFloats, rays.tfar + first);
  }
}

/// The nearest hit so far of one ray.
struct NearestOfOne {
  float over, under = 1, u = 0, v = 0;
  unsigned kind = RTC_INVALID_GEOMETRY_ID, index = 0;

  HWY_INLINE Distance distance() const { return {hn::Set(kFloats, over), hn::Set(kFloats, under)}; }
};

/// Calls function(lane) for the lanes of a mask in order.
template <class Function>
HWY_INLINE void for_each_lane(M mask, const Function& function) {
  std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(kFloats, mask, bytes.data());
  for (unsigned bits = bytes[0] | unsigned{bytes[1]} << 8; bits != 0; bits &= bits - 1) {
    function(static_cast<std::size_t>(std::countr_zero(bits)));
  }
}

/// Distances of as many primitives as fit into a vector, to be looked at one by one.
struct StoredDistances {
  alignas(64) float over[embree::kPacket], under[embree::kPacket];

  HWY_INLINE explicit StoredDistances(const Distance& d) {
    hn::Store(d.over, kFloats, over);
    hn::Store(d.under, kFloats, under);
  }

  /// Takes a primitive if it is before what there is.
  HWY_INLINE bool is_before(std::size_t k, const NearestOfOne& nearest) const {
    return over[k] * nearest.under < nearest.over * under[k];
  }

  HWY_INLINE void take(std::size_t k, unsigned kind, std::size_t index,
                       NearestOfOne& nearest) const {
    nearest.over = over[k];
    nearest.under = under[k];
    nearest.kind = kind;
    nearest.index = static_cast<unsigned>(index);
  }
};

template <std::size_t N>
HWY_INLINE void meet_flats(const Flats<N>& flats, const Ray& ray, const Rays& rays,
                           NearestOfOne& nearest) {
  for (std::size_t first = 0; first < flats.outlines.size(); first += hn::Lanes(kFloats)) {
    const Crossing crossing(flats, Several{first}, rays);
    const Place place(flats, Several{first}, rays, crossing);
    const M hit = hn::And(crossing.distance.is_before(nearest.distance()), may_be_inside(place));
    if (hn::AllFalse(kFloats, hit)) continue;
    const StoredDistances distances(crossing.distance);
    alignas(64) float u[embree::kPacket], v[embree::kPacket], close[embree::kPacket];
    hn::Store(place.u, kFloats, u);
    hn::Store(place.v, kFloats, v);
    hn::Store(hn::IfThenElse(hn::Le(place.inside, place.slack), hn::Set(kFloats, 1.0f),
                             hn::Zero(kFloats)),
              kFloats, close);
    for_each_lane(hit, [&](std::size_t k) HWY_ATTR {
      if (!distances.is_before(k, nearest)) return;
      if (close[k] > 0) {
        const auto inside = place_inside(flats.outlines[first + k], ray.origin, ray.direction);
        if (!inside) return;
        u[k] = inside->x * distances.under[k];
        v[k] = inside->y * distances.under[k];
      }
      distances.take(k, N == 3 ? kTriangles : kRectangles, first + k, nearest);
      nearest.u = u[k];
      nearest.v = v[k];
    });
  }
}

template <class Surfaces>
HWY_INLINE void meet_round(const Surfaces& surfaces, unsigned kind, const Rays& rays,
                           NearestOfOne& nearest) {
  for (std::size_t first = 0; first < surfaces.radius_squared.size(); first += hn::Lanes(kFloats)) {
    const Distance distance = meet(surfaces, Several{first}, rays);
    const M hit = distance.is_before(nearest.distance());
    if (hn::AllFalse(kFloats, hit)) continue;
    const StoredDistances distances(distance);
    for_each_lane(hit, [&](std::size_t k) HWY_ATTR {
      if (distances.is_before(k, nearest)) distances.take(k, kind, first + k, nearest);
    });
  }
}

std::optional<PrimitiveHit> intersect_ray(const Tables& tables, const Ray& ray) {
  const Rays rays(all(ray.origin), all(ray.direction));
  NearestOfOne nearest{ray.t_max};
  meet_flats(tables.rectangles, ray, rays, nearest);
  meet_flats(tables.triangles, ray, rays, nearest);
  meet_round(tables.disks, kDisks, rays, nearest);
  meet_round(tables.spheres, kSpheres, rays, nearest);
  if (nearest.kind == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const V under = hn::Set(kFloats, nearest.under);
  return PrimitiveHit{
      nearest.kind, nearest.index, hn::GetLane(share(hn::Set(kFloats, nearest.u), under)),
      hn::GetLane(share(hn::Set(kFloats, nearest.v), under)), nearest.over / nearest.under};
}

}  // namespace plumbline::renderer::brute_force::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plumbline::renderer::brute_force {

HWY_EXPORT(intersect_packet);
HWY_EXPORT(occluded_packet);
HWY_EXPORT(intersect_ray);

void intersect(const Tables& tables, RTCRayHit16& rays) {
  HWY_DYNAMIC_DISPATCH(intersect_packet)(tables, rays);
}

void occluded(const Tables& tables, RTCRay16& rays) {
  HWY_DYNAMIC_DISPATCH(occluded_packet)(tables, rays);
}

std::optional<PrimitiveHit> intersect(const Tables& tables, const Ray& ray) {
  return HWY_DYNAMIC_DISPATCH(intersect_ray)(tables, ray);
}

// The nearest hit is as fast as any: all primitives are looked at side by side.
bool occluded(const Tables& tables, const Ray& ray) { return intersect(tables, ray).has_value(); }

}  // namespace plumbline::renderer::brute_force
#endif
