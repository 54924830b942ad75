#pragma once

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// rtcOccluded against rtcIntersect on the same recorded shadow rays of each scene, 1, 8 and 16 in
/// a call: all as rendered, those that reach the light, those that do not, and half of each.
/// Repetitions are interleaved, so that a change of clock or a neighbour's load hits both. Then
/// what light samples cost a path.
void measure_shadow_rays(reports::ResultLog& log, bool full);

}  // namespace plumbline::bench
