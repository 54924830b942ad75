#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <string>
#include <vector>

#include <plumbline/renderer/image_io/budgets.h>

#include "scene_text.h"

/// Scenes in the style of those that people publish for Mitsuba: what is without effect here is
/// taken, the rest is refused with what to write, and `check_scene` says all of it at once.
namespace plumbline::tests {
namespace {

using renderer::SceneDescription;

constexpr const char* kFilm = R"(<film type="hdrfilm"><rfilter type="box"/></film>)";

/// A scene whose sensor holds that beside its field of view and film.
std::string scene_of(const std::string& sensor, const std::string& body,
                     const std::string& film = kFilm) {
  return "<scene version=\"3.0.0\">\n<sensor type=\"perspective\"><float name=\"fov\" "
         "value=\"60\"/>" +
         film + "\n" + sensor + "</sensor>\n" + body + "</scene>";
}

/// A room of two by two by two around the camera, which looks along +z at a lamp.
const std::string kRoom = R"(<shape type="rectangle"><transform name="to_world">
    <translate z="-1"/></transform></shape>
    <shape type="rectangle"><transform name="to_world"><rotate y="1" angle="180"/>
    <translate z="1"/></transform></shape>
    <shape type="rectangle"><transform name="to_world"><rotate x="1" angle="90"/>
    <translate y="1"/></transform></shape>
    <shape type="disk"><transform name="to_world"><rotate x="1" angle="180"/><scale value="0.2"/>
    <translate z="0.9"/></transform><emitter type="area"><rgb name="radiance" value="1"/></emitter>
    </shape>)";

TEST(PublicScene, OfVersionTwoIsReadAsThree) {
  std::string text = scene_of("", R"(<shape type="sphere"/>)");
  text.replace(text.find("3.0.0"), 5, "2.1.0");
  EXPECT_EQ(refusal_of_text(text), "");
}

TEST(PublicScene, OfVersionZeroIsRefusedWithTheNewNames) {
  std::string text = scene_of("", R"(<shape type="sphere"/>)");
  text.replace(text.find("3.0.0"), 5, "0.5.0");
  const std::string refusal = refusal_of_text(text);
  EXPECT_EQ(refusal.find("scene.xml:1: scene version \"0.5.0\" is not supported: write 3.0.0"), 0u);
  for (const char* name : {"to_world for toWorld", "max_depth", "lookat for lookAt"}) {
    EXPECT_NE(refusal.find(name), std::string::npos) << refusal;
  }
}

TEST(PublicScene, ClippingPlanesThatClipNothingAreTaken) {
  const SceneDescription scene = load_text(
      scene_of(R"(<float name="near_clip" value="0.1"/><float name="far_clip" value="100"/>
      <float name="focus_distance" value="3"/>)",
               kRoom));
  EXPECT_EQ(scene.shapes.size(), 4u);
}

TEST(PublicScene, ANearPlaneThatMayCutIsRefusedWithTheLargestThatDoesNot) {
  // At 60° and 4:3 a corner of the image is √(1 + (1 + 9/16)/3) = 1.233 times as far as its centre:
  // of the disk at 0.9 at most 0.9/1.233 may be cut off.
  EXPECT_EQ(refusal_of_text(scene_of("<float name=\"near_clip\" value=\"0.75\"/>", kRoom)),
            "scene.xml:3: <float name=\"near_clip\">: may cut off shapes, and nothing is clipped "
            "here: write at most 0.7291");
  EXPECT_EQ(refusal_of_text(scene_of("<float name=\"near_clip\" value=\"0.7291\"/>", kRoom)), "");
}

TEST(PublicScene, AFarPlaneThatCutsIsRefusedWithTheSmallestThatDoesNot) {
  EXPECT_EQ(refusal_of_text(scene_of("<float name=\"far_clip\" value=\"0.99\"/>", kRoom)),
            "scene.xml:3: <float name=\"far_clip\">: cuts off shapes, and nothing is clipped here: "
            "write at least 1.001");
  EXPECT_EQ(refusal_of_text(scene_of("<float name=\"far_clip\" value=\"1.001\"/>", kRoom)), "");
}

