#pragma once

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// Speed against error: relMSE and CPU time of every strategy, heuristic and sampler, and for
/// direct light of every allocation, over a growing number of samples per pixel; 16 independent
/// replicates of each; on scenes with a closed form (exact reference) and without.
void measure_speed_against_error(reports::ResultLog& log, bool full);

}  // namespace plumbline::bench
