#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/verify/detail/report.h>

/// Known failures, in place of a check that is commented out.
namespace plumbline::verify {

/// A check that is known not to pass, why that is put up with, and for how long.
struct Waiver {
  std::string check;   ///< its subject, "coat/front 80°/energy"; * stands for anything in between
  std::string reason;  ///< one sentence for a person; must not be empty
  std::chrono::year_month_day until;  ///< the last day on which it holds [UTC]
};

/// "2027-01-31". @throws std::invalid_argument for what is no day of the calendar
std::chrono::year_month_day parse_day(std::string_view text);

/// Today [UTC].
std::chrono::year_month_day today();

/// A report in which known failures count as skipped, each with the waiver's reason in
/// `CheckResult::waived`. A waiver that has expired, names no check, or names only checks that pass
/// adds a failing result of its own, "waiver/" and what it names: waivers go when they are no
/// longer needed.
///
///   PLUMBLINE_EXPECT_PASS(waive(report, {{"coat/*/energy", "multiple scattering is missing",
///                                         parse_day("2027-01-31")}}));
///
/// @param on  the day on which it is asked
/// @throws std::invalid_argument for a waiver without a check or a reason, or with a day that is
/// none
Report waive(Report report, const std::vector<Waiver>& waivers,
             std::chrono::year_month_day on = today());

}  // namespace plumbline::verify
