#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <set>
#include <string>

#include <plumbline/renderer/image_io/exr.h>
#include <plumbline/reports/render_record.h>

#include "command_line.h"

namespace plumbline::tests {
namespace {

TEST(RenderCommand, WritesImageAndRecord) {
  const ScratchDirectory scratch;
  const Outcome outcome =
      run_plumbline(scratch.path(),
                    "render sphere_light -o out.exr --json out.json --strategy one-sample "
                    "--heuristic balance --spp 5 --seed 7 --size 24x16 -D radius=0.25 --threads 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const renderer::Image image = renderer::read_exr(scratch / "out.exr");
  EXPECT_EQ(image.width, 24);
  EXPECT_EQ(image.height, 16);
  EXPECT_EQ(image.count.at(0), 5);
  EXPECT_EQ(image.variance.size(), image.pixels.size());
  EXPECT_EQ(image.metadata.at("scene"), "sphere_light");
  EXPECT_EQ(image.metadata.at("strategy"), "one-sample");
  EXPECT_EQ(image.metadata.at("heuristic"), "balance");
  EXPECT_EQ(image.metadata.at("seed"), "7");
  EXPECT_EQ(image.metadata.at("samples"), "5");
  EXPECT_EQ(image.metadata.at("parameter.radius"), "0.25");
  EXPECT_FALSE(image.metadata.at("seconds").empty());
  EXPECT_FALSE(image.metadata.at("version").empty());

  const reports::RenderRecord record = reports::read_render_record(scratch / "out.json");
  EXPECT_EQ(record.scene, "sphere_light");
  EXPECT_EQ(record.strategy, "one-sample");
  EXPECT_EQ(record.heuristic, "balance");
  EXPECT_EQ(record.samples_per_pixel, 5u);
  EXPECT_GT(record.seconds, 0);
  EXPECT_EQ(record.camera_rays, 24u * 16 * 5);
  EXPECT_GT(record.bounce_rays + record.shadow_rays, 0u);
  EXPECT_EQ(record.non_finite, 0u);
  EXPECT_GT(record.mean[0], 0);
  EXPECT_EQ(record.seed, 7u);
  EXPECT_EQ(record.max_depth, 2);
  EXPECT_EQ(record.width, 24);
  EXPECT_EQ(record.threads, 1);
  EXPECT_EQ(record.image, scratch / "out.exr");
  EXPECT_EQ(record.parameters.at("radius"), "0.25");
}

TEST(RenderCommand, SobolImagesSayHowTheirNoiseIsKnown) {
  const ScratchDirectory scratch;
  ASSERT_EQ(run_plumbline(scratch.path(),
                          "render sphere_light -o out.exr --json out.json --sampler sobol --spp 64 "
                          "--size 16x12 --light-selection power")
                .exit_code,
            0);
  const renderer::Image image = renderer::read_exr(scratch / "out.exr");
  EXPECT_EQ(image.count.at(0), 4);
  EXPECT_EQ(image.metadata.at("sampler"), "sobol");
  EXPECT_EQ(image.metadata.at("replicates"), "4");
  EXPECT_EQ(image.metadata.at("samples"), "64");
  const reports::RenderRecord record = reports::read_render_record(scratch / "out.json");
  EXPECT_EQ(record.sampler, "sobol");
  EXPECT_EQ(record.replicates, 4u);
  EXPECT_EQ(record.light_selection, "power");
}

TEST(RenderCommand, SharesOutSamplesAndWritesTheMapOfTheShares) {
  const ScratchDirectory scratch;
  const Outcome outcome = run_plumbline(
      scratch.path(),
      "render sphere_light -o out.exr --json out.json --allocation root-nodes --spp 60 "
      "--iterations 3 --share-limit 0.25 --share-map shares.exr --size 12x8");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.substr(0, outcome.out.find(':')), "MIS root-nodes (balance)");
  const renderer::Image shares = renderer::read_exr(scratch / "shares.exr");
  ASSERT_EQ(shares.pixels.size(), 12u * 8);
  for (const renderer::Rgbf& share : shares.pixels) {
    EXPECT_GE(share.r, 0.25f);
    EXPECT_LE(share.r, 0.75f);
  }
  EXPECT_EQ(renderer::read_exr(scratch / "out.exr").count.at(0), 60);
  const reports::RenderRecord record = reports::read_render_record(scratch / "out.json");
  EXPECT_EQ(record.strategy, "mis root-nodes");
  EXPECT_EQ(record.heuristic, "balance");
  EXPECT_EQ(record.samples_per_pixel, 60u);
}

TEST(RenderCommand, SaysAtTheStartWhatItFound) {
  const ScratchDirectory scratch;
  const Outcome outcome =
      run_plumbline(scratch.path(), "render furnace_cube -o out.exr --spp 1 --size 8x8");
  EXPECT_EQ(
      outcome.out.substr(0, outcome.out.find('\n')),
      "MIS (power=2): 6 lights, 6 shapes, 1 BSDF, 8x8 pixels, depth unlimited, up to 1 sample "
      "per pixel");
}

TEST(RenderCommand, TakesCountsProbabilitiesRouletteAndParametersOfHeuristics) {
  const ScratchDirectory scratch;
  const auto strategy_and_heuristic = [&](const std::string& options) {
    const Outcome outcome =
        run_plumbline(scratch.path(),
                      "render furnace_sphere -o o.exr --spp 1 --size 8x8 --json o.json " + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const reports::RenderRecord record = reports::read_render_record(scratch / "o.json");
    return record.strategy + " / " + record.heuristic;
  };
  EXPECT_EQ(strategy_and_heuristic("--counts 4,2 --heuristic power=3"), "mis 4,2 / power=3");
  EXPECT_EQ(strategy_and_heuristic("--strategy one-sample --light-probability 0.25 --heuristic "
                                   "cutoff=0.2"),
            "one-sample 0.25 / cutoff=0.2");
  EXPECT_EQ(strategy_and_heuristic("--strategy average --roulette off --max-depth 3"),
            "average / ");
}

TEST(RenderCommand, RefusesOptionsWithoutMeaning) {
  const ScratchDirectory scratch;
  for (const std::string options :
       {"--counts 0,0", "--counts 2", "--counts 2,-1", "--counts 1,2,3",
        "--strategy bsdf --counts 1,2", "--light-probability 0.5",
        "--strategy one-sample --light-probability 1", "--heuristic power=0", "--heuristic power=x",
        "--heuristic cutoff=2", "--heuristic balance=2", "--roulette 0", "--roulette never",
        "--roulette off"}) {
    const Outcome outcome = run_plumbline(
        scratch.path(), "render furnace_sphere -o o.exr --spp 1 --size 8x8 " + options);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_FALSE(outcome.err.empty()) << options;
  }
}

TEST(RenderCommand, TakesASceneFileAndItsSampleCount) {
  const ScratchDirectory scratch;
  scratch.write("my.xml", R"(<scene version="3.0.0"><sensor type="perspective">
      <float name="fov" value="40"/><film type="hdrfilm"><integer name="width" value="8"/>
      <integer name="height" value="4"/><rfilter type="box"/></film>
      <sampler type="independent"><integer name="sample_count" value="3"/></sampler></sensor>
      <emitter type="constant"><rgb name="radiance" value="2"/></emitter></scene>)");
  ASSERT_EQ(run_plumbline(scratch.path(), "render my.xml -o out.exr").exit_code, 0);
  const renderer::Image image = renderer::read_exr(scratch / "out.exr");
  EXPECT_EQ(image.width, 8);
  EXPECT_EQ(image.count.at(0), 3);
  // Nothing but the environment is seen: every sample is its radiance.
  EXPECT_EQ(image.pixels.at(0).g, 2);
}

TEST(RenderCommand, StopsAtTheTimeGiven) {
  const ScratchDirectory scratch;
  ASSERT_EQ(run_plumbline(scratch.path(),
                          "render furnace_open -o out.exr --seconds 0.3 --json out.json --size 8x8")
                .exit_code,
            0);
  const reports::RenderRecord record = reports::read_render_record(scratch / "out.json");
  EXPECT_GT(record.samples_per_pixel, 1u);
}

TEST(RenderCommand, StopsAtTheErrorGiven) {
  const ScratchDirectory scratch;
  const auto samples_at = [&](const std::string& error) {
    EXPECT_EQ(run_plumbline(scratch.path(),
                            "render sphere_light -o out.exr --json out.json "
                            "--strategy bsdf --size 16x12 --error " +
                                error)
                  .exit_code,
              0);
    return reports::read_render_record(scratch / "out.json").samples_per_pixel;
  };
  // A tenth of the error takes a hundred times the samples, up to the doubling of passes.
  EXPECT_GT(samples_at("0.05"), 20 * samples_at("0.5"));
}

TEST(RenderCommand, ImageDependsOnTheSeedAndNotOnThreads) {
  const ScratchDirectory scratch;
  for (const char* variant :
       {"-o a.exr --threads 1", "-o b.exr --threads 3", "-o c.exr --seed 1"}) {
    ASSERT_EQ(run_plumbline(scratch.path(),
                            std::string("render furnace_open --spp 4 --size 40x30 ") + variant)
                  .exit_code,
              0);
  }
  EXPECT_EQ(run_plumbline(scratch.path(), "compare a.exr b.exr --exact").exit_code, 0);
  const Outcome outcome = run_plumbline(scratch.path(), "compare a.exr c.exr --exact");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("pixels differ, the first at ("), std::string::npos);
}

TEST(RenderCommand, ShowsProgressOnATerminalOnly) {
  const ScratchDirectory scratch;
  const std::string arguments = "render furnace_open -o out.exr --seconds 0.6 --size 16x16";
  const std::string shown = run_on_terminal(scratch.path(), arguments);
  EXPECT_NE(shown.find(" s left"), std::string::npos);
  EXPECT_EQ(run_plumbline(scratch.path(), arguments).err, "");
}

}  // namespace
}  // namespace plumbline::tests
