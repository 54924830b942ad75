#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <plumbline/output/checkpoint.h>
#include <plumbline/renderer/image_io/exr.h>

#include "command_line.h"

/// Every field that `render` writes, into its record and into the image's header, has a value that
/// is known beforehand, in some render off its default; a field without one fails. Read without the
/// project's own reader of records, which would undo what the writer mixed up.
namespace plumbline::tests {
namespace {

using Json = nlohmann::json;
using Fields = std::map<std::string, Json>;
using Texts = std::map<std::string, std::string>;

/// The version that the command says it has.
std::string version_of(const ScratchDirectory& scratch) {
  std::string text = run_plumbline(scratch.path(), "--version").out;
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

/// Renders `scene`, and gives its record and its image.
struct Rendered {
  Fields record;
  renderer::Image image;
  double seconds = 0;
  std::string error;  ///< what it said on standard error

  Rendered(const ScratchDirectory& scratch, const std::string& scene, const std::string& options,
           int exit_code = 0) {
    scratch.write("scene.xml", "<scene version=\"3.0.0\">" + scene + "</scene>");
    const Outcome outcome = run_plumbline(
        scratch.path(), "render scene.xml -o image.exr --json record.json " + options);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    error = outcome.err;
    record = Json::parse(scratch.read("record.json")).get<Fields>();
    image = renderer::read_exr(scratch / "image.exr");
    // The one field that nobody knows: it is there, and not negative.
    seconds = record.at("seconds").get<double>();
    EXPECT_GE(seconds, 0);
    record.erase("seconds");
    EXPECT_EQ(image.metadata.at("seconds"), fmt::format("{:.3f}", seconds));
    image.metadata.erase("seconds");
  }
};

std::string camera(const std::string& lookat) {
  return R"(<sensor type="perspective"><float name="fov" value="0.01"/><transform name="to_world">)" +
         lookat + R"(</transform><film type="hdrfilm"><rfilter type="box"/></film></sensor>)";
}

const std::string kInside = camera(R"(<lookat origin="0.5 0 0" target="0 0 0" up="0 0 1"/>)");

std::string closed_sphere_of(const std::string& radiance, const std::string& radius) {
  return R"(<shape type="sphere"><boolean name="flip_normals" value="true"/>
      <float name="radius" value=")" +
         radius + R"("/><emitter type="area"><rgb name="radiance" value=")" + radiance +
         R"("/></emitter></shape>)";
}

TEST(RenderFields, AreThoseOfARenderWithoutAnyRandomness) {
  // Every path of three vertices: radiance · (1 + 1/2 + 1/4), three channels of their own.
  const ScratchDirectory scratch;
  const Rendered rendered(
      scratch,
      R"(<default name="size" value="2"/>)" + kInside + closed_sphere_of("4 8 16", "$size"),
      "--strategy bsdf --max-depth 3 --spp 5 --size 8x4 --seed 7 --threads 3 -D size=1.5 "
      "--light-selection power --first-sample 6");
  const int paths = 8 * 4 * 5;
  EXPECT_EQ(rendered.record, (Fields{{"format", "plumbline.render/1"},
                                     {"scene", "scene.xml"},
                                     {"strategy", "bsdf"},
                                     {"heuristic", ""},
                                     {"sampler", "independent"},
                                     {"replicates", 1},
                                     {"light_selection", "power"},
                                     {"accelerator", "brute_force"},
                                     {"spp", 5},
                                     {"first_sample", 6},
                                     {"end_sample", 11},
                                     {"camera_rays", paths},
                                     {"bounce_rays", 2 * paths},
                                     {"shadow_rays", 0},
                                     {"rejected", 0},
                                     {"non_finite", 0},
                                     {"mean", {7, 14, 28}},
                                     {"seed", 7},
                                     {"version", version_of(scratch)},
                                     {"max_depth", 3},
                                     {"width", 8},
                                     {"height", 4},
                                     {"threads", 3},
                                     {"image", "image.exr"},
                                     {"parameters", {{"size", "1.5"}}}}));
  const std::uint64_t content = output::content_hash({scratch / "scene.xml"}, {{"size", "1.5"}});
  EXPECT_EQ(rendered.image.metadata, (Texts{{"scene", "scene.xml"},
                                            {"scene_content", fmt::format("{:016x}", content)},
                                            {"holds", "7:6-11"},
                                            {"counts", "1,1"},
                                            {"light_probability", "0.5"},
                                            {"roulette_depth", "5"},
                                            {"strategy", "bsdf"},
                                            {"seed", "7"},
                                            {"sampler", "independent"},
                                            {"replicates", "1"},
                                            {"light_selection", "power"},
                                            {"accelerator", "brute_force"},
                                            {"samples", "5"},
                                            {"max_depth", "3"},
                                            {"non_finite", "0"},
                                            {"version", version_of(scratch)},
                                            {"parameter.size", "1.5"}}));
  EXPECT_EQ(rendered.image.pixels.at(9), (renderer::Rgbf{7, 14, 28}));
  EXPECT_EQ(rendered.image.variance.at(9), renderer::Rgbf{});
  EXPECT_EQ(rendered.image.count.at(9), 5);
}

TEST(RenderFields, CountRaysAndReplicatesOfSobolPoints) {
  const ScratchDirectory scratch;
  Rendered rendered(scratch, kInside + closed_sphere_of("1", "1"),
                    "--strategy mis --heuristic power=3 --counts 4,2 --max-depth 3 --sampler sobol "
                    "--replicates 3 --spp 6 --size 4x2 --accelerator embree");
  const int paths = 4 * 2 * 6;
  const Fields expected{{"strategy", "mis 4,2"},
                        {"heuristic", "power=3"},
                        {"sampler", "sobol"},
                        {"replicates", 3},
                        {"spp", 6},
                        {"light_selection", "uniform"},
                        {"accelerator", "embree"},
                        {"camera_rays", paths},
                        {"bounce_rays", (4 + 1) * paths},
                        {"shadow_rays", 3 * paths},
                        {"parameters", Json::object()}};
  for (const auto& [name, value] : expected) EXPECT_EQ(rendered.record.at(name), value) << name;
  EXPECT_EQ(rendered.image.metadata.at("heuristic"), "power=3");
  EXPECT_EQ(rendered.image.metadata.at("replicates"), "3");
  EXPECT_EQ(rendered.image.metadata.at("counts"), "4,2");
  EXPECT_EQ(rendered.image.count.at(0), 3);
}

TEST(RenderFields, CountSamplesThatCannotBeMadeOrAreNotFinite) {
  // A floor lights itself: its own samples lie in its plane, and are rejected.
  const std::string above = camera(R"(<lookat origin="0 0 0.1" target="0 0 0" up="0 1 0"/>)");
  const ScratchDirectory scratch;
  const Rendered rejected(scratch, above + R"(<shape type="rectangle"><emitter type="area">
      <rgb name="radiance" value="1"/></emitter></shape>)",
                          "--strategy light --max-depth 2 --spp 3 --size 2x2");
  EXPECT_EQ(rejected.record.at("rejected"), 2 * 2 * 3);
  EXPECT_EQ(rejected.record.at("shadow_rays"), 0);
  // A point light so bright and near that its irradiance exceeds a float: at 1e-5 m above what is
  // seen, a square of 2e-5 m, it is 3e39 at least.
  const Rendered infinite(scratch, above + R"(<shape type="rectangle"/><emitter type="point">
      <point name="position" x="0" y="0" z="1e-5"/><rgb name="intensity" value="1e30"/></emitter>)",
                          "--strategy light --max-depth 2 --spp 3 --size 2x2 --first-sample 5", 1);
  EXPECT_EQ(infinite.error,
            "plumbline: 12 samples were NOT FINITE and left out of the image, which is written: "
            "the first is sample 5 of pixel (0, 0)\n");
  EXPECT_EQ(infinite.record.at("non_finite"), 2 * 2 * 3);
  EXPECT_EQ(infinite.image.metadata.at("non_finite"), "12");
  EXPECT_EQ(infinite.image.count.at(0), 0);
}

TEST(RenderFields, SayWhereAVarianceIsBeyondSinglePrecision) {
  // The same light a metre away: what arrives is finite, its square is not.
  const ScratchDirectory scratch;
  const std::string wide = R"(<sensor type="perspective"><float name="fov" value="90"/>
      <transform name="to_world"><lookat origin="0 0 1" target="0 0 0" up="0 1 0"/></transform>
      <film type="hdrfilm"><rfilter type="box"/></film></sensor>)";
  const Rendered bright(scratch, wide + R"(<shape type="rectangle"/><emitter type="point">
      <point name="position" x="0" y="0" z="1"/><rgb name="intensity" value="1e30"/></emitter>)",
                        "--strategy light --max-depth 2 --spp 3 --size 2x2", 1);
  EXPECT_EQ(bright.record.at("non_finite"), 0);
  EXPECT_EQ(bright.error,
            "plumbline: the variance of 4 pixels is beyond what an image holds (3.4e+38) and "
            "written as infinity: the first is pixel (0, 0)\n");
}

}  // namespace
}  // namespace plumbline::tests
