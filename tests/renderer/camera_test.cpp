#include <plumbline/renderer/core/scene/camera.h>

#include <gtest/gtest.h>

namespace plumbline::renderer {
namespace {

CameraDescription wide_camera() {
  return {.origin = {10, 20, 30},
          .left = {-1, 0, 0},
          .up = {0, 1, 0},
          .forward = {0, 0, 1},
          .tan_half_fov_x = 0.5,
          .width = 200,
          .height = 100};
}

TEST(Camera, CentreOfTheFilmLooksForward) {
  const Ray ray = Camera(wide_camera(), {}).ray(100, 50);
  EXPECT_FLOAT_EQ(ray.direction.x, 0);
  EXPECT_FLOAT_EQ(ray.direction.y, 0);
  EXPECT_FLOAT_EQ(ray.direction.z, 1);
}

TEST(Camera, FilmEdgesSpanTheFieldOfViewWithSquarePixels) {
  const Camera camera(wide_camera(), {});
  const Vec3f right = camera.ray(200, 50).direction;
  EXPECT_FLOAT_EQ(right.x / right.z, 0.5f);  // against `left`, at tan of half the horizontal field
  const Vec3f bottom = camera.ray(100, 100).direction;
  EXPECT_FLOAT_EQ(bottom.y / bottom.z, -0.25f);  // half as high as wide
}

TEST(Camera, MovesWithTheScene) {
  const Ray ray = Camera(wide_camera(), {10, 20, 29}).ray(1, 1);
  EXPECT_FLOAT_EQ(ray.origin.x, 0);
  EXPECT_FLOAT_EQ(ray.origin.y, 0);
  EXPECT_FLOAT_EQ(ray.origin.z, 1);
}

}  // namespace
}  // namespace plumbline::renderer
