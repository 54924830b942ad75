#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/core/scene/geometry.h>
#include <plumbline/renderer/scene_file/load_scene.h>

/// Two surfaces in one place: the first in the file counts, for both backends.
namespace plumbline::tests {
namespace {

using namespace renderer;

constexpr double kLamp = 2;

const ShapeDescription kSky{RectangleShape{{-9, -9, 4}, {0, 18, 0}, {18, 0, 0}, false}, 0,
                            Rgbd{kLamp, kLamp, kLamp}};

/// Floors under a lamp that is black itself, so that a floor of albedo ρ gives ρ times the same.
SceneDescription floors(const std::vector<ShapeDescription>& shapes) {
  SceneDescription scene = load_scene(analytic::scene_file("furnace_open"));
  scene.environment.reset();
  scene.bsdfs = make_bsdfs(
      {Lambertian{{0, 0, 0}}, Lambertian{{0.8f, 0.8f, 0.8f}}, Lambertian{{0.2f, 0.2f, 0.2f}}});
  scene.shapes = shapes;
  scene.shapes.push_back(kSky);
  scene.camera.width = 16;
  scene.camera.height = 12;
  scene.camera.origin = {0.1, 0.2, 2};
  scene.camera.forward = normalize(Vec3d{0.1, 0.1, -1});
  const Frame<double> frame(scene.camera.forward);
  scene.camera.left = frame.tangent;
  scene.camera.up = frame.bitangent;
  scene.camera.tan_half_fov_x = 0.4;
  scene.integrator.max_depth = 2;
  return scene;
}

RenderResult rendered(const SceneDescription& scene, Backend backend) {
  RenderOptions options;
  options.path.max_depth = 2;
  options.samples_per_pixel = 16;
  options.backend = backend;
  return render(make_scene(scene), options);
}

ShapeDescription rectangle(double z, std::uint32_t bsdf, double half = 3) {
  return {RectangleShape{{-half, -half, z}, {2 * half, 0, 0}, {0, 2 * half, 0}, false}, bsdf, {}};
}

ShapeDescription mesh(std::uint32_t bsdf) {
  return {MeshShape{
              {{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}}, {{{0, 1, 2}}, {{0, 2, 3}}}, false},
          bsdf,
          {}};
}

/// Both backends give the picture of the first of two, and the same bits.
void expect_first(const ShapeDescription& first, const ShapeDescription& second) {
  const RenderResult scalar = rendered(floors({first, second}), Backend::scalar);
  const RenderResult batched = rendered(floors({first, second}), Backend::batched);
  const double alone = rendered(floors({first}), Backend::scalar).film.mean().g;
  EXPECT_LE(std::abs(scalar.film.mean().g / alone - 1), 1e-5);
  for (std::size_t i = 0; i < scalar.film.pixels().size(); ++i) {
    EXPECT_EQ(
        std::memcmp(&scalar.film.pixels()[i], &batched.film.pixels()[i], sizeof(PixelMoments)), 0)
        << "pixel " << i;
  }
}

TEST(Coincident, TheFirstInTheFileCounts) {
  const DiskShape disk{{0, 0, 0}, {0, 0, 1}, 5};
  const DiskShape turned{{0, 0, 0}, {0, 0, -1}, 5};
  const std::vector<std::pair<ShapeDescription, ShapeDescription>> pairs = {
      {rectangle(0, 1), rectangle(0, 2)},
      {rectangle(0, 1), rectangle(1e-9, 2, 5)},  // as near as rounding
      {rectangle(0, 1), {disk, 2, {}}},
      {rectangle(0, 1), {turned, 2, {}}},
      {mesh(1), rectangle(0, 2)},
      {mesh(1), mesh(2)},
      {{SphereShape{{0, 0, -7}, 7, false}, 1, {}}, {SphereShape{{0, 0, -7}, 7, false}, 2, {}}}};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    SCOPED_TRACE(i);
    auto [first, second] = pairs[i];
    expect_first(first, second);
    std::swap(first.bsdf, second.bsdf);
    expect_first(first, second);
  }
}

TEST(Coincident, WhatSharesAnEdgeOrLiesApartIsLeftToEmbree) {
  // Tiles of a floor, a step, and two planes that cross: the same bits as alone, but for what each
  // adds; an exact surface would round its points otherwise.
  const ShapeDescription tile{RectangleShape{{3, -3, 0}, {6, 0, 0}, {0, 6, 0}, false}, 2, {}};
  const ShapeDescription crossing{RectangleShape{{-3, -3, -1}, {6, 0, 2}, {0, 6, 0}, false}, 2, {}};
  for (const ShapeDescription& other : {tile, rectangle(1e-4, 2), crossing}) {
    SceneDescription scene = floors({rectangle(0, 1), other});
    const Scene made = make_scene(scene);
    EXPECT_TRUE(made.geometry().exact.empty());
  }
  EXPECT_EQ(make_scene(floors({rectangle(0, 1), rectangle(0, 2)})).geometry().exact.size(), 2u);
}

TEST(Coincident, AHiddenEmitterIsRefusedByName) {
  ShapeDescription lamp = rectangle(0, 0, 1);
  lamp.radiance = Rgbd{9, 9, 9};
  SceneDescription scene = floors({rectangle(0, 1), lamp});
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    scene.shapes[i].line = 10 * (i + 1);
    scene.shapes[i].label = "<shape type=\"rectangle\">";
  }
  scene.file = "scene.xml";
  try {
    make_scene(scene);
    FAIL() << "was taken";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "scene.xml:20: <shape type=\"rectangle\"> emits from the same place as <shape "
                 "type=\"rectangle\"> on line 10, which hides it: of two surfaces in one place the "
                 "first in the file counts. Put it first, or move it");
  }
  std::swap(scene.shapes[0], scene.shapes[1]);
  const double scalar = rendered(scene, Backend::scalar).film.mean().g;
  EXPECT_EQ(scalar, rendered(scene, Backend::batched).film.mean().g);
  // Where the camera looks there is nothing but the lamp and its floor.
  EXPECT_GT(scalar, rendered(floors({rectangle(0, 1)}), Backend::scalar).film.mean().g);
}

}  // namespace
}  // namespace plumbline::tests
