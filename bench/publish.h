#pragma once

#include <string>
#include <vector>

#include <plumbline/reports/results.h>
#include "statistics.h"

namespace plumbline::bench {

/// Prints a table or a bar and writes it into the log.
void publish(reports::ResultLog& log, const reports::Table& table);
void publish(reports::ResultLog& log, const reports::Bar& bar);

/// Writes the repetitions of a measurement, lower is better, for comparison with other nights'.
///
/// @param name  the same every night, coarse to fine: "ray_replay/cornell/render"
void keep(reports::ResultLog& log, std::string name, std::string unit,
          std::vector<double> repetitions);

/// "0.123 [0.12, 0.13]", three significant digits.
std::string text_of(const Estimate& estimate);

}  // namespace plumbline::bench
