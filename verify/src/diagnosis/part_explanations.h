#pragma once

#include <optional>

#include "diagnosis/direct.h"
#include "diagnosis/evidence.h"

namespace plumbline::verify {

/// pdf() = Σ a q over the densities q of the parts, with a that are not the shares of the numbers
/// that choose them: where Σ a is ∫pdf, the probabilities are wrong; else parts are sampled by
/// half.
std::optional<Finding> explain_by_parts(const ReportEvidence& evidence);

/// Where several random numbers lead to one point, pdf() is the density that one of them brings.
std::optional<Finding> explain_by_branches(const ReportEvidence& evidence);

}  // namespace plumbline::verify
