#pragma once

#include <string>

#include <plumbline/reports/figure.h>

namespace plumbline::tests {

/// Notes a figure for the page, if results are asked for ($PLUMBLINE_RESULTS), in
/// figures_LOG.jsonl: the page shows logs by name, whatever the order in which tests ran. A test
/// fails where the figure is not read back as it was written.
///
/// @throws reports::FormatError where its series do not fit
void publish(const reports::Figure& figure, const std::string& log);

}  // namespace plumbline::tests
