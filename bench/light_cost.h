#pragma once

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// What light samples cost a path: rays and CPU time per path with them (`mis`) and without
/// (`bsdf`), in turn on one thread.
void measure_light_cost(reports::ResultLog& log, bool full);

}  // namespace plumbline::bench
