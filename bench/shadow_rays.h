#pragma once

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// rtcOccluded against rtcIntersect on the same recorded shadow rays of each scene: all as
/// rendered, those that reach the light, and those that do not. Repetitions are interleaved, so
/// that a change of clock or a neighbour's load hits both.
void measure_shadow_rays(reports::ResultLog& log, bool full);

}  // namespace plumbline::bench