TEST(PublicScene, ClippingIsJudgedForEveryShape) {
  const ScratchDirectory directory;
  directory.write("mesh.obj", "v -1 -1 4\nv 1 -1 4\nv 0 1 5\nf 1 2 3\n");
  const std::string mesh = R"(<shape type="obj"><string name="filename" value="mesh.obj"/>
      <boolean name="face_normals" value="true"/></shape>)";
  const std::string sphere = R"(<shape type="sphere"><point name="center" z="7"/></shape>)";
  const std::string around = R"(<shape type="sphere"><float name="radius" value="2"/>
      <boolean name="flip_normals" value="true"/></shape>)";
  struct Case {
    std::string shapes, near, far;
    bool taken;
  };
  for (const Case& c :
       {Case{mesh, "3", "5", true}, Case{mesh, "4", "5", false}, Case{mesh, "3", "4.9", false},
        Case{sphere, "4.8", "8", true}, Case{sphere, "5", "8", false},
        Case{sphere, "4", "7.9", false}, Case{around, "1.6", "2", true},
        Case{around, "1.7", "2", false}, Case{around, "1", "1.9", false}}) {
    const auto file = directory.write(
        "scene.xml", scene_of("<float name=\"near_clip\" value=\"" + c.near +
                                  "\"/><float name=\"far_clip\" value=\"" + c.far + "\"/>",
                              c.shapes));
    EXPECT_EQ(refusal_of_file(file).empty(), c.taken) << c.near << " " << c.far << " " << c.shapes;
  }
}

TEST(PublicScene, FilmsOfOpenExrAreTaken) {
  const auto with = [](const std::string& format) {
    return refusal_of_text(scene_of("", R"(<shape type="sphere"/>)",
                                    "<film type=\"hdrfilm\"><string name=\"file_format\" value=\"" +
                                        format + "\"/><rfilter type=\"box\"/></film>"));
  };
  EXPECT_EQ(with("openexr"), "");
  EXPECT_EQ(with("pfm"),
            "scene.xml:2: <string name=\"file_format\">: \"pfm\" is not supported; supported: "
            "openexr");
}

TEST(PublicScene, ASpectrumOfOneConstantIsGrey) {
  const SceneDescription scene = load_body(R"(<shape type="sphere"><bsdf type="diffuse">
      <spectrum name="reflectance" value="0.25"/></bsdf><emitter type="area">
      <spectrum name="radiance" value="3"/></emitter></shape>)");
  EXPECT_EQ(*scene.shapes[0].radiance, (renderer::Rgbd{3, 3, 3}));
  const auto& bsdf = std::get<renderer::Lambertian>(bsdf_of(scene, scene.shapes[0].bsdf));
  EXPECT_EQ(bsdf.albedo, (renderer::Rgbf{0.25f, 0.25f, 0.25f}));
  for (const char* value : {"400:0.1, 700:0.2", "0.1 0.2 0.3"}) {
    EXPECT_EQ(refusal_of_text(scene_with(
                  std::string("<emitter type=\"constant\"><spectrum name=\"radiance\" value=\"") +
                  value + "\"/></emitter>")),
              "scene.xml:3: <spectrum name=\"radiance\">: only one number, which is grey, is "
              "supported: write <rgb> with the linear colour");
  }
}

