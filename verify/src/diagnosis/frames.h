#pragma once

#include <vector>

#include "diagnosis/hypothesis.h"
#include "diagnosis/shifts.h"

namespace plumbline::verify {

/// The whole density turned around any axis: samples around one axis, the pdf around another.
void add_turned_as_a_whole(std::vector<Hypothesis>& list, const ReportEvidence& evidence,
                           const Blame& blame, const Asked& ask);

}  // namespace plumbline::verify
