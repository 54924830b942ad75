#pragma once

#include <string>

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// How time and peak memory grow with threads, samples, pixels, triangles, lights and depth, with
/// fitted exponents; the memory of a large image; the time to a first picture. Points whose memory
/// counts are measured by processes of their own: this program again, with measure_scaling_point().
void measure_scaling(reports::ResultLog& log, bool full);

/// Measures one point in this process and writes it to standard output, for measure_scaling() to
/// read.
///
/// @param point  "axis=value"
/// @throws std::invalid_argument for an axis or value that there is not
void measure_scaling_point(const std::string& point);

}  // namespace plumbline::bench
