#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <bit>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <plumbline/renderer/image_io/exr.h>

#include "command_line.h"

/// Signals lose nothing that is done, and a render that was killed is gone on with.
namespace plumbline::tests {
namespace {

std::vector<std::uint32_t> bits_of(const std::filesystem::path& file) {
  const renderer::Image image = renderer::read_exr(file);
  std::vector<std::uint32_t> bits;
  const auto add = [&](float x) { bits.push_back(std::bit_cast<std::uint32_t>(x)); };
  for (const auto* layer : {&image.pixels, &image.variance}) {
    for (const renderer::Rgbf& pixel : *layer) {
      add(pixel.r);
      add(pixel.g);
      add(pixel.b);
    }
  }
  for (const float count : image.count) add(count);
  return bits;
}

bool is_there(const ScratchDirectory& scratch, const char* name) {
  return std::filesystem::exists(scratch / name);
}

const std::string kScene = "render glass_sphere --size 64x48 --threads 2 ";

TEST(Interruptions, KilledAtRandomMomentsAndResumedIsNeverKilled) {
  const ScratchDirectory scratch;
  const std::string render = kScene + "--sampler sobol --spp 256 -o ";
  const auto before = std::chrono::steady_clock::now();
  ASSERT_EQ(run_plumbline(scratch.path(), render + "whole.exr").exit_code, 0);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - before;
  std::mt19937 random(static_cast<unsigned>(check_seed("kills")));
  int kills = 0, resumed = 0;
  while (kills < 12) {
    const bool resumes = is_there(scratch, "state");
    Running running(scratch.path(), render + "out.exr --checkpoint state --every 0.001" +
                                        (resumes ? " --resume state" : ""));
    std::this_thread::sleep_for(whole * std::uniform_real_distribution(0.0, 0.8)(random));
    running.signal(SIGKILL);
    if (running.ended().exit_code == 0) {  // too late
      EXPECT_EQ(bits_of(scratch / "out.exr"), bits_of(scratch / "whole.exr"));
      std::filesystem::remove(scratch / "state");
      continue;
    }
    ++kills;
    resumed += resumes ? 1 : 0;
  }
  EXPECT_GT(resumed, 0);
  ASSERT_TRUE(is_there(scratch, "state"));
  const Outcome outcome =
      run_plumbline(scratch.path(), render + "out.exr --checkpoint state --resume state");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(bits_of(scratch / "out.exr"), bits_of(scratch / "whole.exr"));
  EXPECT_EQ(scratch.listing(), "out.exr state whole.exr");
}

TEST(Interruptions, SignalsKeepTheSamplesThatAreThere) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
    const ScratchDirectory scratch;
    Running running(scratch.path(),
                    kScene + "-o out.exr --spp 1000000 --checkpoint state --every 0.01");
    ASSERT_TRUE(running.waits_for([&] { return is_there(scratch, "state"); }));
    running.signal(signal);
    const Outcome outcome = running.ended();
    EXPECT_EQ(outcome.exit_code, 128 + signal) << outcome.err;
    EXPECT_NE(outcome.err.find("the same command with --resume state goes on"), std::string::npos)
        << outcome.err;
    const renderer::Image image = renderer::read_exr(scratch / "out.exr");
    const int samples = std::stoi(image.metadata.at("samples"));
    EXPECT_EQ(image.metadata.at("stopped"),
              "at " + std::to_string(samples) + " of 1000000 samples per pixel");
    for (const float count : image.count) EXPECT_GE(static_cast<int>(count), samples);
    EXPECT_EQ(scratch.listing(), "out.exr state");
    // With the samples that are there and four more, it is a whole render of so many.
    const std::string spp = "--spp " + std::to_string(samples + 4);
    ASSERT_EQ(run_plumbline(scratch.path(), kScene + "-o on.exr --resume state " + spp).exit_code,
              0);
    if (signal != SIGTERM) continue;
    ASSERT_EQ(run_plumbline(scratch.path(), kScene + "-o whole.exr " + spp).exit_code, 0);
    EXPECT_EQ(bits_of(scratch / "on.exr"), bits_of(scratch / "whole.exr"));
  }
}

