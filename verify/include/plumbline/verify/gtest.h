#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <plumbline/verify/detail/report.h>

/// Reports as GoogleTest assertions. Header-only; needs GoogleTest and nothing else.
namespace plumbline::verify::detail {

/// The command that runs this test again; its seeds are in the test's code.
inline std::string replay_of_running_test() {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  if (test == nullptr) return {};
  const std::vector<std::string> arguments = testing::internal::GetArgvs();
  std::string command = arguments.empty() ? std::string() : arguments.front() + " ";
  return command + "--gtest_filter=" + test->test_suite_name() + "." + test->name();
}

inline testing::AssertionResult with_summary(bool holds, const Report& report) {
  if (holds) return testing::AssertionSuccess();
  Report repeatable = report;
  if (repeatable.replay.empty()) repeatable.replay = replay_of_running_test();
  return testing::AssertionFailure() << repeatable.summary();
}

inline testing::AssertionResult passes(const char*, const Report& report) {
  return with_summary(report.ok(), report);
}

inline testing::AssertionResult gives_verdicts(const char*, const Report& report) {
  return with_summary(report.as_expected(), report);
}

}  // namespace plumbline::verify::detail

/// Everything passes, but for what a check skips and says so: `Report::ok`. Takes one CheckResult
/// too.
#define PLUMBLINE_EXPECT_PASS(report) \
  EXPECT_PRED_FORMAT1(::plumbline::verify::detail::passes, (report))
#define PLUMBLINE_ASSERT_PASS(report) \
  ASSERT_PRED_FORMAT1(::plumbline::verify::detail::passes, (report))

/// Each result has the verdict that it declares in `expected`, for code that must fail: negative
/// controls.
#define PLUMBLINE_EXPECT_VERDICTS(report) \
  EXPECT_PRED_FORMAT1(::plumbline::verify::detail::gives_verdicts, (report))
#define PLUMBLINE_ASSERT_VERDICTS(report) \
  ASSERT_PRED_FORMAT1(::plumbline::verify::detail::gives_verdicts, (report))
