#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <string>
#include <vector>

#include "command_line.h"

namespace plumbline::tests {
namespace {

TEST(Help, ShowsExamplesOfEveryCommand) {
  const ScratchDirectory scratch;
  for (const char* arguments :
       {"--help", "list --help", "render --help", "compare --help", "calibrate --help",
        "check --help", "report --help", "verify --help", "history --help", "merge --help"}) {
    const Outcome outcome = run_plumbline(scratch.path(), arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments;
    EXPECT_NE(outcome.out.find("Example"), std::string::npos) << arguments;
    EXPECT_EQ(outcome.err, "") << arguments;
  }
}

TEST(Calibrate, PrintsATableAndItsExitCodeSaysWhetherAllIsAsPromised) {
  const ScratchDirectory scratch;
  const Outcome outcome =
      run_plumbline(scratch.path(), "calibrate --only \"same code\" --results results");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("share of runs that claim a difference"), std::string::npos);
  EXPECT_NE(outcome.out.find("agreement, same seed"), std::string::npos);
  EXPECT_NE(scratch.read("results/calibration.jsonl").find("calibration/same code twice/"),
            std::string::npos);
}

TEST(List, ShowsEachSceneWithItsAnswerAndParameters) {
  const ScratchDirectory scratch;
  const Outcome outcome = run_plumbline(scratch.path(), "list scenes");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("furnace_open"), std::string::npos);
  EXPECT_NE(outcome.out.find("L = albedo * Le"), std::string::npos);
  EXPECT_NE(outcome.out.find("-D albedo=0.9,0.75,0.4"), std::string::npos);
}

TEST(List, NamesAreForScripts) {
  const ScratchDirectory scratch;
  EXPECT_EQ(run_plumbline(scratch.path(), "list heuristics --names").out,
            "balance\npower\ncutoff\nmaximum\n");
  EXPECT_EQ(run_plumbline(scratch.path(), "list shapes --names").out,
            "sphere\nrectangle\ndisk\nobj\n");
}

TEST(List, WithoutATopicShowsAll) {
  const ScratchDirectory scratch;
  const std::string out = run_plumbline(scratch.path(), "list").out;
  for (const char* name : {"furnace_cube", "one-sample", "balance", "diffuse", "constant"}) {
    EXPECT_NE(out.find(name), std::string::npos) << name;
  }
}

TEST(Check, ListsAllThatIsInTheWay) {
  const ScratchDirectory scratch;
  scratch.write("scene.xml",
                "<scene version=\"3.0.0\">\n<shap/>\n<integrator type=\"bdpt\"/></scene>");
  const Outcome outcome = run_plumbline(scratch.path(), "check scene.xml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out,
            "scene.xml:1: the scene has no <sensor>\n"
            "scene.xml:2: <scene> may not hold <shap>; did you mean \"shape\"?\n"
            "scene.xml:3: <integrator> of type \"bdpt\" is not supported: write path\n");
  EXPECT_EQ(run_plumbline(scratch.path(), "check furnace_open").exit_code, 0);
  EXPECT_EQ(run_plumbline(scratch.path(), "check furnace_open -D albedo=2").exit_code, 2);
}

struct Misuse {
  const char* arguments;
  const char* message;  ///< part of what standard error says
};

TEST(Misuse, HasExitCodeTwoAndAMessage) {
  const ScratchDirectory scratch;
  scratch.write("scene.xml", "<scene version=\"3.0.0\">\n<shap/></scene>");
  scratch.write("text.exr", "not an image");
  const std::vector<Misuse> cases = {
      {"", "A subcommand is required"},
      {"rendr", R"(there is no command "rendr"; did you mean "render"?)"},
      {"--frobnicate", R"(there is no command "--frobnicate"; supported: list)"},
      {"list planets", "planets"},
      {"calibrate --only planets", "--only planets: no experiment has that in its name"},
      {"calibrate --results scene.xml/x", "scene.xml"},
      {"render furnace_open", "--output is required"},
      {"render -o x.exr", "scene is required"},
      {"render furnace_opne -o x.exr",
       R"(furnace_opne: neither a scene file nor a known scene; did you mean "furnace_open"?)"},
      {"render missing.xml -o x.exr", "missing.xml: there is no such file"},
      {"render scene.xml -o x.exr",
       R"(scene.xml:2: <scene> may not hold <shap>; did you mean "shape"?)"},
      {"render furnace_open -o x.exr --strategy mys",
       R"(--strategy mys: there is no such strategy; did you mean "mis"?)"},
      {"render furnace_open -o x.exr --heuristic geometric",
       "--heuristic geometric: there is no such heuristic; supported: balance, power"},
      {"render furnace_open -o x.exr --sampler sobel",
       R"(--sampler sobel: there is no such sampler; did you mean "sobol"?)"},
      {"render furnace_open -o x.exr --backend gpu",
       "--backend gpu: there is no such backend; supported: batched, scalar"},
      {"render furnace_open -o x.exr --accelerator gpu",
       "--accelerator gpu: there is no such accelerator; supported: auto, embree, brute_force"},
      {"render furnace_open -o x.exr --light-selection brightness",
       "--light-selection brightness: there is no such selection; supported: uniform, area, power"},
      {"render furnace_open -o x.exr --replicates 2", "--replicates belongs to --sampler sobol"},
      {"render furnace_open -o x.exr --sampler sobol --replicates 1 --error 0.1",
       "an error limit needs at least 2 replicates"},
      {"render furnace_open -o x.exr --adaptive --spp 16",
       "--adaptive: 16 samples per pixel are the pilot's 16, or fewer: give it a larger --spp"},
      {"render furnace_open -o x.exr --adaptive --sampler sobol --replicates 32 --spp 32",
       "are the pilot's 32, or fewer"},
      {"render furnace_open -o x.exr --adaptive --spp 32 --shard 1/2 --checkpoint x", "excludes"},
      {"render furnace_open -o x.exr --adaptive --spp 32 --first-sample 32", "excludes"},
      {"render sphere_light -o x.exr --adaptive --allocation lu", "excludes"},
      {"render furnace_open -o x.exr --allocation root-v3",
       R"(--allocation root-v3: there is no such policy; did you mean "root-v1"?)"},
      {"render sphere_light -o x.exr --allocation lu --strategy mis", "excludes"},
      {"render sphere_light -o x.exr --allocation lu --error 0.1", "excludes"},
      {"render sphere_light -o x.exr --iterations 3", "requires"},
      {"render sphere_light -o x.exr --allocation cost-aware", "needs --cost-ratio"},
      {"render sphere_light -o x.exr --allocation lu --spp 39",
       "needs two samples per pixel in every iteration"},
      {"render sphere_light -o x.exr --allocation lu --share-limit 0.6", "must lie in (0, 0.5]"},
      {"render furnace_open -o x.exr --allocation lu", "set the maximum depth to 2"},
      {"render sphere_light -o x.exr --allocation lu --share-map missing/x.exr",
       "there is no directory missing"},
      {"render furnace_open -o x.exr --spp 0", "0 is not a whole number from 1"},
      {"render furnace_open -o x.exr --spp 1.5", "1.5 is not a whole number"},
      {"render furnace_open -o x.exr --spp 99999999999", "is not a whole number from 1"},
      {"render furnace_open -o x.exr --seed -1", "-1 is not a whole number from 0"},
      {"render furnace_open -o x.exr --seconds nan", "nan is not a positive number"},
      {"render furnace_open -o x.exr --seconds 0", "0 is not a positive number"},
      {"render furnace_open -o x.exr --error inf", "inf is not a positive number"},
      {"render furnace_open -o x.exr --max-depth -2", "-2 is not a whole number from -1"},
      {"render furnace_open -o x.exr --threads 0", "0 is not a whole number from 1 to 1024"},
      {"render furnace_open -o x.exr --size 64", "--size 64: must read WIDTHxHEIGHT"},
      {"render furnace_open -o x.exr --size 0x64", "a film of 0x64 is not supported"},
      {"render furnace_open -o x.exr --size 99999x99999", "a film of 99999x99999"},
      {"render furnace_open -o x.exr -D albedo", "-D albedo: must read name=value"},
      {"render furnace_open -o x.exr -D albdo=1", R"(did you mean "albedo"?)"},
      {"render furnace_open -o x.exr -D albedo=1 -D albedo=0", "albedo is set twice"},
      {"render furnace_open -o x.exr -D albedo=2", "must lie between 0 and 1"},
      {"render furnace_open -o .", ".: is a directory"},
      {"render furnace_open -o missing/x.exr", "there is no directory missing"},
      {"render furnace_open -o x.exr --json missing/x.json", "there is no directory missing"},
      {"compare missing.exr --scene furnace_open", "missing.exr: no such image"},
      {"compare text.exr --scene furnace_open", "text.exr: "},
      {"compare text.exr", "either two images, or one image and --scene"},
      {"compare text.exr text.exr --scene furnace_open", "either two images, or one"},
      {"compare text.exr text.exr -D a=1", "belong to --scene"},
      {"compare text.exr --scene furnace_open --exact", "--exact compares two images"},
      {"compare text.exr --scene furnac_open", R"(did you mean "furnace_open"?)"},
      {"compare text.exr --scene furnace_open --tolerance -1", "-1 is not a positive number"},
      {"report missing -o page.html", "missing"},
  };
  for (const Misuse& misuse : cases) {
    const Outcome outcome = run_plumbline(scratch.path(), misuse.arguments);
    EXPECT_EQ(outcome.exit_code, 2) << misuse.arguments << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(misuse.message), std::string::npos) << misuse.arguments << "\n"
                                                                   << outcome.err;
  }
  EXPECT_EQ(scratch.listing(), "scene.xml text.exr");
}

}  // namespace
}  // namespace plumbline::tests