TEST(Interruptions, ASecondSignalEndsAtOnceAndLeavesNothing) {
  const ScratchDirectory scratch;
  Running running(scratch.path(),
                  kScene + "-o out.exr --spp 1000000 --checkpoint state --every 0.01");
  ASSERT_TRUE(running.waits_for([&] { return is_there(scratch, "state"); }));
  running.signal(SIGTERM);
  running.signal(SIGINT);
  const int exit_code = running.ended().exit_code;
  EXPECT_TRUE(exit_code == -SIGINT || exit_code == -SIGTERM) << exit_code;  // in either order
  EXPECT_EQ(scratch.listing(), "state");
}

TEST(Interruptions, OfCalibrationKeepTheRowsAndSayThatOthersAreMissing) {
  const ScratchDirectory scratch;
  Running running(scratch.path(), "calibrate --full --only p-values --results results");
  ASSERT_TRUE(running.waits_for([&] { return is_there(scratch, "results/calibration.jsonl"); }));
  running.signal(SIGTERM);
  const Outcome outcome = running.ended();
  if (outcome.exit_code == -SIGTERM) return;  // before the first row began
  EXPECT_EQ(outcome.exit_code, 128 + SIGTERM);
  EXPECT_NE(outcome.out.find("INCOMPLETE: stopped by signal 15 after"), std::string::npos);
  EXPECT_NE(scratch.read("results/calibration.jsonl").find("calibration/incomplete"),
            std::string::npos);
  EXPECT_EQ(run_plumbline(scratch.path(), "report results -o page.html").exit_code, 1);
}

TEST(Interruptions, ACheckpointOfAnotherRenderIsRefusedWithWhatIsAnother) {
  const ScratchDirectory scratch;
  std::string scene = text_of(source_file("analytic/scenes/sphere_light.xml"));
  scratch.write("scene.xml", scene);
  const std::string render = "render scene.xml --size 8x6 -o out.exr --resume state ";
  ASSERT_EQ(run_plumbline(scratch.path(),
                          "render scene.xml --size 8x6 -o out.exr --checkpoint state --spp 4")
                .exit_code,
            0);
  ASSERT_EQ(run_plumbline(scratch.path(), render + "--spp 8 --threads 1").exit_code, 0);
  const auto refused = [&](const std::string& options, const std::string& why) {
    expect_refused(scratch.path(), render + options, why);
  };
  refused("--spp 2", "state: holds 4 samples of a pixel, more than --spp 2");
  refused("--seed 1", "seed: kept of 0, asked for 1");
  refused("--first-sample 4", "first sample: kept of 0, asked for 4");
  refused("--strategy light", "strategy: kept of mis, asked for light");
  refused("--heuristic balance", "heuristic: kept of power=2, asked for balance");
  refused("--counts 2,1", "counts: kept of 1,1, asked for 2,1");
  refused("--sampler sobol", "sampler: kept of independent, asked for sobol");
  refused("--backend scalar", "backend: kept of batched, asked for scalar");
  refused("--accelerator embree", "accelerator: kept of brute_force, asked for embree");
  refused("--light-selection power", "light selection: kept of uniform, asked for power");
  refused("--max-depth 1", "maximum depth: kept of 2, asked for 1");
  refused("--roulette 2", "roulette depth: kept of 5, asked for 2");
  refused("--adaptive --spp 32", "adaptive: kept of none, asked for pilot of 16");
  refused("--error 0.1", "error: kept of 0, asked for 0.1");
  refused("-D radius=0.3", "scene content: kept of ");
  refused("--allocation lu --spp 80", "allocation: kept of none, asked for lu, ");
  scratch.write("scene.xml", scene + "<!-- another scene -->");
  refused("", "scene content: kept of ");
  scratch.write("scene.xml", scene);
  std::string state = scratch.read("state");
  state.replace(state.find("version="), 9, "version=0");
  scratch.write("state", state);
  refused("", "was changed");
}

