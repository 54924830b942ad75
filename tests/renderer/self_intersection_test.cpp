#include <gtest/gtest.h>

#include <cmath>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/core/scene/scene.h>
#include "scenes.h"

/// Rays that start on a surface neither hit it again (a black speck) nor start behind it (a leak).
namespace plumbline::renderer {
namespace {

constexpr int kStarts = 200'000;

/// Shoots rays at the only shape of a scene and starts new ones where they land.
struct Outcome {
  int landed = 0, false_hits = 0, leaks = 0;
};

Vec3f random_direction(Pcg32& random) { return square_to_uniform_sphere(random.next_2d()); }

/// @param target  a random point on the shape, relative to the scene's centre
template <class Target>
Outcome start_rays(const Scene& scene, float camera_distance, const Target& target) {
  Outcome outcome;
  Pcg32 random(1, 0, 0);
  for (int i = 0; i < kStarts; ++i) {
    const Vec3f origin = random_direction(random) * camera_distance;
    const auto hit = scene.intersect({origin, normalize(target(random) - origin)});
    if (!hit) continue;
    ++outcome.landed;
    // A direction within the hemisphere on the side the ray came from; the shape is flat or convex
    // from there, so nothing can be hit, while one through the surface must start below it.
    const Vec3f side = dot(hit->normal, origin - hit->position) > 0 ? hit->normal : -hit->normal;
    Vec3f leaving = random_direction(random);
    if (dot(leaving, side) < 0) leaving = -leaving;
    outcome.false_hits += scene.occluded(hit->ray_along(leaving));
    const Vec3f start = hit->origin_towards(side);
    outcome.leaks += !scene.occluded({start, -side});
  }
  return outcome;
}

void expect_clean(const Outcome& outcome, const char* what) {
  EXPECT_GT(outcome.landed, kStarts / 10) << what;
  EXPECT_EQ(outcome.false_hits, 0) << what;
  EXPECT_EQ(outcome.leaks, 0) << what;
}

TEST(SelfIntersection, SpheresOfManySizesSeenFromFar) {
  for (const double radius : {1e-3, 1.0, 1e3}) {
    for (const float distance : {1.5f, 10.0f, 1000.0f}) {
      SceneDescription scene = tests::empty_scene(1, 1);
      scene.shapes.push_back({SphereShape{{0, 0, 0}, radius, false}, 0, {}});
      const auto r = static_cast<float>(radius);
      expect_clean(start_rays(make_scene(scene), distance * r,
                              [r](Pcg32& random) { return random_direction(random) * (0.9f * r); }),
                   "sphere");
    }
  }
}

TEST(SelfIntersection, SphereAwayFromTheCentreOfTheScene) {
  SceneDescription scene = tests::empty_scene(1, 1);
  scene.shapes.push_back({SphereShape{{10, -10, 5}, 1, false}, 0, {}});
  // A speck in the opposite corner keeps the scene's centre at 0; 5e-5 stray rays are expected to
  // hit it.
  scene.shapes.push_back({SphereShape{{-10.999, 10.999, -5.999}, 1e-3, false}, 0, {}});
  expect_clean(start_rays(make_scene(scene), 100.0f,
                          [](Pcg32& random) {
                            return Vec3f{10, -10, 5} + random_direction(random) * 0.9f;
                          }),
               "sphere off centre");
}

/// A tilted frame, so that no coordinate is exact.
const Vec3d kU{0.8, 0.36, 0.48}, kV{-0.6, 0.48, 0.64};

template <class Shape>
void expect_clean_flat(const Shape& shape, const char* what) {
  SceneDescription scene = tests::empty_scene(1, 1);
  scene.shapes.push_back({shape, 0, {}});
  for (const float distance : {2.0f, 1000.0f}) {
    expect_clean(start_rays(make_scene(scene), distance,
                            [](Pcg32& random) {
                              const Vec2f u = random.next_2d();
                              return vec_cast<float>(kU) * (u.x - 0.5f) +
                                     vec_cast<float>(kV) * (u.y - 0.5f);
                            }),
                 what);
  }
}

TEST(SelfIntersection, TiltedRectangleDiskAndTriangles) {
  const Vec3d corner = (kU + kV) * -1.0;
  expect_clean_flat(RectangleShape{corner, kU * 2, kV * 2, false}, "rectangle");
  expect_clean_flat(DiskShape{{0, 0, 0}, normalize(cross(kU, kV)), 1}, "disk");
  const MeshShape mesh{{corner, corner + kU * 2, corner + kV * 2, corner + kU * 2 + kV * 2},
                       {{{0, 1, 2}}, {{1, 3, 2}}},
                       false};
  expect_clean_flat(mesh, "triangles");
}

TEST(SelfIntersection, ThinGapUnderALargeFloorStaysClosed) {
  // A floor 1e4 wide and a lid 1e-4 above it: light from above the lid must not reach the floor.
  SceneDescription scene = tests::empty_scene(1, 1);
  for (const double height : {0.0, 1e-4}) {
    scene.shapes.push_back(
        {RectangleShape{{-5e3, height, -5e3}, {0, 0, 1e4}, {1e4, 0, 0}, false}, 0, {}});
  }
  const Scene gap = make_scene(scene);
  Pcg32 random(1, 0, 0);
  for (int i = 0; i < kStarts; ++i) {
    const Vec2f u = random.next_2d();
    // From within the gap down to the floor (the scene's centre is the middle of the gap).
    const Vec3f inside{(u.x - 0.5f) * 20, 0, (u.y - 0.5f) * 20};
    const auto floor = gap.intersect({inside, {0, -1, 0}});
    ASSERT_TRUE(floor);
    const Vec3f up = square_to_cosine_hemisphere(random.next_2d());
    const Vec3f direction{up.x, up.z, up.y};
    ASSERT_TRUE(gap.occluded(floor->ray_along(direction)));
  }
}

}  // namespace
}  // namespace plumbline::renderer
