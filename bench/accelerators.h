#pragma once

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// Sixteen rays at a time against all primitives, beside Embree's tree: rays of scenes with more
/// and more primitives, which says up to how many it is faster (kMostForBruteForce), and whole
/// renders. CPU time on one thread, both in turn.
void measure_accelerators(reports::ResultLog& log, bool full);

}  // namespace plumbline::bench
