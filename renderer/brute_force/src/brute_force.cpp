#include <plumbline/renderer/brute_force/brute_force.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "kernels.h"

namespace plumbline::renderer {
namespace {

using namespace brute_force;

/// Bound of the error of u·cosθ = A·(w cosθ − (n·w) d), w from the corner to the origin, for unit
/// roundoff ε = 2⁻²⁴: n and A are rounded once, as is w; a product and two sums add three. Of cosθ
/// = n·d 4ε are lost, of n·w 5ε|w|, of what A is multiplied by 7ε (|w_i| + |w||d_i|), and of all
/// together 11ε |A|·2|w|. Comparing with cosθ takes another 5ε.
constexpr double kRoundoff = 0x1p-24, kPlaceErrors = 24, kCosineErrors = 6;

template <std::size_t N>
void add_flat(const std::array<Vec3f, N>& corners, Flats<N>& flats) {
  std::array<Vec3d, N> c;
  for (std::size_t i = 0; i < N; ++i) c[i] = vec_cast<double>(corners[i]);
  const Vec3d e1 = c[1] - c[0], e2 = c[N - 1] - c[0], n = cross(e1, e2);
  const Vec3d along_u = cross(e2, n) / length_squared(n),
              along_v = cross(n, e1) / length_squared(n);
  const double size = length(along_u) + length(along_v);
  // Four rounded corners are a parallelogram but for rounding.
  const double bend = N == 4 ? length(c[1] + c[N - 1] - c[0] - c[2]) : 0;
  const double per_length = kPlaceErrors * kRoundoff * size;
  flats.normal.add(normalize(n));
  flats.corner.add(c[0]);
  flats.along_u.add(along_u);
  flats.along_v.add(along_v);
  flats.slack.add(per_length * length(c[0]) + kCosineErrors * kRoundoff + size * bend);
  flats.slack_by_origin.add(per_length * std::sqrt(3.0));
  flats.outlines.push_back(c);
}

Tables tables_of(const SceneGeometry& geometry) {
  Tables tables;
  const std::vector<Vec3f>& v = geometry.vertices;
  for (const Rectangle& r : geometry.rectangles) {
    add_flat<4>({v[r[0]], v[r[1]], v[r[2]], v[r[3]]}, tables.rectangles);
  }
  for (const Triangle& t : geometry.triangles) {
    add_flat<3>({v[t[0]], v[t[1]], v[t[2]]}, tables.triangles);
  }
  for (std::size_t i = 0; i < geometry.disks.size(); ++i) {
    tables.disks.center.add(vec_cast<double>(geometry.disks[i].center));
    tables.disks.normal.add(vec_cast<double>(geometry.disk_normals[i]));
    tables.disks.radius_squared.add(sqr(static_cast<double>(geometry.disks[i].radius)));
  }
  for (const Sphere& sphere : geometry.spheres) {
    tables.spheres.center.add(vec_cast<double>(sphere.center));
    tables.spheres.radius_squared.add(sqr(static_cast<double>(sphere.radius)));
  }
  return tables;
}

class BruteForce final : public RayEngine {
 public:
  explicit BruteForce(const SceneGeometry& geometry) : tables_(tables_of(geometry)) {}

  void intersect(RTCRayHit16& rays) const override { brute_force::intersect(tables_, rays); }
  void occluded(RTCRay16& rays) const override { brute_force::occluded(tables_, rays); }
  std::optional<PrimitiveHit> intersect(const Ray& ray) const override {
    return brute_force::intersect(tables_, ray);
  }
  bool occluded(const Ray& ray) const override { return brute_force::occluded(tables_, ray); }

 private:
  Tables tables_;
};

}  // namespace

bool brute_force_can_trace(const SceneGeometry& geometry) { return geometry.exact.empty(); }

std::unique_ptr<RayEngine> make_brute_force(const SceneGeometry& geometry) {
  return std::make_unique<BruteForce>(geometry);
}

}  // namespace plumbline::renderer
