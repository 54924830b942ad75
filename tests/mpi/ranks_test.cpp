#include "ranks.h"

#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <filesystem>
#include <string>

/// Any number of ranks gives what one process gives.
namespace plumbline::tests {
namespace {

/// Renders by one process and by ranks, and compares all bits.
void expect_same_image(const ScratchDirectory& scratch, const std::string& render) {
  ASSERT_EQ(run_plumbline(scratch.path(), render + " -o whole.exr").exit_code, 0) << render;
  for (const int count : {1, 2, 3, 7}) {
    const Outcome outcome =
        run_in_ranks(scratch.path(), count, render + " --threads 1 -o ranks.exr");
    ASSERT_EQ(outcome.exit_code, 0) << render << "\n" << outcome.err;
    expect_same_bits(scratch.path(), "whole.exr", "ranks.exr");
  }
}

TEST(Ranks, GiveTheImageOfOneProcessBitForBit) {
  const ScratchDirectory scratch;
  expect_same_image(scratch, "render sphere_light --size 13x9 --sampler sobol --spp 32");
}

TEST(Ranks, StopAtTheErrorOfOneProcess) {
  const ScratchDirectory scratch;
  expect_same_image(scratch, "render sphere_light --size 8x6 --strategy bsdf --error 0.3");
  const std::string out = run_plumbline(scratch.path(),
                                        "render sphere_light --size 8x6 -o x.exr "
                                        "--strategy bsdf --error 0.3")
                              .out;
  EXPECT_EQ(out.find(" 1 samples per pixel"), std::string::npos) << "is the limit ever looked at?";
}

TEST(Ranks, ShareOutSamplesAsOneProcess) {
  const ScratchDirectory scratch;
  const std::string render = "render sphere_light --size 13x9 --strategy light --adaptive ";
  expect_same_image(scratch, render + "--sampler sobol --spp 64");
  expect_same_image(scratch, render + "--error 0.02");
}

TEST(Ranks, AllocateSamplesAsOneProcess) {
  const ScratchDirectory scratch;
  expect_same_image(scratch, "render sphere_light --size 2x2 --allocation lu --spp 80");
}

TEST(Ranks, GoOnFromWhatAnotherNumberOfRanksHasKept) {
  const ScratchDirectory scratch;
  const std::string render = "render sphere_light --size 13x9 --sampler sobol --threads 1 ";
  ASSERT_EQ(run_plumbline(scratch.path(), render + "--spp 32 -o whole.exr").exit_code, 0);
  const auto in_three =
      run_in_ranks(scratch.path(), 3, render + "--spp 8 -o part.exr --checkpoint state");
  ASSERT_EQ(in_three.exit_code, 0) << in_three.err;
  const std::string resume = render + "--spp 32 -o on.exr --resume state";
  ASSERT_EQ(run_plumbline(scratch.path(), resume).exit_code, 0);
  expect_same_bits(scratch.path(), "whole.exr", "on.exr");
  const auto in_two = run_in_ranks(scratch.path(), 2, resume + " --json on.json");
  ASSERT_EQ(in_two.exit_code, 0) << in_two.err;
  expect_same_bits(scratch.path(), "whole.exr", "on.exr");
  // Each sample has one camera ray, and is counted once.
  EXPECT_NE(scratch.read("on.json").find("\"camera_rays\":" + std::to_string(13 * 9 * 32)),
            std::string::npos)
      << scratch.read("on.json");
}

TEST(Ranks, GoOnFromAPilotAndFromWhatCameAfterIt) {
  const ScratchDirectory scratch;
  const std::string render = "render sphere_light --size 13x9 --adaptive --threads 1 ";
  ASSERT_EQ(run_plumbline(scratch.path(), render + "--spp 64 -o whole.exr").exit_code, 0);
  for (const char* before : {"17", "40"}) {
    const auto in_three =
        run_in_ranks(scratch.path(), 3, render + "-o part.exr --checkpoint state --spp " + before);
    ASSERT_EQ(in_three.exit_code, 0) << in_three.err;
    const std::string resume = render + "--spp 64 -o on.exr --resume state";
    ASSERT_EQ(run_plumbline(scratch.path(), resume).exit_code, 0);
    expect_same_bits(scratch.path(), "whole.exr", "on.exr");
    const auto in_two = run_in_ranks(scratch.path(), 2, resume);
    ASSERT_EQ(in_two.exit_code, 0) << in_two.err;
    expect_same_bits(scratch.path(), "whole.exr", "on.exr");
  }
}

TEST(Ranks, SayOnceWhatIsWrongForAll) {
  const ScratchDirectory scratch;
  const Outcome outcome = run_in_ranks(scratch.path(), 3, "render nosuch -o out.exr");
  EXPECT_EQ(outcome.exit_code, 2);
  const std::size_t at = outcome.err.find("nosuch: neither a scene file nor a known scene");
  ASSERT_NE(at, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("nosuch", at + 10), std::string::npos) << outcome.err;
  EXPECT_EQ(scratch.listing(), "");
}

/// One rank on one scene, and one on another.
Outcome run_two_scenes(const ScratchDirectory& scratch, const std::string& other) {
  return run_plumbline(scratch.path(),
                       "render sphere_light --size 8x6 -o out.exr --mpi : -n 1 '" PLUMBLINE_COMMAND
                       "' render " +
                           other + " --size 8x6 -o out.exr --mpi",
                       in_ranks(1));
}

TEST(Ranks, OfDifferentScenesRenderNothing) {
  const ScratchDirectory scratch;
  const Outcome missing = run_two_scenes(scratch, "nosuch");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_NE(missing.err.find("plumbline: rank 1 (process "), std::string::npos) << missing.err;
  EXPECT_NE(missing.err.find("nosuch: neither a scene file"), std::string::npos) << missing.err;
  const Outcome other = run_two_scenes(scratch, "sphere_light -D radius=0.3");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("is of another render:\n  scene content"), std::string::npos)
      << other.err;
  EXPECT_EQ(scratch.listing(), "");
}

TEST(Ranks, RefuseOptionsThatAreNotForThem) {
  const ScratchDirectory scratch;
  const std::string render = "render sphere_light -o out.exr ";
  expect_refused(scratch.path(), render + "--mpi --seconds 1", "excludes");
  expect_refused(scratch.path(), render + "--mpi --shard 1/2 --checkpoint state", "excludes");
  expect_refused(scratch.path(), render + "--mpi-timeout 5", "--mpi");
}

}  // namespace
}  // namespace plumbline::tests
