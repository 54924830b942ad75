#pragma once

#include <plumbline/reports/results.h>

namespace plumbline::bench {

/// Prints a table and writes it into the log.
void publish(reports::ResultLog& log, const reports::Table& table);

}  // namespace plumbline::bench
