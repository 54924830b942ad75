#include <cmath>

#include <plumbline/analytic/shadow.h>

#include "floor_oracle.h"
#include "scenes.h"

/// Scenes in which something stands between the light and the floor.
namespace plumbline::analytic {
namespace {

// edge_shadow.xml: a disk of radius 1 at height 2.4 over a black half plane x ≤ 0 at height 0.8.
constexpr double kDiskRadius = 1, kDiskHeight = 2.4, kEdgeHeight = 0.8;

std::unique_ptr<PixelOracle> make_edge_shadow(const OracleInput& input) {
  const Colour reflected = reflected_radiance(input);
  // The blocker ends at x = -20, y = ±10, far outside the lines from what is seen to the disk.
  return floor_oracle(input.camera, 1,
                      [reflected](const Vec3& p, const Vec3&) {
                        // The ray to the disk's point x' passes the blocker's plane at x + (x' − x)
                        // h/H ≥ 0.
                        const double from_x = p.x * (1 - kDiskHeight / kEdgeHeight);
                        return reflected *
                               disk_part_irradiance(kDiskRadius, kDiskHeight, p.x, p.y, from_x);
                      },
                      {1e-11, 1e-6, 4});
}

KnownScene edge_shadow() {
  KnownScene scene = floor_scene(
      "edge_shadow",
      "L = albedo / pi * Le * the irradiance of the part of a disk that an edge leaves, from none "
      "of it to all",
      make_edge_shadow);
  scene.view = {{0, 0, 0.5}, {0, 0, 0}, {0, 1, 0}, 90};
  scene.parameters = {light_radiance({7, 10, 12}), floor_albedo({0.9, 0.75, 0.4})};
  return scene;
}

// sphere_shadow.xml: a light of radius 1 at height 3, a black sphere of radius 0.75 at height 1.5.
constexpr double kLightRadius = 1, kLightHeight = 3, kBlockerRadius = 0.75, kBlockerHeight = 1.5;

SphereCone cone_towards(const Vec3& center, double radius, const Vec3& from) {
  const Vec3 offset = center - from;
  const double distance = std::sqrt(dot(offset, offset));
  return {offset.x / distance, offset.y / distance, offset.z / distance,
          std::asin(radius / distance)};
}

std::unique_ptr<PixelOracle> make_sphere_shadow(const OracleInput& input) {
  const Colour reflected = reflected_radiance(input);
  const Vec3 blocker{parameter(input, "blocker_x"), 0, kBlockerHeight};
  return floor_oracle(input.camera, 1,
                      [=](const Vec3& p, const Vec3&) {
                        return reflected * eclipsed_irradiance(
                                               cone_towards({0, 0, kLightHeight}, kLightRadius, p),
                                               cone_towards(blocker, kBlockerRadius, p));
                      },
                      {1e-7, 1e-5, 4});
}

KnownScene sphere_shadow() {
  KnownScene scene = floor_scene(
      "sphere_shadow",
      "L = albedo / pi * Le * the irradiance of the part of a sphere that another leaves: 0 in the "
      "umbra, by quadrature in the penumbra",
      make_sphere_shadow);
  scene.view = {{0, 0, 0.5}, {0, 0, 0}, {0, 1, 0}, 60};
  scene.parameters = {{"blocker_x", 0.9, "how far the blocker stands aside [m]"},
                      light_radiance({7, 10, 12}),
                      floor_albedo({0.9, 0.75, 0.4})};
  scene.variants = {{"umbra", {{"blocker_x", 0.0}}, {}}, {"clear", {{"blocker_x", 3.0}}, {}}};
  return scene;
}

}  // namespace

std::vector<KnownScene> shadow_scenes() { return {edge_shadow(), sphere_shadow()}; }

}  // namespace plumbline::analytic
