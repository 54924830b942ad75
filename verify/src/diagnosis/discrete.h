#pragma once

#include <optional>

#include "diagnosis/direct.h"

namespace plumbline::verify {

/// What is wrong where one of a set is chosen, from counts of its own.
std::optional<Finding> explain_discrete(const ReportEvidence& evidence);

}  // namespace plumbline::verify
