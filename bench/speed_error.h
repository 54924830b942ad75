#pragma once

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// Speed against error: relMSE and seconds of every strategy over a doubling number of samples per
/// pixel, from independent replicates, on scenes with a closed form (exact reference) and without.
void measure_speed_against_error(reports::ResultLog& log, bool full);

}  // namespace plumbline::bench
