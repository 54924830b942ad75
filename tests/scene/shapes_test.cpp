#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <variant>

#include "scene_text.h"

namespace plumbline::tests {
namespace {

using renderer::DiskShape;
using renderer::MeshShape;
using renderer::RectangleShape;
using renderer::Rgbd;
using renderer::SceneDescription;
using renderer::SphereShape;
using renderer::Vec3d;

template <class Shape>
Shape only_shape(const SceneDescription& scene) {
  EXPECT_EQ(scene.shapes.size(), 1u);
  return std::get<Shape>(scene.shapes.at(0).geometry);
}

/// Front side of a rectangle: along edge_u × edge_v, or against it.
Vec3d front_of(const RectangleShape& r) {
  const Vec3d normal = normalize(cross(r.edge_u, r.edge_v));
  return r.flip_normals ? -normal : normal;
}

TEST(Sphere, IsTheUnitSphereUnlessSaidOtherwise) {
  const auto sphere = only_shape<SphereShape>(load_body(R"(<shape type="sphere"/>)"));
  expect_near(sphere.center, {0, 0, 0});
  EXPECT_EQ(sphere.radius, 1);
  EXPECT_FALSE(sphere.flip_normals);
}

TEST(Sphere, TransformActsOnCenterAndRadius) {
  // First twice as large about the origin, then one up: (1,2,3) → (2,4,6) → (2,4,7), radius 1.
  const auto sphere = only_shape<SphereShape>(load_body(R"(<shape type="sphere">
      <point name="center" x="1" y="2" z="3"/><float name="radius" value="0.5"/>
      <boolean name="flip_normals" value="true"/>
      <transform name="to_world"><scale value="2"/><translate z="1"/></transform></shape>)"));
  expect_near(sphere.center, {2, 4, 7});
  EXPECT_NEAR(sphere.radius, 1, kRounding);
  EXPECT_TRUE(sphere.flip_normals);
}

TEST(Sphere, MirroringKeepsNormalsOutward) {
  const auto sphere = only_shape<SphereShape>(load_body(
      R"(<shape type="sphere"><transform name="to_world"><scale x="-1"/></transform></shape>)"));
  EXPECT_FALSE(sphere.flip_normals);
}

TEST(Rectangle, SpansMinusOneToOneAndFacesZ) {
  const auto rectangle = only_shape<RectangleShape>(load_body(R"(<shape type="rectangle"/>)"));
  expect_near(rectangle.origin, {-1, -1, 0});
  expect_near(rectangle.edge_u, {2, 0, 0});
  expect_near(rectangle.edge_v, {0, 2, 0});
  expect_near(front_of(rectangle), {0, 0, 1});
}

TEST(Rectangle, TurnsRightHandedAboutAnAxisThenMoves) {
  // +90° about x: y → z, z → −y. Then 5 along x. The corner (−1,−1,0) → (−1,0,−1) → (4,0,−1).
  const auto rectangle = only_shape<RectangleShape>(load_body(R"(<shape type="rectangle">
      <transform name="to_world"><rotate x="1" angle="90"/><translate x="5"/></transform></shape>)"));
  expect_near(rectangle.origin, {4, 0, -1});
  expect_near(rectangle.edge_u, {2, 0, 0});
  expect_near(rectangle.edge_v, {0, 0, 2});
  expect_near(front_of(rectangle), {0, -1, 0});
}

TEST(Rectangle, OrderOfOperationsIsTheFilesOrder) {
  // Moved first, it is carried around: the centre (5,0,0) turns by +90° about z to (0,5,0).
  const auto rectangle = only_shape<RectangleShape>(load_body(R"(<shape type="rectangle">
      <transform name="to_world"><translate x="5"/><rotate z="1" angle="90"/></transform></shape>)"));
  expect_near(rectangle.origin + rectangle.edge_u * 0.5 + rectangle.edge_v * 0.5, {0, 5, 0});
}

TEST(Rectangle, FlipNormalsTurnsTheFront) {
  const auto rectangle = only_shape<RectangleShape>(
      load_body(R"(<shape type="rectangle"><boolean name="flip_normals" value="true"/></shape>)"));
  expect_near(front_of(rectangle), {0, 0, -1});
}

TEST(Rectangle, MirroringInItsPlaneKeepsTheFront) {
  // Normals map by the inverse transpose: diag(−1,1,1) keeps (0,0,1), though the winding reverses.
  const auto rectangle = only_shape<RectangleShape>(load_body(R"(<shape type="rectangle">
      <transform name="to_world"><scale x="-1"/></transform></shape>)"));
  expect_near(front_of(rectangle), {0, 0, 1});
}

TEST(Rectangle, MirroringAcrossItsPlaneTurnsTheFront) {
  const auto rectangle = only_shape<RectangleShape>(load_body(R"(<shape type="rectangle">
      <transform name="to_world"><scale z="-3"/></transform></shape>)"));
  expect_near(front_of(rectangle), {0, 0, -1});
}

TEST(Rectangle, TakesDifferentScalesAlongItsEdges) {
  const auto rectangle = only_shape<RectangleShape>(load_body(R"(<shape type="rectangle">
      <transform name="to_world"><scale x="2" y="0.25"/></transform></shape>)"));
  expect_near(rectangle.edge_u, {4, 0, 0});
  expect_near(rectangle.edge_v, {0, 0.5, 0});
}

TEST(Disk, IsTheUnitDiskFacingZ) {
  const auto disk = only_shape<DiskShape>(load_body(R"(<shape type="disk"/>)"));
  expect_near(disk.center, {0, 0, 0});
  expect_near(disk.normal, {0, 0, 1});
  EXPECT_EQ(disk.radius, 1);
}

TEST(Disk, ScalesTurnsAndMoves) {
  // +90° about y: z → x.
  const auto disk = only_shape<DiskShape>(load_body(R"(<shape type="disk">
      <transform name="to_world"><scale value="3"/><rotate y="1" angle="90"/>
      <translate x="1" y="2" z="3"/></transform></shape>)"));
  expect_near(disk.center, {1, 2, 3});
  expect_near(disk.normal, {1, 0, 0});
  EXPECT_NEAR(disk.radius, 3, kRounding);
}

TEST(Disk, MayBeOutOfRoundByWhatRoundingMakes) {
  // By 5e-6 of its size, whatever that is: half of what is refused.
  for (const char* scale : {"x=\"100\" y=\"100.0005\"", "x=\"1e-3\" y=\"1.000005e-3\""}) {
    const auto disk = only_shape<DiskShape>(
        load_body(std::string(R"(<shape type="disk"><transform name="to_world"><scale )") + scale +
                  "/></transform></shape>"));
    expect_near(disk.normal, {0, 0, 1});
  }
}

TEST(Disk, FlipAndMirrorFollowTheRectangle) {
  const char* flipped = R"(<shape type="disk"><boolean name="flip_normals" value="true"/></shape>)";
  expect_near(only_shape<DiskShape>(load_body(flipped)).normal, {0, 0, -1});
  const char* in_plane =
      R"(<shape type="disk"><transform name="to_world"><scale x="-1"/></transform></shape>)";
  expect_near(only_shape<DiskShape>(load_body(in_plane)).normal, {0, 0, 1});
  const char* across =
      R"(<shape type="disk"><transform name="to_world"><scale z="-1"/></transform></shape>)";
  expect_near(only_shape<DiskShape>(load_body(across)).normal, {0, 0, -1});
}

SceneDescription load_with_obj(const std::string& obj, const std::string& properties = "") {
  const ScratchDirectory directory;
  directory.write("mesh.obj", obj);
  return renderer::load_scene(directory.write("scene.xml", scene_with(R"(<shape type="obj">
          <string name="filename" value="mesh.obj"/>
          <boolean name="face_normals" value="true"/>)" + properties + "</shape>")));
}

constexpr const char* kQuad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

TEST(Obj, QuadBecomesTwoTrianglesAroundItsFirstVertex) {
  const auto mesh = only_shape<MeshShape>(load_with_obj(kQuad));
  ASSERT_EQ(mesh.vertices.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
  EXPECT_FALSE(mesh.flip_normals);
}

TEST(Obj, VerticesAreMovedInDouble) {
  const auto mesh = only_shape<MeshShape>(
      load_with_obj("v 0.1 0.2 0.3\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                    R"(<transform name="to_world"><translate x="100000"/></transform>)"));
  // Read as float, 0.1 would be off by 1.5e-9; added in float, by up to 4e-3.
  EXPECT_NEAR(mesh.vertices[0].x, 100000.1, 1e-10);
  EXPECT_NEAR(mesh.vertices[0].y, 0.2, 1e-15);
}

TEST(Obj, CoordinatesAreTheDoublesNearestToTheText) {
  const auto mesh = only_shape<MeshShape>(
      load_with_obj("v 0.1 12345.678901234567 -2.2250738585072014e-308\nv 1e-7 3.5E2 0\n"
                    "v 0 1 .5\nf 1 2 3\n"));
  EXPECT_EQ(mesh.vertices[0].x, 0.1);
  EXPECT_EQ(mesh.vertices[0].y, 12345.678901234567);
  EXPECT_EQ(mesh.vertices[0].z, -2.2250738585072014e-308);
  EXPECT_EQ(mesh.vertices[1].x, 1e-7);
  EXPECT_EQ(mesh.vertices[1].y, 350);
  EXPECT_EQ(mesh.vertices[2].z, 0.5);
}

TEST(Obj, FacesOfGroupsThatComeBackKeepTheFilesOrder) {
  const auto mesh = only_shape<MeshShape>(load_with_obj(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\ng a\nf 1 2 3\nv 0 0 1\ng b\nf 1 2 4\ng a\nf 1 3 4"));
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 1, 3}));
  EXPECT_EQ(mesh.triangles[2], (std::array<std::uint32_t, 3>{0, 2, 3}));
}

TEST(Obj, FlipNormalsIsPassedOn) {
  EXPECT_TRUE(
      only_shape<MeshShape>(load_with_obj(kQuad, R"(<boolean name="flip_normals" value="true"/>)"))
          .flip_normals);
}

TEST(Obj, GroupsMaterialsNormalsAndTextureCoordinatesAreReadOver) {
  const auto mesh = only_shape<MeshShape>(load_with_obj(
      "# a comment\nmtllib x.mtl\no one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n"
      "vt 0 0\ng a\nusemtl m\ns off\nf 1/1/1 2/1/1 3/1/1\r\ng b\nf 3//1 2//1 1//1\n"));
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(Obj, TrianglesWithoutAreaAreLeftOut) {
  const auto mesh = only_shape<MeshShape>(
      load_with_obj("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 1 1 4\n"));
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 3}));
}

TEST(Shape, EmitsAndKeepsItsBsdf) {
  const SceneDescription scene = load_body(R"(<shape type="sphere">
      <bsdf type="diffuse"><rgb name="reflectance" value="0.1, 0.2,0.3"/></bsdf>
      <emitter type="area"><rgb name="radiance" value="4 5 6"/></emitter></shape>)");
  ASSERT_TRUE(scene.shapes[0].radiance.has_value());
  EXPECT_EQ(*scene.shapes[0].radiance, (Rgbd{4, 5, 6}));
  const auto& bsdf = std::get<renderer::Lambertian>(bsdf_of(scene, scene.shapes[0].bsdf));
  EXPECT_EQ(bsdf.albedo, (renderer::Rgbf{0.1f, 0.2f, 0.3f}));
}

TEST(Shape, WithoutBsdfIsHalfGrey) {
  const SceneDescription scene = load_body(R"(<shape type="sphere"/><shape type="disk"/>)");
  EXPECT_EQ(scene.bsdfs->size(), 1u);
  const auto& bsdf = std::get<renderer::Lambertian>(bsdf_of(scene, scene.shapes[1].bsdf));
  EXPECT_EQ(bsdf.albedo, (renderer::Rgbf{0.5f, 0.5f, 0.5f}));
}

TEST(Shape, ReferenceMayStandBeforeOrAfterTheBsdf) {
  const SceneDescription scene = load_body(R"(<shape type="sphere"><ref id="red"/></shape>
      <bsdf type="diffuse" id="red"><rgb name="reflectance" value="1 0 0"/></bsdf>
      <shape type="disk"><ref id="red"/></shape>)");
  EXPECT_EQ(scene.shapes[0].bsdf, scene.shapes[1].bsdf);
  const auto& bsdf = std::get<renderer::Lambertian>(bsdf_of(scene, scene.shapes[0].bsdf));
  EXPECT_EQ(bsdf.albedo, (renderer::Rgbf{1, 0, 0}));
}

TEST(Shape, MayReferToTheBsdfOfAnother) {
  const SceneDescription scene = load_body(R"(<shape type="sphere">
      <bsdf type="diffuse" id="grey"/></shape><shape type="disk"><ref id="grey"/></shape>)");
  EXPECT_EQ(scene.shapes[0].bsdf, scene.shapes[1].bsdf);
}

}  // namespace
}  // namespace plumbline::tests
