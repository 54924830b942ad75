#pragma once

#include <string>

#include <plumbline/reports/results.h>
#include "statistics.h"

namespace plumbline::bench {

/// Prints a table or a bar and writes it into the log.
void publish(reports::ResultLog& log, const reports::Table& table);
void publish(reports::ResultLog& log, const reports::Bar& bar);

/// "0.123 [0.12, 0.13]", three significant digits.
std::string text_of(const Estimate& estimate);

}  // namespace plumbline::bench
