#pragma once

#include <optional>

#include "diagnosis/direct.h"
#include "diagnosis/observations.h"

namespace plumbline::verify {

/// What no function of the point explains: symmetries, and where samples are missing.
///
/// @param never  of never_sampled()
std::optional<Finding> explain_shape(const ReportEvidence& evidence, const Observations& density,
                                     double never);

/// All samples lie in a part of what pdf() covers, and are as much denser there.
///
/// @param never  of never_sampled()
std::optional<Finding> explain_empty_places(const Observations& density, double never);

/// Largest share of a view's pdf() that lies where no sample does.
double never_sampled(const ReportEvidence& evidence);

/// The continuous part and the atoms, each with or without the probability that is its own.
std::optional<Finding> explain_atoms(const ReportEvidence& evidence, const Observations& density);

}  // namespace plumbline::verify
