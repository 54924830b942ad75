#pragma once

#include <string>

#include <plumbline/reports/page.h>

namespace plumbline::reports::detail {

/// Everything the page shows as one JSON text that may stand inside a <script> element: it holds no
/// '<', so that no text in it can end the element or start a comment.
///
/// @throws std::invalid_argument for an image whose size and data disagree
std::string page_data(const PageInput& input);

}  // namespace plumbline::reports::detail
