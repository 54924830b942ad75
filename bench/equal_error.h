#pragma once

#include <string>
#include <vector>

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// Error times time of everyday renders of Veach's plates and the Cornell box, at 64 samples per
/// pixel: luminance relMSE × seconds of `mis` with Owen-scrambled Sobol' points. As bars by the
/// wall clock on two threads, and as a table by the CPU time of one thread, with adaptive counts,
/// and beside other renderers, all in turn: what they take for the same error. Without `full` at a
/// quarter of the resolution each way, with the time scaled to all pixels: an indication.
///
/// @param peers  commands as Peer takes them; none: pbrt-v4 is quoted
/// @throws std::invalid_argument for such a command before anything is measured;
///         std::runtime_error for peers that failed, once all else is in the log
void measure_equal_error(reports::ResultLog& log, const std::vector<std::string>& peers, bool full);

}  // namespace plumbline::bench
