#pragma once

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// What batches of paths gain over one path after the other: time of render() with both backends,
/// in turn on one thread.
void measure_backend_speed(reports::ResultLog& log, bool full);

}  // namespace plumbline::bench
