#include <gtest/gtest.h>
#include <plumbline_tests/exr_bytes.h>
#include <plumbline_tests/support.h>

#include <string>
#include <vector>

#include <plumbline/renderer/image_io/exr.h>

#include "command_line.h"

/// Files that ask for far more than they hold are refused, wherever one is read, before memory is
/// taken: each command runs with 100 MB of addresses.
namespace plumbline::tests {
namespace {

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these reserve all of memory
const std::string kLimit = "ulimit -v 100000;";
#else
const std::string kLimit;
#endif

void expect_refused_in_100_mb(const ScratchDirectory& scratch, const std::string& arguments,
                              const std::string& message) {
  expect_refused(scratch.path(), arguments, message, kLimit);
}

/// 131 kB that claim 12 GB, an attribute of 2 GB in 123 bytes, as much as may be claimed in a file
/// that cannot hold it, and 2 GB behind mistakes after which OpenEXR's two readers part.
std::vector<std::string> exr_bombs() {
  const ExrClaims pixels{.x1 = 65535, .y1 = 16383, .compression = 2};
  const ExrClaims most{.x1 = 8191, .y1 = 8191, .compression = 3, .channels = {"B", "G", "R"}};
  return {
      exr_header(pixels) + std::string(131072, '\1'),
      bytes_of(20000630) + bytes_of(2) +
          exr_attribute("foo", "string", std::string(100, 'a'), 0x7fffffff),
      exr_header(most) + std::string(131072, '\1'),
      text_of(source_file("tests/fuzz/inputs/image/two_gigabytes_behind_an_error.exr")),
      text_of(source_file("tests/fuzz/inputs/image/two_gigabytes_behind_a_list_of_channels.exr")),
      text_of(source_file("tests/fuzz/inputs/image/window_that_one_reader_sees.exr"))};
}

const std::string kSkyScene =
    R"(<scene version="3.0.0"><sensor type="perspective"><float name="fov" value="60"/>
    <film type="hdrfilm"><rfilter type="box"/></film></sensor>
    <emitter type="envmap"><string name="filename" value="a.exr"/></emitter></scene>)";

TEST(Budgets, ImagesThatClaimGigabytesAreRefusedByEveryCommand) {
  for (const std::string& bomb : exr_bombs()) {
    const ScratchDirectory scratch;
    scratch.write("a.exr", bomb);
    scratch.write("sky.xml", kSkyScene);
    expect_refused_in_100_mb(scratch, "compare a.exr --scene furnace_open", "a.exr: ");
    expect_refused_in_100_mb(scratch, "compare a.exr a.exr --exact", "a.exr: ");
    expect_refused_in_100_mb(scratch, "render sky.xml -o out.exr",
                             "sky.xml:3: <string name=\"filename\">: ");
  }
}

/// A results directory with a picture.
void write_results(const ScratchDirectory& scratch, const std::string& picture) {
  ASSERT_EQ(
      run_plumbline(scratch.path(), "render furnace_open -o a.exr --spp 1 --size 8x8 --json a.json")
          .exit_code,
      0);
  std::filesystem::create_directory(scratch / "results");
  for (const char* name : {"a.exr", "a.json"}) {
    std::filesystem::rename(scratch / name, scratch / "results" / name);
  }
  if (!picture.empty()) scratch.write("results/a.exr", picture);
}

TEST(Budgets, APageLeavesOutPicturesThatClaimGigabytes) {
  const ScratchDirectory scratch;
  write_results(scratch, "");
  EXPECT_EQ(run_plumbline(scratch.path(), "report results -o page.html", kLimit).exit_code, 0);
  for (const std::string& bomb : exr_bombs()) {
    scratch.write("results/a.exr", bomb);
    // Which costs the page that picture alone.
    const Outcome outcome = run_plumbline(scratch.path(), "report results -o page.html", kLimit);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_NE(outcome.err.find("results/a.exr: "), std::string::npos) << outcome.err;
  }
}

TEST(Budgets, APageRefusesRecordsThatMultiply) {
  const std::string start = R"({"format":"plumbline.check/1","values":)";
  std::string members = "{";
  for (int i = 0; i < 100000; ++i) members += "\"m" + std::to_string(i) + "\":0,";
  const std::vector<std::pair<std::string, std::string>> bombs = {
      {start + std::string(1000000, '[') + "\n", "a record of more than 100 levels"},
      {start + members + "\"z\":0}}\n", "a record of more than 1000 members in one object"},
      {std::string((16u << 20) + 1, ' ') + "\n", "a record of more than 16777216 bytes"}};
  for (const auto& [bomb, message] : bombs) {
    const ScratchDirectory scratch;
    std::filesystem::create_directory(scratch / "results");
    scratch.write("results/a.jsonl", bomb);
    expect_refused_in_100_mb(scratch, "report results -o page.html", "a.jsonl:1: " + message);
  }
  std::string zeros = start + "[0";
  for (int i = 0; i < (1 << 20); ++i) zeros += ",0";
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch / "results");
  scratch.write("results/a.json", zeros + "]}");
  const Outcome outcome = run_plumbline(scratch.path(), "report results -o page.html");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("a.json: a record of more than 1048576 values"), std::string::npos)
      << outcome.err;
}

TEST(Budgets, APageRefusesAFileLargerThanResultsAre) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch / "results");
  scratch.write("results/a.jsonl", "{}");
  std::filesystem::resize_file(scratch / "results/a.jsonl", std::uintmax_t{1} << 40);
  expect_refused_in_100_mb(scratch, "report results -o page.html",
                           "a.jsonl: has 1099511627776 bytes, more than the 268435456");
}

}  // namespace
}  // namespace plumbline::tests
