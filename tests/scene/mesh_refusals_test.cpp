#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <string>
#include <vector>

#include "refusal.h"
#include "scene_text.h"

/// Every way in which a mesh file is refused, with its line and its reason.
namespace plumbline::tests {
namespace {

class RefusedMesh : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedMesh, SaysWhereAndWhy) {
  const ScratchDirectory directory;
  directory.write("mesh.obj", GetParam().text);
  const auto file = directory.write("scene.xml", scene_with(R"(<shape type="obj">
      <string name="filename" value="mesh.obj"/>
      <boolean name="face_normals" value="true"/></shape>)"));
  EXPECT_EQ(refusal_of_file(file), GetParam().expected);
}

constexpr const char* kLoneReturn1 =
    R"(mesh.obj:1: a carriage return stands within a line: end lines with \n or \r\n)";
constexpr const char* kLoneReturn5 =
    R"(mesh.obj:5: a carriage return stands within a line: end lines with \n or \r\n)";

const std::vector<Refusal> kMeshes = {
    {"Empty", "", R"(scene.xml:4: <string name="filename">: mesh.obj: is empty)"},
    {"NoFaces", "v 0 0 0\n", "mesh.obj: holds no faces"},
    {"NoArea", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n",
     R"(scene.xml:4: <string name="filename">: mesh.obj has no triangle with an area)"},
    {"IndexOutOfRange", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
     "mesh.obj:4: vertex 4 does not exist: 3 stand above this face"},
    {"IndexZero", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
     "mesh.obj:4: vertex 0 does not exist: 3 stand above this face"},
    {"RelativeIndex", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n",
     "mesh.obj:4: vertex -3 does not exist: 3 stand above this face; count from 1 in place of back "
     "from it"},
    {"IndexBehindTheLineBreakOfOthers", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# comment\rf 1 2 9\n",
     kLoneReturn5},
    {"VertexBehindTheLineBreakOfOthers", "# a\rv 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
     kLoneReturn1},
    {"VertexBrokenByTheLineBreakOfOthers", "v\r1 1 2\nf 1 1 1\n", kLoneReturn1},
    {"LinesOfAnOldMac", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", kLoneReturn1},
    {"TwoReturns", "v 0 0 0\r\r\n", kLoneReturn1},
    {"LateVertex", "v 0 0 0\nf 1 2 3\nv 1 0 0\nv 0 1 0\n",
     "mesh.obj:2: vertex 2 does not exist: 1 stand above this face"},
    {"TextureCoordinateOutOfRange", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/2\n",
     "mesh.obj:5: texture coordinate 2 does not exist: 1 stand above this face"},
    {"NormalOutOfRange", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n",
     "mesh.obj:4: normal 1 does not exist: 0 stand above this face"},
    {"CornerOfFourIndices", "v 0 0 0\nvt 0 0\nvn 0 0 1\nf 1/1/1/1 1 1\n",
     R"(mesh.obj:4: "1/1/1/1" is not a vertex of a face: write v, v/vt, v//vn or v/vt/vn)"},
    {"CornerThatEndsInASlash", "v 0 0 0\nf 1/ 1 1\n",
     R"(mesh.obj:2: "1/" is not a vertex of a face: write v, v/vt, v//vn or v/vt/vn)"},
    {"EmptyFace", "v 0 0 0\nf\n", "mesh.obj:2: a face has 3 to 255 vertices, not 0"},
    {"HugeIndex", "v 0 0 0\nf 1 1 99999999999999999999\n",
     R"(mesh.obj:2: "99999999999999999999" is not a vertex of a face: write v, v/vt, v//vn or v/vt/vn)"},
    {"FaceOfTwo", "v 0 0 0\nv 1 0 0\nf 1 2\n", "mesh.obj:3: a face has 3 to 255 vertices, not 2"},
    {"VertexOfTwo", "v 0 0\n", "mesh.obj:1: a vertex needs three coordinates, not 2"},
    {"VertexNotANumber", "v 0 0 zero\n", R"(mesh.obj:1: "zero" is not a finite number)"},
    {"VertexNaN", "v 0 nan 0\n", R"(mesh.obj:1: "nan" is not a finite number)"},
    {"VertexInfinite", "v 0 1e999 0\n", R"(mesh.obj:1: "1e999" is not a finite number)"},
    {"VertexFarAway", "v 1e30 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
     R"(scene.xml:4: <string name="filename">: mesh.obj puts a coordinate beyond 1e+18)"},
    {"UnknownLine", "v 0 0 0\nt weights 2000000000/0/0\n",
     R"(mesh.obj:2: "t" is not supported in an obj file)"},
};

INSTANTIATE_TEST_SUITE_P(SceneFile, RefusedMesh, testing::ValuesIn(kMeshes), name_of);

}  // namespace
}  // namespace plumbline::tests
