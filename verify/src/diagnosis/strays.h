#pragma once

#include <optional>

#include "diagnosis/diagnosis.h"
#include "diagnosis/observations.h"

/// Samples where the pdf is 0, and views without any sample.
namespace plumbline::verify {

/// A failing view whose samples are all rejected shows no density that anything could be a factor
/// of.
bool all_rejected(const ReportEvidence& evidence);

/// Samples where the pdf is 0, and nothing wrong where it is not: below the horizon, or beside the
/// domain with those inside thinner by just their share.
std::optional<Cause> explain_strays(const ReportEvidence& evidence, const Observations& density);

}  // namespace plumbline::verify