TEST(PublicScene, MayIncludeFilesWhoseParametersAndIdsItShares) {
  const ScratchDirectory directory;
  std::filesystem::create_directories(directory / "parts/meshes");
  directory.write("parts/materials.xml",
                  R"(<scene version="3.0.0"><bsdf type="diffuse" id="grey">
      <rgb name="reflectance" value="$albedo"/></bsdf><default name="size" value="2"/></scene>)");
  directory.write("parts/meshes/mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto file = directory.write("scene.xml", scene_with(R"(<path value="parts"/>
      <path value="meshes"/><default name="albedo" value="0.125"/>
      <include filename="materials.xml"/>
      <shape type="sphere"><float name="radius" value="$size"/><ref id="grey"/></shape>
      <shape type="obj"><string name="filename" value="mesh.obj"/>
      <boolean name="face_normals" value="true"/></shape>)"));
  const SceneDescription scene = renderer::load_scene(file);
  EXPECT_EQ(std::get<renderer::SphereShape>(scene.shapes[0].geometry).radius, 2);
  const auto& bsdf = std::get<renderer::Lambertian>(bsdf_of(scene, scene.shapes[0].bsdf));
  EXPECT_EQ(bsdf.albedo.r, 0.125f);
  EXPECT_EQ(scene.shapes.size(), 2u);
}

/// What is said of a scene that includes a file with that text.
std::string refusal_of_included(const std::string& text) {
  const ScratchDirectory directory;
  directory.write("part.xml", text);
  return refusal_of_file(
      directory.write("scene.xml", scene_with("<include filename=\"part.xml\"/>")));
}

TEST(PublicScene, WhatIsWrongInAnIncludedFileIsSaidWhereItStands) {
  EXPECT_EQ(refusal_of_included("<scene version=\"3.0.0\">\n\n<shape type=\"sphear\"/></scene>"),
            "part.xml:3: <shape> of type \"sphear\" is not supported; did you mean \"sphere\"?");
  EXPECT_EQ(refusal_of_included("<scene version=\"3.0.0\">\n<shape type=\"sphere\"><ref id=\"a\"/>"
                                "</shape></scene>"),
            "part.xml:2: no <bsdf> has the id \"a\"");
  EXPECT_EQ(refusal_of_included("<scene version=\"3.0.0\">\n<shape"),
            "scene.xml:3: <include>: part.xml:2: is not well-formed XML: Error parsing start "
            "element tag");
  EXPECT_EQ(refusal_of_included("<bsdf type=\"diffuse\" id=\"a\"/>"),
            "part.xml:1: the outermost element is <bsdf>, not <scene>");
  EXPECT_EQ(
      refusal_of_included("<scene version=\"3.0.0\">\n<sensor type=\"perspective\"/></scene>"),
      "part.xml:2: a scene has one <sensor> only");
}

TEST(PublicScene, IncludingInCirclesIsRefused) {
  EXPECT_EQ(
      refusal_of_included("<scene version=\"3.0.0\">\n<include filename=\"part.xml\"/></scene>"),
      "part.xml:2: <include>: part.xml includes itself");
  EXPECT_EQ(
      refusal_of_included("<scene version=\"3.0.0\">\n<include filename=\"scene.xml\"/></scene>"),
      "part.xml:2: <include>: scene.xml includes itself");
  EXPECT_EQ(refusal_of_text(scene_with("<include filename=\"no.xml\"/>")),
            "scene.xml:3: <include>: no.xml: there is no such file");
  EXPECT_EQ(refusal_of_text(scene_with("<path value=\"no\"/>")),
            "scene.xml:3: <path>: no is not a folder");
}

TEST(PublicScene, IncludingMuchIsRefused) {
  // Each includes the next one twice: 2^20 files, if none of them were refused.
  const ScratchDirectory directory;
  for (int i = 1; i < 20; ++i) {
    const std::string next = "<include filename=\"" + std::to_string(i + 1) + ".xml\"/>";
    directory.write(std::to_string(i) + ".xml",
                    "<scene version=\"3.0.0\">" + next + next + "</scene>");
  }
  const std::string why = "more than 256 files, or 8 within each other, are included";
  EXPECT_NE(
      refusal_of_file(directory.write("scene.xml", scene_with("<include filename=\"1.xml\"/>")))
          .find(why),
      std::string::npos);
  directory.write("leaf.xml", "<scene version=\"3.0.0\"/>");
  std::string body;
  for (std::size_t i = 0; i <= renderer::kMaxIncludes; ++i)
    body += "<include filename=\"leaf.xml\"/>\n";
  EXPECT_NE(refusal_of_file(directory.write("scene.xml", scene_with(body))).find(why),
            std::string::npos);
}

/// Something that scenes hold, and what to write in its place.
struct Foreign {
  const char* body;
  const char* advice;
};

TEST(PublicScene, EveryRefusalSaysWhatToWrite) {
  const std::vector<Foreign> cases = {
      {R"(<shape type="ply"><string name="filename" value="a.ply"/></shape>)",
       "convert the mesh to an obj file"},
      {R"(<shape type="cube"/>)", "write six rectangles, or an obj file"},
      {R"(<shape type="shapegroup" id="g"/>)", "write the shape itself, once for each place"},
      {R"(<shape type="sphere"><bsdf type="plastic"/></shape>)", "write clearcoat, or diffuse"},
      {R"(<shape type="sphere"><bsdf type="thindielectric"/></shape>)", "write dielectric"},
      {R"(<bsdf type="bumpmap" id="b"/>)", "write the <bsdf> in it alone"},
      {R"(<bsdf type="roughconductor" id="b"><string name="distribution" value="beckmann"/></bsdf>)",
       "write ggx, whose tails are longer"},
      {R"(<bsdf type="roughconductor" id="b"/>)",
       "needs <string name=\"distribution\" value=\"ggx\">"},
      {R"(<bsdf type="dielectric" id="b"><rgb name="specular_transmittance" value="1"/></bsdf>)",
       "remove it"},
      {R"(<bsdf type="diffuse" id="b"><texture type="bitmap" name="reflectance"/></bsdf>)",
       "must be a <rgb> or <spectrum>: write <rgb> with the texture's mean colour"},
      {R"(<bsdf type="diffuse" id="b"><rgb name="reflectance" value="#ff8000"/></bsdf>)",
       "write linear ones"},
      {R"(<emitter type="directional"/>)", "write sun, which has a direction"},
      {R"(<integrator type="volpath"/>)", "write path"},
      {R"(<integrator type="path"><boolean name="hide_emitters" value="true"/></integrator>)",
       "remove it"},
      {R"(<shape type="obj"><string name="filename" value="a.obj"/></shape>)",
       "write <boolean name=\"face_normals\" value=\"true\"/> for flat triangles"},
  };
  for (const Foreign& foreign : cases) {
    const std::string refusal = refusal_of_text(scene_with(foreign.body));
    EXPECT_EQ(refusal.find("scene.xml:3: "), 0u) << refusal;
    EXPECT_NE(refusal.find(foreign.advice), std::string::npos) << refusal;
  }
}

/// As a modelling program exports it: a dozen things in the way, in every kind of place.
constexpr const char* kExported = R"(<scene version="3.0.0">
<default name="spp" value="64"/>
<integrator type="volpath"/>
<sensor type="thinlens">
  <float name="fov" value="40"/>
  <film type="hdrfilm"><string name="pixel_format" value="rgba"/>
    <rfilter type="gaussian"/></film>
  <sampler type="multijitter"><integer name="sample_count" value="$spp"/></sampler>
</sensor>
<bsdf type="twosided" id="wall"><bsdf type="diffuse">
  <texture type="bitmap" name="reflectance"/></bsdf></bsdf>
<bsdf type="principled" id="chrome"/>
<shape type="cube"><ref id="chrome"/>
  <bsdf type="roughdielectric"/></shape>
<shape type="sphere"><float name="radius" value="$size"/><ref id="wall"/></shape>
<shape type="rectangle"><ref id="floor"/>
  <emitter type="area"><rgb name="radiance" value="-1"/></emitter></shape>
<medium type="homogeneous"/>
</scene>)";

