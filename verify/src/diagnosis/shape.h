#pragma once

#include <optional>

#include "diagnosis/direct.h"
#include "diagnosis/observations.h"

namespace plumbline::verify {

/// What no function of the point explains: symmetries, and where samples are missing.
std::optional<Finding> explain_shape(const ReportEvidence& evidence, const Observations& density);

/// Largest share of a view's pdf() that lies where no sample does.
double never_sampled(const ReportEvidence& evidence);

/// The continuous part and the atoms, each with or without the probability that is its own.
std::optional<Finding> explain_atoms(const ReportEvidence& evidence, const Observations& density);

}  // namespace plumbline::verify
