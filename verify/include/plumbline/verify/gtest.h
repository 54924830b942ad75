#pragma once

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include <plumbline/verify/detail/result.h>

/// Verdicts as GoogleTest assertions. Header-only; needs GoogleTest and nothing else.
namespace plumbline::verify {

namespace detail {

/// The command that runs this test again; its seeds are in the test's code.
inline std::string replay_of_running_test() {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  if (test == nullptr) return {};
  const std::vector<std::string> arguments = testing::internal::GetArgvs();
  std::string command = arguments.empty() ? std::string() : arguments.front() + " ";
  return command + "--gtest_filter=" + test->test_suite_name() + "." + test->name();
}

inline testing::AssertionResult as_expected(const char*, CheckResult result) {
  if (result.as_expected()) return testing::AssertionSuccess();
  if (result.replay.empty()) result.replay = replay_of_running_test();
  return testing::AssertionFailure() << describe(result);
}

/// One message: what is likely wrong, the first failing result of each kind in full (they mostly
/// share one cause), the names of the others, how to run it again.
inline testing::AssertionResult as_expected(const char*, const std::vector<CheckResult>& results) {
  std::size_t failed = 0;
  std::set<std::string> kinds;
  std::string cause, in_full, others;
  for (CheckResult r : results) {
    if (r.as_expected()) continue;
    ++failed;
    if (cause.empty()) cause = r.diagnosis;
    if (kinds.insert(r.check).second) {
      if (r.diagnosis == cause) r.diagnosis.clear();
      in_full += describe(r);
    } else {
      others += "  " + r.subject + "\n";
    }
  }
  if (failed == 0) return testing::AssertionSuccess();
  testing::AssertionResult failure = testing::AssertionFailure();
  failure << failed << " of " << results.size() << " checks did not give what they should\n";
  if (!cause.empty()) failure << "likely cause: " << cause << "\n";
  failure << in_full;
  if (!others.empty()) failure << "in the same way:\n" << others;
  return failure << "replay: " << replay_of_running_test();
}

}  // namespace detail

}  // namespace plumbline::verify

/// Holds a CheckResult, or all of a std::vector of them, against what they declare to expect.
#define EXPECT_PASS(result) EXPECT_PRED_FORMAT1(::plumbline::verify::detail::as_expected, (result))
#define ASSERT_PASS(result) ASSERT_PRED_FORMAT1(::plumbline::verify::detail::as_expected, (result))
