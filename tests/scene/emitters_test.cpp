#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/core/scene/scene.h>
#include <plumbline/renderer/image_io/exr.h>

#include "scene_text.h"

/// Emitters of every type: what is read, and what is refused and why.
namespace plumbline::tests {
namespace {

using renderer::Rgbd;
using renderer::Rgbf;
using renderer::SceneDescription;
using renderer::Vec3d;
using renderer::Vec3f;

SceneDescription load_emitters(const std::string& body) { return load_text(scene_with(body)); }

TEST(Emitter, PointsAreReadAsOftenAsTheyCome) {
  const SceneDescription scene = load_emitters(R"(<shape type="disk"/>
      <emitter type="point"><point name="position" x="1" z="3"/>
        <rgb name="intensity" value="1 2 3"/></emitter>
      <emitter type="point"><rgb name="intensity" value="5"/></emitter>)");
  ASSERT_EQ(scene.points.size(), 2u);
  EXPECT_EQ(scene.points[0].position.z, 3);
  EXPECT_EQ(scene.points[0].intensity, (Rgbd{1, 2, 3}));
  EXPECT_EQ(scene.points[1].position.x, 0);
  EXPECT_EQ(renderer::make_scene(scene).lights().size(), 2u);
}

TEST(Emitter, SunShinesAlongItsDirectionOnTopOfTheSky) {
  const SceneDescription scene = load_emitters(R"(<shape type="disk"/>
      <emitter type="sun"><vector name="direction" x="0" y="3" z="-4"/>
        <rgb name="radiance" value="1000"/></emitter>
      <emitter type="constant"><rgb name="radiance" value="1 2 3"/></emitter>)");
  ASSERT_TRUE(scene.sun);
  EXPECT_NEAR(scene.sun->direction.y, -0.6, 1e-15);
  EXPECT_NEAR(scene.sun->direction.z, 0.8, 1e-15);
  EXPECT_NEAR(scene.sun->half_angle, 0.2665 * renderer::pi<double>() / 180, 1e-15);
  const renderer::Scene built = renderer::make_scene(scene);
  ASSERT_EQ(built.lights().size(), 1u);
  const renderer::Light& light = built.lights()[built.environment()];
  EXPECT_EQ(radiance(light, Vec3f{0, -0.6f, 0.8f}), (Rgbf{1001, 1002, 1003}));
  EXPECT_EQ(radiance(light, Vec3f{0, 0.6f, 0.8f}), (Rgbf{1, 2, 3}));
}

/// 4 by 2 pixels, pixel (x, y) with the value x + 10 y.
void write_map(const std::filesystem::path& file, float last = 13) {
  renderer::Image image{4, 2, {}, {}, {}, {}};
  for (int i = 0; i < 8; ++i) {
    const auto value = static_cast<float>(i % 4 + 10 * (i / 4));
    image.pixels.push_back({value, value, value});
  }
  image.pixels.back() = {last, last, last};
  write_exr(file, image);
}

std::string envmap(const std::string& more = {}) {
  return scene_with(R"(<emitter type="envmap"><string name="filename" value="map.exr"/>)" + more +
                    "</emitter>");
}

TEST(Emitter, EnvironmentMapStandsAsInMitsuba) {
  const ScratchDirectory directory;
  write_map(directory.path() / "map.exr");
  const renderer::Scene scene = renderer::make_scene(renderer::load_scene(
      directory.write("scene.xml", envmap(R"(<float name="scale" value="2"/>)"))));
  const renderer::Light& light = scene.lights()[scene.environment()];
  // +y is up; the left edge of the image is −z, a quarter to the right of it +x.
  EXPECT_EQ(radiance(light, normalize(Vec3f{0.1f, 0.5f, -0.9f})).g, 0);
  EXPECT_EQ(radiance(light, normalize(Vec3f{0.9f, 0.5f, 0.1f})).g, 2);
  EXPECT_EQ(radiance(light, normalize(Vec3f{-0.1f, 0.5f, 0.9f})).g, 4);
  EXPECT_EQ(radiance(light, normalize(Vec3f{-0.9f, 0.5f, -0.1f})).g, 6);
  EXPECT_EQ(radiance(light, normalize(Vec3f{0.1f, -0.5f, -0.9f})).g, 20);
}

TEST(Emitter, EnvironmentMapTurnsWithItsTransform) {
  const ScratchDirectory directory;
  write_map(directory.path() / "map.exr");
  const renderer::Scene scene =
      renderer::make_scene(renderer::load_scene(directory.write("scene.xml", envmap(R"(
      <transform name="to_world"><rotate x="1" angle="90"/></transform>)"))));
  const renderer::Light& light = scene.lights()[scene.environment()];
  // The turn takes +y to +z and −z to +y.
  EXPECT_EQ(radiance(light, normalize(Vec3f{0.1f, 0.9f, 0.5f})).g, 0);
  EXPECT_EQ(radiance(light, normalize(Vec3f{0.1f, 0.9f, -0.5f})).g, 10);
}

TEST(Emitter, EnvironmentMapThatIsNoMapIsRefused) {
  const ScratchDirectory directory;
  const auto refusal = [&](const std::string& text) {
    return refusal_of_file(directory.write("scene.xml", text));
  };
  EXPECT_NE(refusal(envmap()).find("map.exr: no such image"), std::string::npos);
  write_map(directory.path() / "map.exr", -1);
  EXPECT_NE(refusal(envmap()).find("a pixel that, scaled, does not lie between 0 and 1e+15"),
            std::string::npos);
  write_map(directory.path() / "map.exr", std::numeric_limits<float>::quiet_NaN());
  EXPECT_NE(refusal(envmap()).find("a pixel that, scaled, does not lie between 0 and 1e+15"),
            std::string::npos);
  write_map(directory.path() / "map.exr");
  EXPECT_NE(refusal(envmap(R"(<float name="scale" value="-1"/>)")).find("must lie between"),
            std::string::npos);
  EXPECT_NE(refusal(envmap(R"(<transform name="to_world"><scale value="2"/></transform>)"))
                .find("not scaled or sheared"),
            std::string::npos);
  const std::string sky =
      R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter></scene>)";
  std::string both = envmap();
  both.replace(both.find("</scene>"), 8, sky);
  EXPECT_NE(refusal(both).find("no constant and no sun beside it"), std::string::npos);
}

TEST(Emitter, ATwoSidedRectangleEmitsFromBothSidesAndOthersFromTheFront) {
  const auto with = [](const std::string& shape, const std::string& two_sided) {
    return scene_with("<shape type=\"" + shape + R"("><emitter type="area">
      <rgb name="radiance" value="1"/><boolean name="two_sided" value=")" +
                      two_sided + "\"/></emitter></shape>");
  };
  const renderer::Ray down{{0, 0, 5}, {0, 0, -1}}, up{{0, 0, -5}, {0, 0, 1}};
  const renderer::Scene both = renderer::make_scene(load_text(with("rectangle", "true")));
  EXPECT_EQ(both.intersect(down).value().light, 0u);
  EXPECT_EQ(both.intersect(up).value().light, 0u);
  const renderer::Scene front = renderer::make_scene(load_text(with("rectangle", "false")));
  EXPECT_EQ(front.intersect(down).value().light, 0u);
  EXPECT_EQ(front.intersect(up).value().light, renderer::kNoLight);
  EXPECT_NE(refusal_of_text(with("disk", "true")).find("only a rectangle can emit from both"),
            std::string::npos);
}

TEST(Emitter, SamplingBySolidAngleIsForRectanglesAndMeshes) {
  const auto with = [](const std::string& shape, const std::string& sampling) {
    return scene_with("<shape type=\"" + shape + R"("><emitter type="area">
      <rgb name="radiance" value="1"/><string name="sampling" value=")" +
                      sampling + "\"/></emitter></shape>");
  };
  const renderer::Scene scene = renderer::make_scene(load_text(with("rectangle", "solid_angle")));
  EXPECT_TRUE(std::get<renderer::RectangleLight>(scene.lights()[0]).by_solid_angle);
  const renderer::Scene by_area = renderer::make_scene(load_text(with("rectangle", "area")));
  EXPECT_FALSE(std::get<renderer::RectangleLight>(by_area.lights()[0]).by_solid_angle);
  EXPECT_NE(refusal_of_text(with("disk", "solid_angle")).find("only a rectangle or an obj"),
            std::string::npos);
  EXPECT_NE(refusal_of_text(with("disk", "angle")).find("supported: area, solid_angle"),
            std::string::npos);
}

TEST(Emitter, TrianglesOfAMeshAreChosenByAreaAndTheMeshLikeAnyOtherLight) {
  const ScratchDirectory directory;
  directory.write("mesh.obj", "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 0 1 0\nv 0 3 0\nf 1 2 4\nf 4 3 5\n");
  const auto description = renderer::load_scene(directory.write("scene.xml", scene_with(R"(
      <shape type="obj"><string name="filename" value="mesh.obj"/>
        <boolean name="face_normals" value="true"/>
        <emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>
      <shape type="sphere"><emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>
      )")));
  const auto pmf = [&](renderer::LightSelection selection, std::uint32_t light) {
    SceneDescription scene = description;
    scene.light_selection = selection;
    return static_cast<double>(renderer::make_scene(scene).lights().pmf<float>(light));
  };
  using renderer::LightSelection;
  // Areas 3/2, 3 and 4π.
  EXPECT_NEAR(pmf(LightSelection::uniform, 0), 1.0 / 6, 1e-6);
  EXPECT_NEAR(pmf(LightSelection::uniform, 1), 1.0 / 3, 1e-6);
  EXPECT_NEAR(pmf(LightSelection::uniform, 2), 1.0 / 2, 1e-6);
  const double total = 4.5 + 4 * renderer::pi<double>();
  EXPECT_NEAR(pmf(LightSelection::area, 0), 1.5 / total, 1e-6);
  EXPECT_NEAR(pmf(LightSelection::power, 2), 4 * renderer::pi<double>() / total, 1e-6);
}

}  // namespace
}  // namespace plumbline::tests
