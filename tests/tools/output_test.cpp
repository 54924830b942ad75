#include <gtest/gtest.h>
#include <plumbline_tests/support.h>
#include <unistd.h>

#include <string>

#include "command_line.h"

/// Files appear whole or not at all, and a machine that fails is told from a user who errs.
namespace plumbline::tests {
namespace {

const std::string kQuick = "render furnace_open --spp 1 --size 64x48 ";

TEST(Output, ReplacesAnImage) {
  const ScratchDirectory scratch;
  scratch.write("out.exr", "old");
  ASSERT_EQ(run_plumbline(scratch.path(), kQuick + "-o out.exr").exit_code, 0);
  EXPECT_NE(scratch.read("out.exr"), "old");
  EXPECT_EQ(scratch.listing(), "out.exr");
}

TEST(Output, KilledRenderLeavesTheOldImage) {
  const ScratchDirectory scratch;
  scratch.write("out.exr", "old");
  ASSERT_TRUE(run_and_kill(scratch.path(), "render furnace_open -o out.exr --seconds 60", 0.5));
  EXPECT_EQ(scratch.read("out.exr"), "old");
  EXPECT_EQ(scratch.listing(), "out.exr");
}

TEST(Output, ThatOutgrowsTheFileSizeLimitLeavesTheOldImageAndIsTheMachinesFault) {
  const ScratchDirectory scratch;
  scratch.write("out.exr", "old");
  const Outcome outcome = run_plumbline(scratch.path(), kQuick + "-o out.exr", "ulimit -f 8;");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("out.exr"), std::string::npos);
  EXPECT_EQ(scratch.read("out.exr"), "old");
  EXPECT_EQ(scratch.listing(), "out.exr");
}

// By links: code that is wrong would put a file in the device's place.
TEST(Output, ToAFullDeviceIsTheMachinesFault) {
  const ScratchDirectory scratch;
  std::filesystem::create_symlink("/dev/full", scratch / "full");
  EXPECT_EQ(run_plumbline(scratch.path(), kQuick + "-o full").exit_code, 3);
  EXPECT_EQ(run_plumbline(scratch.path(), kQuick + "-o out.exr --json full").exit_code, 3);
  EXPECT_EQ(run_plumbline(scratch.path(), "list >full").exit_code, 3);
  EXPECT_EQ(run_plumbline(scratch.path(), "--help >full").exit_code, 3);
  EXPECT_TRUE(std::filesystem::is_symlink(scratch / "full"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(Output, ToTheNullDeviceIsFine) {
  const ScratchDirectory scratch;
  std::filesystem::create_symlink("/dev/null", scratch / "null");
  const Outcome outcome = run_plumbline(scratch.path(), kQuick + "-o null --json out.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(scratch.read("out.json").find("\"image\":\"\""), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_symlink(scratch / "null"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(Output, InADirectoryThatMayNotBeWrittenIsBadInput) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch / "closed");
  std::filesystem::permissions(scratch / "closed", std::filesystem::perms::owner_read);
  const Outcome outcome = run_plumbline(scratch.path(), kQuick + "-o closed/out.exr");
  std::filesystem::permissions(scratch / "closed", std::filesystem::perms::owner_all);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("closed/out.exr: cannot write"), std::string::npos);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these reserve all of memory
TEST(Memory, ThatRunsOutIsTheMachinesFault) {
  const ScratchDirectory scratch;
  // 64 million pixels of moments take 3.7 GB.
  const Outcome outcome = run_plumbline(
      scratch.path(), "render furnace_open -o out.exr --spp 1 --size 8192x8192 --threads 1",
      "ulimit -v 2500000;");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("out of memory"), std::string::npos);
  EXPECT_EQ(scratch.listing(), "");
}
#endif

}  // namespace
}  // namespace plumbline::tests
