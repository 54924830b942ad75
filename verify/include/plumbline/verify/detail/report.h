#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/detail/result.h>

namespace plumbline::verify {

/// What several checks found, and what a person does about it. One result is a report too.
///
///   GoogleTest  PLUMBLINE_EXPECT_PASS(report);                     // gtest.h
///   doctest     CHECK_MESSAGE(report.ok(), report.summary());
///   Catch2      INFO(report.summary()); CHECK(report.ok());
struct Report {
  std::vector<CheckResult> results;

  /// What is likely wrong, where one cause explains what was seen; else empty.
  std::string cause;
  std::string second_cause;  ///< where another explains it nearly as well
  CauseKind cause_kind = CauseKind::none;

  std::string replay;  ///< one command that repeats all; filled in by the suite that ran it

  Report() = default;
  Report(CheckResult result) { results.push_back(std::move(result)); }
  Report(std::vector<CheckResult> all) : results(std::move(all)) {}

  /// Everything passes that was not skipped, which a check declares (`expected` inconclusive), and
  /// that no waiver names. Any other fail is not ok, whatever was expected; nor is a report without
  /// results.
  bool ok() const;

  /// `fail` if anything fails that is not waived; `pass` if it is ok and something passes; else
  /// `inconclusive`.
  Verdict verdict() const;

  /// Every result is what its check declares, and there is one.
  bool as_expected() const;

  /// What a person acts on: how many, the likely cause, the first result of each kind that is not
  /// as it should be in full (they mostly share one cause), the names of others, how to repeat it.
  /// One line where all is well.
  std::string summary() const;

  /// Adds the results of another; its cause too, where there was none.
  void append(Report other);

  std::size_t size() const { return results.size(); }
  bool empty() const { return results.empty(); }
  auto begin() { return results.begin(); }
  auto end() { return results.end(); }
  auto begin() const { return results.begin(); }
  auto end() const { return results.end(); }
};

}  // namespace plumbline::verify
