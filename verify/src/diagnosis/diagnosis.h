#pragma once

#include <string>

#include <plumbline/verify/detail/cause.h>

#include "diagnosis/evidence.h"

/// What is likely wrong, from everything that a report knows.
namespace plumbline::verify {

/// A cause in a sentence, and the next best where another explains as much.
struct Cause {
  CauseKind kind = CauseKind::none;
  std::string headline;  ///< empty: nothing explains all that was seen
  std::string second;    ///< empty: nothing else does
  CauseKind second_kind = CauseKind::none;
};

/// Names one cause for all views, kinds of checks and examples of a report.
///
/// A hypothesis is admissible only if every residual that it leaves, in every view and series, lies
/// within that residual's own rounding or sampling error; free numbers are fitted on half of the
/// points and frozen for the other half. Of the admissible ones the one with the fewest free
/// numbers is named; none admissible, none named. Observations that need no fit (state, samples on
/// a line, atoms with a density) come first.
Cause diagnose(const ReportEvidence& evidence);

}  // namespace plumbline::verify
