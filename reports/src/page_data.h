#pragma once

#include <string>

#include <plumbline/reports/page.h>

namespace plumbline::reports::detail {

/// Everything the page shows but the pixels of its images, as one JSON text.
std::string page_data(const PageInput& input);

}  // namespace plumbline::reports::detail
