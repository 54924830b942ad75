#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "refusal.h"
#include "scene_text.h"

/// Values outside the numeric domain that docs/scene_format.md states.
namespace plumbline::tests {
namespace {

class OutsideTheDomain : public testing::TestWithParam<Refusal> {};

TEST_P(OutsideTheDomain, SaysWhereAndWhy) {
  EXPECT_EQ(refusal_of_text(scene_with(GetParam().text)),
            std::string("scene.xml:") + GetParam().expected);
}

const std::vector<Refusal> kValues = {
    {"SphereBeyondItsDigits",
     "<shape type=\"sphere\"><point name=\"center\" x=\"1e3\"/>"
     "<float name=\"radius\" value=\"9e-9\"/></shape>",
     "3: <point name=\"center\">: is 1.1e+11 times its own size away from the origin: double "
     "precision keeps its shape up to 1e+11 times"},
    {"RectangleBeyondItsDigits",
     "<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"1e-6\"/>"
     "<translate z=\"2e5\"/></transform></shape>",
     "3: <transform name=\"to_world\">: is 2e+11 times its own size away from the origin: double "
     "precision keeps its shape up to 1e+11 times"},
    {"DiskBeyondItsDigits",
     "<shape type=\"disk\"><transform name=\"to_world\"><translate z=\"2e11\"/></transform>"
     "</shape>",
     "3: <transform name=\"to_world\">: is 2e+11 times its own size away from the origin: double "
     "precision keeps its shape up to 1e+11 times"},
    {"RadianceWhoseSquareOverflows",
     "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1.1e15\"/></emitter>",
     "3: <rgb name=\"radiance\">: must lie between 0 and 1e+15"},
    {"RadianceThatVanishes",
     "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1, 0, 9e-31\"/></emitter>",
     "3: <rgb name=\"radiance\">: is neither 0 nor at least 1e-30, and would be black in single "
     "precision"},
    {"LampThatVanishes",
     "<shape type=\"sphere\"><emitter type=\"area\"><rgb name=\"radiance\" value=\"1e-40\"/>"
     "</emitter></shape>",
     "3: <rgb name=\"radiance\">: is neither 0 nor at least 1e-30, and would be black in single "
     "precision"},
    {"IntensityThatVanishes",
     "<emitter type=\"point\"><rgb name=\"intensity\" value=\"1e-40\"/></emitter>",
     "3: <rgb name=\"intensity\">: is neither 0 nor at least 1e-30, and would be black in single "
     "precision"},
    {"SunThatVanishes",
     "<emitter type=\"sun\"><vector name=\"direction\" z=\"1\"/>"
     "<rgb name=\"radiance\" value=\"1e-40\"/></emitter>",
     "3: <rgb name=\"radiance\">: is neither 0 nor at least 1e-30, and would be black in single "
     "precision"}};

INSTANTIATE_TEST_SUITE_P(SceneFile, OutsideTheDomain, testing::ValuesIn(kValues), name_of);

TEST(Domain, PixelsMayBeAsNarrowAsDirectionsAreFine) {
  // 768 pixels: 2 tan(fov/2) / 768 is 2^-20 at 0.04197 degrees.
  const auto with_fov = [](const std::string& degrees) {
    std::string text = scene_with("<shape type=\"sphere\"/>");
    const std::string usual = "\"fov\" value=\"60\"";
    return text.replace(text.find(usual), usual.size(), "\"fov\" value=\"" + degrees + "\"");
  };
  EXPECT_EQ(refusal_of_text(with_fov("0.042")), "");
  EXPECT_EQ(
      refusal_of_text(with_fov("0.0419")),
      "scene.xml:2: <float name=\"fov\">: makes pixels 9.5e-07 radians wide: single precision "
      "tells directions apart down to 9.5e-07");
}

}  // namespace
}  // namespace plumbline::tests
