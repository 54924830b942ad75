#pragma once

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// The ray-replay limit: the rays of a render, asked again of Embree alone in the same order and
/// widths. What the render takes beyond that is ours; what the replay takes is the machine's and
/// Embree's. One thread, CPU time, render and replay in turn. Then both backends against each
/// other.
void measure_ray_replay(reports::ResultLog& log, bool full);

}  // namespace plumbline::bench
