#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <plumbline/verify/result.h>

/// Verdicts as GoogleTest assertions. Header-only; needs GoogleTest and nothing else.
namespace plumbline::verify {

namespace detail {

inline std::string replay_of_running_test() {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  if (test == nullptr) return {};
  return std::string("--gtest_filter=") + test->test_suite_name() + "." + test->name();
}

inline testing::AssertionResult as_expected(const char*, CheckResult result) {
  if (result.as_expected()) return testing::AssertionSuccess();
  if (result.replay.empty()) result.replay = replay_of_running_test();
  return testing::AssertionFailure() << describe(result);
}

/// One message: what is likely wrong first, then each result that is not as expected.
inline testing::AssertionResult as_expected(const char*, const std::vector<CheckResult>& results) {
  std::size_t failed = 0;
  std::string text, cause;
  for (CheckResult r : results) {
    if (r.as_expected()) continue;
    ++failed;
    if (cause.empty()) cause = r.diagnosis;
    if (r.replay.empty()) r.replay = replay_of_running_test();
    text += describe(r);
  }
  if (failed == 0) return testing::AssertionSuccess();
  testing::AssertionResult failure = testing::AssertionFailure();
  failure << failed << " of " << results.size() << " checks did not give what they should\n";
  if (!cause.empty()) failure << "likely cause: " << cause << "\n";
  return failure << text;
}

}  // namespace detail

}  // namespace plumbline::verify

/// Holds a CheckResult, or all of a std::vector of them, against what they declare to expect.
#define EXPECT_PASS(result) EXPECT_PRED_FORMAT1(::plumbline::verify::detail::as_expected, (result))
#define ASSERT_PASS(result) ASSERT_PRED_FORMAT1(::plumbline::verify::detail::as_expected, (result))
