#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <filesystem>
#include <string>

#include <plumbline/reports/render_record.h>
#include <plumbline/reports/results.h>

#include "command_line.h"

/// The exit code of `plumbline report` is the verdict of a whole run.
namespace plumbline::tests {
namespace {

verify::CheckResult passed(int number) {
  verify::CheckResult result;
  result.kind = verify::CheckKind::mean;
  result.subject = "budget/" + std::to_string(number);
  result.verdict = verify::Verdict::pass;
  return result;
}

TEST(ReportCommand, RefusesMoreChecksThanTheErrorBudgetIsSplitOver) {
  const ScratchDirectory scratch;
  reports::ResultLog log(scratch / "results", "checks");
  for (int i = 0; i < 3; ++i) log.append(passed(i));
  EXPECT_EQ(run_plumbline(scratch.path(), "report results -o page.html").exit_code, 0);
  EXPECT_EQ(run_plumbline(scratch.path(), "report results -o page.html --max-checks 3").exit_code,
            0);
  const Outcome outcome =
      run_plumbline(scratch.path(), "report results -o page.html --max-checks 2");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("3 checks, but the error budget is split over 2"), std::string::npos)
      << outcome.err;
}

TEST(ReportCommand, WarnsOfWhatCannotBeReadAndMakesThePage) {
  const ScratchDirectory scratch;
  reports::ResultLog(scratch / "results", "checks").append(passed(0));
  std::filesystem::create_symlink("loop.json", scratch / "results/loop.json");
  std::filesystem::create_symlink("loop.exr", scratch / "results/loop.exr");
  scratch.write("results/torn.json", "{");
  scratch.write("results/lacking.json", R"({"format":"plumbline.render/1"})");
  reports::RenderRecord render;
  for (const char* image : {"loop.exr", "missing.exr", "torn.json"}) {
    render.image = image;
    scratch.write(std::string("results/of_") + image + ".json", reports::to_json(render));
  }
  const Outcome outcome = run_plumbline(scratch.path(), "report results -o page.html");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_FALSE(scratch.read("page.html").empty());
  EXPECT_NE(outcome.out.find("1 checks: 1 passed"), std::string::npos) << outcome.out;
  for (const char* lost :
       {"results/loop.json: ", "results/torn.json: not JSON", "results/lacking.json: field",
        "results/loop.exr: ", "results/missing.exr: "}) {
    EXPECT_NE(outcome.err.find(std::string("warning: ") + lost), std::string::npos) << lost << "\n"
                                                                                    << outcome.err;
  }
}

}  // namespace
}  // namespace plumbline::tests
