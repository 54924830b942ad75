#pragma once

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// Error times time of everyday renders of Veach's plates and the Cornell box, held against a tenth
/// of what pbrt-v4 reaches: luminance relMSE × seconds of `mis` with Owen-scrambled Sobol' points,
/// 64 samples per pixel, two threads. Without `full` at a quarter of the resolution each way, with
/// the time scaled to all pixels: an indication.
void measure_equal_error(reports::ResultLog& log, bool full);

}  // namespace plumbline::bench
