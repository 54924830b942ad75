#include <gtest/gtest.h>

#include <variant>

#include "scene_text.h"

namespace plumbline::tests {
namespace {

using renderer::SphereShape;

constexpr const char* kSphere =
    R"(<default name="radius" value="2"/><default name="name" value="radius"/>
<shape type="sphere"><float name="$name" value="$radius"/></shape>)";

double radius_of(const renderer::SceneDescription& scene) {
  return std::get<SphereShape>(scene.shapes.at(0).geometry).radius;
}

TEST(Parameters, StandForTheirDefaultInAnyAttribute) {
  const auto scene = load_body(kSphere);
  EXPECT_EQ(radius_of(scene), 2);
  EXPECT_EQ(scene.parameters,
            (std::map<std::string, std::string>{{"name", "radius"}, {"radius", "2"}}));
}

TEST(Parameters, AreOverriddenAndRecorded) {
  const auto scene = load_body(kSphere, {{"radius", "7"}});
  EXPECT_EQ(radius_of(scene), 7);
  EXPECT_EQ(scene.parameters.at("radius"), "7");
}

TEST(Parameters, ArePutInAnywhereInTheText) {
  const auto scene = load_body(R"(<default name="a" value="1"/><default name="ab" value="5"/>
      <shape type="sphere"><point name="center" value="$a, 2$a, $ab"/></shape>)");
  const auto& sphere = std::get<SphereShape>(scene.shapes.at(0).geometry);
  EXPECT_EQ(sphere.center.x, 1);
  EXPECT_EQ(sphere.center.y, 21);
  EXPECT_EQ(sphere.center.z, 5);
}

TEST(Parameters, DefaultMayUseAnEarlierOne) {
  EXPECT_EQ(radius_of(load_body(R"(<default name="a" value="3"/><default name="b" value="$a"/>
      <shape type="sphere"><float name="radius" value="$b"/></shape>)",
                                {{"a", "4"}})),
            4);
}

TEST(Parameters, OverrideOfAnUnknownNameSaysWhichIsNear) {
  EXPECT_EQ(refusal_of_text(scene_with(kSphere), {{"raduis", "1"}}),
            R"(scene.xml: no parameter "raduis"; did you mean "radius"?)");
  EXPECT_EQ(refusal_of_text(scene_with(R"(<shape type="sphere"/>)"), {{"x", "1"}}),
            R"(scene.xml: has no <default> parameters, so "x" cannot be set)");
}

TEST(Parameters, OverrideThatChangesNothingIsRefused) {
  EXPECT_EQ(
      refusal_of_text(scene_with(R"(<default name="unused" value="1"/><shape type="sphere"/>)"),
                      {{"unused", "2"}}),
      R"(scene.xml: parameter "unused" is set, but nothing in the file uses it)");
}

TEST(Parameters, OverrideIsHeldToTheSameRulesAsTheFile) {
  EXPECT_EQ(refusal_of_text(scene_with(kSphere), {{"radius", "nan"}}),
            R"(scene.xml:4: <float name="radius">: "nan" is not finite)");
  EXPECT_EQ(refusal_of_text(scene_with(kSphere), {{"radius", "2\"/>"}}),
            R"(scene.xml:4: <float name="radius">: "2"/>" is not a number)");
  EXPECT_EQ(refusal_of_text(scene_with(kSphere), {{"radius", "$radius"}}),
            R"(scene.xml:4: <float name="radius">: "$radius" is not a number)");
}

}  // namespace
}  // namespace plumbline::tests
