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
     "mesh.obj:4: vertex -3 does not exist: 3 stand above this face"},
    {"HugeIndex", "v 0 0 0\nf 1 1 99999999999999999999\n",
     R"(mesh.obj:2: "99999999999999999999" is not a vertex of a face)"},
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
