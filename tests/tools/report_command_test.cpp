#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <string>

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

}  // namespace
}  // namespace plumbline::tests