/// The lines on which check_scene finds something; the directory is no part of them.
std::vector<std::string> places(const std::vector<std::string>& problems) {
  std::vector<std::string> result;
  for (const std::string& problem : problems) {
    const std::size_t name = problem.rfind('/', problem.find(": ")) + 1;
    result.push_back(problem.substr(name, problem.find(": ") - name));
  }
  return result;
}

TEST(CheckScene, FindsAllThatIsInTheWayInTheOrderOfTheFile) {
  const ScratchDirectory directory;
  const auto problems = renderer::check_scene(directory.write("scene.xml", kExported));
  const std::vector<std::string> expected = {
      "scene.xml:3",  "scene.xml:4",  "scene.xml:6",  "scene.xml:7",  "scene.xml:8",
      "scene.xml:11", "scene.xml:12", "scene.xml:13", "scene.xml:14", "scene.xml:15",
      "scene.xml:16", "scene.xml:17", "scene.xml:18"};
  std::string all;
  for (const std::string& problem : problems) all += problem + "\n";
  EXPECT_EQ(places(problems), expected) << all;
}

TEST(CheckScene, AgreesWithTheReaderOnEveryProblemThatIsAlone) {
  const ScratchDirectory directory;
  for (const char* body :
       {"", "<shape type=\"sphere\"/>", "<shape type=\"sphear\"/>", "<shap/>",
        "<shape type=\"sphere\"><float name=\"radius\" value=\"-1\"/></shape>",
        "<shape type=\"disk\"><ref id=\"a\"/></shape>", "<bsdf type=\"diffuse\"/>",
        "<emitter type=\"sun\"><rgb name=\"radiance\" value=\"1\"/></emitter>",
        "<include filename=\"no.xml\"/><shape type=\"disk\"/>", "<shape type=\"sphere\"/>text"}) {
    const auto file = directory.write("scene.xml", scene_with(body));
    std::string first;
    try {
      renderer::load_scene(file);
    } catch (const std::exception& error) {
      first = error.what();
    }
    const auto problems = renderer::check_scene(file);
    if (first.empty()) {
      EXPECT_TRUE(problems.empty()) << problems.front();
    } else {
      EXPECT_NE(std::find(problems.begin(), problems.end(), first), problems.end()) << first;
    }
  }
}

