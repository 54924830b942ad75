#include <gtest/gtest.h>
#include <plumbline_tests/support.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>

#include <plumbline/renderer/image_io/exr.h>

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

/// The temporary files of commands in a directory.
std::string temporary_files(const ScratchDirectory& scratch) {
  std::string names;
  for (const auto& entry : std::filesystem::directory_iterator(scratch.path())) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(".plumbline-", 0) == 0) names += name + " ";
  }
  return names;
}

const std::string kLong = "render furnace_open -o out.exr --seconds 60 --size 64x48";

TEST(Output, KilledRenderLeavesTheOldImageAndTheNextOneSweepsUp) {
  const ScratchDirectory scratch;
  scratch.write("out.exr", "old");
  Running running(scratch.path(), kLong);
  ASSERT_TRUE(running.waits_for([&] { return !temporary_files(scratch).empty(); }));
  running.signal(SIGKILL);
  EXPECT_EQ(running.ended().exit_code, -SIGKILL);
  EXPECT_EQ(scratch.read("out.exr"), "old");
  EXPECT_NE(temporary_files(scratch), "");
  ASSERT_EQ(run_plumbline(scratch.path(), kQuick + "-o other.exr").exit_code, 0);
  EXPECT_NE(temporary_files(scratch), "");  // of another file: not its own
  ASSERT_EQ(run_plumbline(scratch.path(), kQuick + "-o out.exr").exit_code, 0);
  EXPECT_EQ(scratch.listing(), "other.exr out.exr");
}

TEST(Output, OfAProcessThatLivesIsNotSweptUp) {
  const ScratchDirectory scratch;
  Running running(scratch.path(), kLong);
  ASSERT_TRUE(running.waits_for([&] { return !temporary_files(scratch).empty(); }));
  const std::string living = temporary_files(scratch);
  ASSERT_EQ(run_plumbline(scratch.path(), kQuick + "-o out.exr").exit_code, 0);
  EXPECT_EQ(temporary_files(scratch), living);
  running.signal(SIGQUIT);  // which removes it
  EXPECT_EQ(running.ended().exit_code, -SIGQUIT);
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
  std::filesystem::permissions(
      scratch / "closed", std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const Outcome outcome = run_plumbline(scratch.path(), kQuick + "-o closed/out.exr");
  std::filesystem::permissions(scratch / "closed", std::filesystem::perms::owner_all);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("closed/out.exr: cannot write"), std::string::npos);
}

TEST(Output, ThroughALinkGoesWhereItLeads) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch / "images");
  std::filesystem::create_symlink("images/image.exr", scratch / "link.exr");
  for (int i = 0; i < 2; ++i) {  // to what is not there yet, then to what is
    ASSERT_EQ(run_plumbline(scratch.path(), kQuick + "-o link.exr").exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(scratch / "link.exr"));
    EXPECT_EQ(renderer::read_exr(scratch / "images/image.exr").width, 64);
  }
  EXPECT_EQ(scratch.listing(), "images link.exr");
}

TEST(Output, HasAsLongANameAsTheSystemTakes) {
  const ScratchDirectory scratch;
  const std::string name(255, 'x');
  EXPECT_EQ(run_plumbline(scratch.path(), kQuick + "-o " + name).exit_code, 0);
  EXPECT_EQ(scratch.listing(), name);
  EXPECT_EQ(run_plumbline(scratch.path(), kLong + name).exit_code, 2);  // and no render before
}

TEST(Output, ToTheStandardOutputIsTheImageAlone) {
  const ScratchDirectory scratch;
  for (const char* to : {">image.exr", "| cat >image.exr"}) {
    const Outcome outcome = run_plumbline(scratch.path(), kQuick + "-o /dev/stdout " + to);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(renderer::read_exr(scratch / "image.exr").width, 64) << to;
  }
  EXPECT_TRUE(std::filesystem::is_symlink("/dev/stdout"));
}

TEST(Output, NeverReplacesWhatIsReadOrAnotherOutput) {
  const ScratchDirectory scratch;
  const std::filesystem::path path = scratch.path();
  const std::string scene = R"(<scene version="3.0.0"><sensor type="perspective">
      <float name="fov" value="40"/><film type="hdrfilm"><integer name="width" value="8"/>
      <integer name="height" value="4"/><rfilter type="box"/></film>
      <sampler type="independent"><integer name="sample_count" value="3"/></sampler></sensor>
      <shape type="obj"><string name="filename" value="mesh.obj"/>
      <boolean name="face_normals" value="true"/><bsdf type="diffuse"/></shape>
      <emitter type="envmap"><string name="filename" value="map.exr"/></emitter></scene>)";
  const std::string mesh = "v 0 0 9\nv 1 0 9\nv 0 1 9\nf 1 2 3\n";
  scratch.write("scene.xml", scene);
  scratch.write("mesh.obj", mesh);
  renderer::write_exr(scratch / "map.exr", {1, 1, {{1, 1, 1}}, {}, {}, {}});
  const std::string map = scratch.read("map.exr");
  std::filesystem::create_hard_link(scratch / "scene.xml", scratch / "hard.xml");
  std::filesystem::create_symlink("scene.xml", scratch / "link.xml");
  std::filesystem::create_directory(scratch / "results");
  scratch.write("verify.json", R"({"exec": "true"})");
  ASSERT_EQ(run_plumbline(path, kQuick + "-o results/a.exr --json results/a.json").exit_code, 0);
  const std::string image = scratch.read("results/a.exr"), record = scratch.read("results/a.json");
  for (const std::string arguments :
       {"render scene.xml -o scene.xml", "render scene.xml -o ./results/../scene.xml",
        "render scene.xml -o hard.xml", "render scene.xml -o link.xml",
        "render link.xml -o scene.xml", "render scene.xml -o mesh.obj",
        "render scene.xml -o map.exr", "render scene.xml -o x.exr --json mesh.obj",
        "render scene.xml -o x.exr --json results/../x.exr",
        "render sphere_light -o x.exr --allocation lu --share-map x.exr",
        "report results -o results/a.json", "report results -o results/a.exr",
        "verify --options verify.json --json verify.json"}) {
    const Outcome outcome = run_plumbline(path, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.err;
    EXPECT_NE(outcome.err.find("is the same file as"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(scratch.read("scene.xml"), scene);
  EXPECT_EQ(scratch.read("mesh.obj"), mesh);
  EXPECT_EQ(scratch.read("map.exr"), map);
  EXPECT_EQ(scratch.read("results/a.exr"), image);
  EXPECT_EQ(scratch.read("results/a.json"), record);
  EXPECT_EQ(scratch.listing(), "hard.xml link.xml map.exr mesh.obj results scene.xml verify.json");
  // A device is no file that could be lost.
  EXPECT_EQ(run_plumbline(path, kQuick + "-o /dev/null --json /dev/null").exit_code, 0);
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
