#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <numbers>
#include <string>

#include <plumbline/renderer/core/errors.h>

#include "scene_text.h"

namespace plumbline::tests {
namespace {

using renderer::CameraDescription;
using renderer::SceneDescription;
using renderer::Vec3d;

SceneDescription load_sensor(const std::string& properties, const std::string& film = "") {
  return load_text(R"(<scene version="3.0.0"><sensor type="perspective">)" + properties +
                   R"(<film type="hdrfilm"><rfilter type="box"/>)" + film +
                   R"(</film></sensor><emitter type="constant"><rgb name="radiance" value="1"/>)" +
                   "</emitter></scene>");
}

CameraDescription load_camera(const std::string& to_world) {
  return load_sensor(R"(<float name="fov" value="60"/><transform name="to_world">)" + to_world +
                     "</transform>")
      .camera;
}

TEST(Camera, LooksAlongItsOwnZWithXToTheLeft) {
  const CameraDescription camera = load_camera("");
  expect_near(camera.origin, {0, 0, 0});
  expect_near(camera.left, {1, 0, 0});
  expect_near(camera.up, {0, 1, 0});
  expect_near(camera.forward, {0, 0, 1});
}

TEST(Camera, LookatFromBehindTheOriginHasPlusXOnTheLeft) {
  // From z = −5 towards +z with y up, a right-handed world has +x on the left hand.
  const CameraDescription camera =
      load_camera(R"(<lookat origin="0, 0, -5" target="0, 0, 0" up="0, 1, 0"/>)");
  expect_near(camera.origin, {0, 0, -5});
  expect_near(camera.forward, {0, 0, 1});
  expect_near(camera.left, {1, 0, 0});
}

TEST(Camera, LookatFromTheFrontHasPlusXOnTheRight) {
  // From z = +5 towards −z with y up: the usual view of an x–y plot, +x on the right.
  const CameraDescription camera =
      load_camera(R"(<lookat origin="0, 0, 5" target="0, 0, 0" up="0, 1, 0"/>)");
  expect_near(camera.left, {-1, 0, 0});
  expect_near(camera.up, {0, 1, 0});
}

TEST(Camera, LookatStraightensUp) {
  // Looking along +x, up tilted forwards: the component along the view is dropped.
  const CameraDescription camera =
      load_camera(R"(<lookat origin="1 1 1" target="9 1 1" up="5 0 2"/>)");
  expect_near(camera.forward, {1, 0, 0});
  expect_near(camera.up, {0, 0, 1});
  expect_near(camera.left, {0, 1, 0});  // z × x
}

TEST(Camera, MatrixIsReadRowByRow) {
  const CameraDescription camera =
      load_camera(R"(<matrix value="0 0 1 7  0 1 0 8  -1 0 0 9  0 0 0 1"/>)");
  expect_near(camera.origin, {7, 8, 9});
  expect_near(camera.left, {0, 0, -1});  // first column
  expect_near(camera.up, {0, 1, 0});
  expect_near(camera.forward, {1, 0, 0});
}

TEST(Camera, SmallMatrixTurnsOnly) {
  const CameraDescription camera = load_camera(R"(<matrix value="0 0 1  0 1 0  -1 0 0"/>)");
  expect_near(camera.origin, {0, 0, 0});
  expect_near(camera.forward, {1, 0, 0});
}

TEST(Camera, MayBeMirrored) {
  const CameraDescription camera =
      load_camera(R"(<scale x="-1"/><lookat origin="0, 0, -5" target="0, 0, 0" up="0, 1, 0"/>)");
  expect_near(camera.left, {-1, 0, 0});
  expect_near(camera.forward, {0, 0, 1});
}

TEST(Camera, RotatesAboutAnyAxisByDegrees) {
  // A third of a turn about (1,1,1) maps x → y → z → x.
  const CameraDescription camera = load_camera(R"(<rotate value="1, 1, 1" angle="120"/>)");
  expect_near(camera.left, {0, 1, 0});
  expect_near(camera.up, {0, 0, 1});
  expect_near(camera.forward, {1, 0, 0});
}

double tangent_for(const std::string& axis, int width, int height) {
  return load_sensor(
             R"(<float name="fov" value="90"/><string name="fov_axis" value=")" + axis + R"("/>)",
             R"(<integer name="width" value=")" + std::to_string(width) +
                 R"("/><integer name="height" value=")" + std::to_string(height) + R"("/>)")
      .camera.tan_half_fov_x;
}

TEST(Camera, FieldOfViewIsAlongTheNamedAxis) {
  // 90° has tan(45°) = 1 along its axis; the other side follows the aspect 4:3.
  EXPECT_NEAR(tangent_for("x", 400, 300), 1, kRounding);
  EXPECT_NEAR(tangent_for("y", 400, 300), 4.0 / 3, kRounding);
  EXPECT_NEAR(tangent_for("smaller", 400, 300), 4.0 / 3, kRounding);
  EXPECT_NEAR(tangent_for("larger", 400, 300), 1, kRounding);
  EXPECT_NEAR(tangent_for("diagonal", 400, 300), 4.0 / 5, kRounding);
  // Upright, the roles change.
  EXPECT_NEAR(tangent_for("y", 300, 400), 3.0 / 4, kRounding);
  EXPECT_NEAR(tangent_for("smaller", 300, 400), 1, kRounding);
  EXPECT_NEAR(tangent_for("larger", 300, 400), 3.0 / 4, kRounding);
  EXPECT_NEAR(tangent_for("diagonal", 300, 400), 3.0 / 5, kRounding);
}

TEST(Camera, DefaultsAreMitsubas) {
  const SceneDescription scene = load_sensor(R"(<float name="fov" value="60"/>)");
  EXPECT_EQ(scene.camera.width, 768);
  EXPECT_EQ(scene.camera.height, 576);
  EXPECT_NEAR(scene.camera.tan_half_fov_x, std::tan(std::numbers::pi / 6), kRounding);
  EXPECT_EQ(scene.samples_per_pixel, 4);
  EXPECT_EQ(scene.integrator.max_depth, -1);
  EXPECT_EQ(scene.integrator.rr_depth, 5);
}

TEST(Camera, SizeGivenFromOutsideKeepsTheFieldOfViewAlongItsAxis) {
  const ScratchDirectory directory;
  const auto file = directory.write(
      "scene.xml",
      R"(<scene version="3.0.0"><sensor type="perspective"><float name="fov" value="90"/>
      <string name="fov_axis" value="y"/><film type="hdrfilm"><rfilter type="box"/></film></sensor>
      <shape type="sphere"/></scene>)");
  const auto camera = renderer::load_scene(file, {}, renderer::FilmSize{200, 100}).camera;
  EXPECT_EQ(camera.width, 200);
  EXPECT_EQ(camera.height, 100);
  EXPECT_NEAR(camera.tan_half_fov_x, 2, kRounding);
}

TEST(Camera, SizeGivenFromOutsideIsChecked) {
  const ScratchDirectory directory;
  const auto file = directory.write("scene.xml", scene_with(R"(<shape type="sphere"/>)"));
  EXPECT_THROW(renderer::load_scene(file, {}, renderer::FilmSize{0, 100}), renderer::InputError);
  EXPECT_THROW(renderer::load_scene(file, {}, renderer::FilmSize{1 << 16, 1 << 16}),
               renderer::InputError);
}

TEST(Integrator, PathTakesDepths) {
  const SceneDescription scene = load_body(R"(<integrator type="path">
      <integer name="max_depth" value="7"/><integer name="rr_depth" value="100"/></integrator>
      <shape type="sphere"/>)");
  EXPECT_EQ(scene.integrator.max_depth, 7);
  EXPECT_EQ(scene.integrator.rr_depth, 100);
}

TEST(Integrator, DirectIsDepthTwo) {
  EXPECT_EQ(load_body(R"(<integrator type="direct"/><shape type="sphere"/>)").integrator.max_depth,
            2);
}

TEST(Emitter, ConstantIsTheEnvironment) {
  const SceneDescription scene =
      load_body(R"(<emitter type="constant"><rgb name="radiance" value="1 2 3"/></emitter>)");
  ASSERT_TRUE(scene.environment.has_value());
  EXPECT_EQ(*scene.environment, (renderer::Rgbd{1, 2, 3}));
}

}  // namespace
}  // namespace plumbline::tests
