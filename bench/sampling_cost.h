#pragma once

#include <filesystem>

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// Nanoseconds of every function that Google Benchmark knows of here: a table into the log, and
/// its own JSON into `results`/sampling_cost.json.
void measure_sampling_cost(reports::ResultLog& log, const std::filesystem::path& results,
                           bool full);

}  // namespace plumbline::bench
