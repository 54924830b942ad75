#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "refusal.h"
#include "scene_text.h"

/// Shapes that a transform puts, or makes, beyond what the renderer's floats hold.
namespace plumbline::tests {
namespace {

class RefusedShape : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedShape, SaysWhereAndWhy) {
  EXPECT_EQ(refusal_of_text(scene_with(GetParam().text)),
            std::string("scene.xml:") + GetParam().expected);
}

const std::vector<Refusal> kShapes = {
    {"MinuteRectangle",
     "<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"1e-19\"/></transform>"
     "</shape>",
     R"(3: <transform name="to_world">: makes a length of 2e-19: lengths go from 1e-18 to 1e+18)"},
    {"RectangleOfHugeHeight",
     "<shape type=\"rectangle\"><transform name=\"to_world\"><scale y=\"0.6e18\"/></transform>"
     "</shape>",
     R"(3: <transform name="to_world">: makes a length of 1.2e+18: lengths go from 1e-18 to 1e+18)"},
    {"RectangleWithACornerFarAway",
     "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.2e18\"/>"
     "<translate x=\"-0.85e18\"/></transform></shape>",
     R"(3: <transform name="to_world">: puts a coordinate beyond 1e+18)"},
    {"RectangleWithTheOtherCornerFarAway",
     "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.2e18\"/>"
     "<translate y=\"0.85e18\"/></transform></shape>",
     R"(3: <transform name="to_world">: puts a coordinate beyond 1e+18)"},
    {"MinuteDisk",
     "<shape type=\"disk\"><transform name=\"to_world\"><scale value=\"1e-19\"/></transform>"
     "</shape>",
     R"(3: <transform name="to_world">: makes a length of 1e-19: lengths go from 1e-18 to 1e+18)"},
    {"DiskFarAway",
     "<shape type=\"disk\"><transform name=\"to_world\"><translate z=\"2e18\"/></transform>"
     "</shape>",
     R"(3: <transform name="to_world">: puts a coordinate beyond 1e+18)"},
    {"LargeDiskThatIsNotQuiteRound",
     "<shape type=\"disk\"><transform name=\"to_world\"><scale x=\"100\" y=\"100.002\"/>"
     "</transform></shape>",
     R"(3: <transform name="to_world">: would make an ellipse: scale a disk alike along x and y)"}};

INSTANTIATE_TEST_SUITE_P(SceneFile, RefusedShape, testing::ValuesIn(kShapes), name_of);

}  // namespace
}  // namespace plumbline::tests