/// Checkpoints of a small render with these options, and its image without any.
void render_shards(const ScratchDirectory& scratch, const std::string& render) {
  ASSERT_EQ(run_plumbline(scratch.path(), render + " -o whole.exr").exit_code, 0);
  for (const std::string shard : {"1", "2", "3"}) {
    const Outcome outcome = run_plumbline(
        scratch.path(), render + " -o /dev/null --shard " + shard + "/3 --checkpoint " + shard);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
}

TEST(Merge, OfAllShardsIsTheWholeImageBitForBit) {
  for (const std::string options : {"", "--sampler sobol --replicates 4", "--strategy one-sample",
                                    "--allocation lu --spp 80"}) {
    const ScratchDirectory scratch;
    const std::string spp = options.find("--spp") == std::string::npos ? "--spp 32 " : "";
    render_shards(scratch, "render sphere_light --size 25x17 " + spp + options);
    for (const std::string order : {"1 2 3", "3 1 2"}) {
      const Outcome outcome = run_plumbline(scratch.path(), "merge " + order + " -o merged.exr");
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(bits_of(scratch / "merged.exr"), bits_of(scratch / "whole.exr")) << options;
    }
  }
}

TEST(Merge, OfOtherSeedsAddsTheirSamples) {
  const ScratchDirectory scratch;
  const std::string render = "render sphere_light --size 8x6 --spp 32 ";
  for (const std::string seed : {"1", "2"}) {
    ASSERT_EQ(run_plumbline(scratch.path(),
                            render + "-o " + seed + ".exr --seed " + seed + " --checkpoint " + seed)
                  .exit_code,
              0);
  }
  ASSERT_EQ(run_plumbline(scratch.path(), "merge 1 2 -o both.exr").exit_code, 0);
  const renderer::Image a = renderer::read_exr(scratch / "1.exr");
  const renderer::Image b = renderer::read_exr(scratch / "2.exr");
  const renderer::Image both = renderer::read_exr(scratch / "both.exr");
  EXPECT_EQ(both.metadata.at("seed"), "1, 2");
  EXPECT_EQ(both.metadata.at("samples"), "64");
  for (std::size_t i = 0; i < both.pixels.size(); ++i) {
    EXPECT_EQ(both.count[i], 64);
    const double mean = (double{a.pixels[i].g} + double{b.pixels[i].g}) / 2;
    const double apart = double{a.pixels[i].g} - double{b.pixels[i].g};
    // Sums of squares: those within each, and 32 samples each (apart / 2)² from the mean.
    const double squares =
        31 * (double{a.variance[i].g} + double{b.variance[i].g}) + 64 * (apart / 2) * (apart / 2);
    EXPECT_NEAR(both.pixels[i].g, mean, 1e-6 * mean) << "two roundings to float";
    EXPECT_NEAR(both.variance[i].g, squares / 63, 1e-5 * squares / 63);
  }
}

TEST(Merge, RefusesWhatIsNoSum) {
  const ScratchDirectory scratch;
  render_shards(scratch, "render sphere_light --size 8x6 --spp 4");
  const std::string other =
      "render sphere_light --size 8x6 --spp 4 -o /dev/null --checkpoint other ";
  const auto refused = [&](const std::string& arguments, const std::string& why) {
    expect_refused(scratch.path(), arguments, why);
  };
  refused("merge 1 2 -o x.exr", "16 of 48 pixels are in none of the checkpoints");
  refused("merge 1 2 3 2 -o x.exr", "2: holds samples of the seed 0 that 2 holds too");
  refused("merge 1 whole.exr -o x.exr", "1: is no OpenEXR image, as others are");
  refused("merge 1 2 3 -o 3", "is the same file as");
  refused(other + "--resume 1 --shard 2/3", "1: is of another --shard");
  refused(other + "--resume 1", "1: is of another --shard");
  for (const std::string shard : {"0/3", "4/3", "1", "1/0", "a/b"}) {
    refused(other + "--shard " + shard, "--shard " + shard + ": must read I/N");
  }
  ASSERT_EQ(run_plumbline(scratch.path(), other + "-D radius=0.3").exit_code, 0);
  refused("merge 1 2 3 other -o x.exr", "other: is of another render:\n  scene content");
  EXPECT_EQ(scratch.listing(), "1 2 3 other whole.exr");
}

}  // namespace
}  // namespace plumbline::tests