TEST(CheckScene, FindsWhatIsWrongInSeveralFiles) {
  const ScratchDirectory directory;
  directory.write("part.xml",
                  "<scene version=\"2.0.0\">\n<shape type=\"cube\"/>\n"
                  "<bsdf type=\"plastic\" id=\"a\"/></scene>");
  const auto file = directory.write("scene.xml", scene_with("<include filename=\"part.xml\"/>\n"
                                                            "<shape type=\"cylinder\"/>"));
  EXPECT_EQ(places(renderer::check_scene(file)),
            (std::vector<std::string>{"scene.xml:4", "part.xml:2", "part.xml:3"}));
}

TEST(CheckScene, OfAFileWithManyProblemsTellsAThousand) {
  // Each costs a search for its line, up to there.
  std::string body;
  for (int i = 0; i < 20'000; ++i) body += "<shap/>\n";
  const ScratchDirectory directory;
  EXPECT_EQ(renderer::check_scene(directory.write("scene.xml", scene_with(body))).size(),
            renderer::kMaxProblems);
}

TEST(CheckScene, OfAFileThatIsNoXmlSaysSo) {
  const ScratchDirectory directory;
  EXPECT_EQ(renderer::check_scene(directory.write("scene.xml", "<scene")).size(), 1u);
  EXPECT_EQ(renderer::check_scene(directory / "no.xml").size(), 1u);
}

}  // namespace
}  // namespace plumbline::tests
