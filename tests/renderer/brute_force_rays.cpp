#include "brute_force_rays.h"

#include <algorithm>
#include <cmath>

#include <plumbline/renderer/core/sampling/warps.h>
#include <plumbline/renderer/core/scene/surface_hit.h>

namespace plumbline::tests {

using namespace renderer;

HardRays::HardRays(const SceneGeometry& geometry, std::uint64_t seed)
    : geometry_(geometry), random_(seed, 0, 0) {
  for (unsigned kind = 0; kind < kExact; ++kind) {
    for (std::size_t i = 0; i < geometry.primitives[kind].size(); ++i) all_.push_back({kind, i});
  }
  const auto grow = [&](const Vec3f& p, float radius) {
    size_ = std::max(size_, static_cast<double>(max_norm(p) + radius));
  };
  for (const Vec3f& v : geometry.vertices) grow(v, 0);
  for (const Disk& d : geometry.disks) grow(d.center, d.radius);
  for (const Sphere& s : geometry.spheres) grow(s.center, s.radius);
}

double HardRays::size_between(double low, double high) {
  return low * std::pow(high / low, uniform());
}

Vec3d HardRays::direction() {
  return vec_cast<double>(square_to_uniform_sphere(random_.next_2d()));
}

HardRays::Place HardRays::place_on(unsigned kind, std::size_t index) {
  double u = uniform(), v = uniform();
  if (is_flat(kind)) {
    if (kind == kTriangles && u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Corners c = geometry_.primitives[kind][index].corners;
    const Vec3d v0 = vec_cast<double>(c.v0);
    return {v0 + (vec_cast<double>(c.v1) - v0) * u + (vec_cast<double>(c.v2) - v0) * v,
            vec_cast<double>(geometry_.primitives[kind][index].normal)};
  }
  if (kind == kDisks) {
    const Vec3d n = vec_cast<double>(geometry_.disk_normals[index]);
    const Disk& disk = geometry_.disks[index];
    const Vec3d out = normalize(cross(n, direction()));
    return {vec_cast<double>(disk.center) + out * (std::sqrt(u) * static_cast<double>(disk.radius)),
            n};
  }
  const Sphere& sphere = geometry_.spheres[index];
  const Vec3d n = direction();
  return {vec_cast<double>(sphere.center) + n * static_cast<double>(sphere.radius), n};
}

HardRays::Place HardRays::somewhere() {
  const auto& [kind, index] = all_[static_cast<std::size_t>(uniform() * double(all_.size()))];
  return place_on(kind, index);
}

Vec3d HardRays::on_an_edge() {
  const auto& [kind, index] = all_[static_cast<std::size_t>(uniform() * double(all_.size()))];
  if (is_flat(kind)) {
    std::vector<Vec3d> corners;
    if (kind == kTriangles) {
      for (const auto i : geometry_.triangles[index]) {
        corners.push_back(vec_cast<double>(geometry_.vertices[i]));
      }
    } else {
      for (const auto i : geometry_.rectangles[index]) {
        corners.push_back(vec_cast<double>(geometry_.vertices[i]));
      }
    }
    const auto i = static_cast<std::size_t>(uniform() * double(corners.size()));
    const double along = uniform() < 0.25 ? 0 : uniform();
    return corners[i] + (corners[(i + 1) % corners.size()] - corners[i]) * along;
  }
  if (kind == kDisks) {
    const Disk& disk = geometry_.disks[index];
    const Vec3d out =
        normalize(cross(vec_cast<double>(geometry_.disk_normals[index]), direction()));
    return vec_cast<double>(disk.center) + out * static_cast<double>(disk.radius);
  }
  return place_on(kind, index).point;
}

Vec3f HardRays::beside(const Place& place, double side) const {
  return vec_cast<float>(place.point + place.normal * (side * 2e-6 * size_));
}

Ray HardRays::ordinary() {
  const Place from = somewhere();
  const Vec3f d = square_to_uniform_sphere(random_.next_2d());
  return {beside(from, dot(from.normal, vec_cast<double>(d)) < 0 ? -1 : 1), d};
}

Ray HardRays::next() {
  const double which = uniform();
  Place from = somewhere();
  if (which > 0.75) from.point = direction() * (3 * size_);
  const double side = uniform() < 0.5 ? 1 : -1;
  const Vec3f origin = beside(from, side);
  const Vec3d start = vec_cast<double>(origin);
  Vec3d d = direction();
  if (which < 0.15) {
    const Vec3d n = uniform() < 0.5 ? from.normal : somewhere().normal;
    d = normalize(cross(n, d)) + n * (side * size_between(1e-6, 1e-1));
  } else if (which < 0.5) {
    const double beside = uniform() < 0.25 ? 0 : size_between(1e-9, 1e-2) * size_;
    d = on_an_edge() + direction() * beside - start;
  } else if (which > 0.75) {
    d = somewhere().point - start;
  }
  if (!(length(d) > 1e-3 * size_)) d = direction();
  return {origin, vec_cast<float>(normalize(d))};
}

}  // namespace plumbline::tests
