#pragma once

#include <string_view>

/// The files of reports/page/ and Chart.js, embedded when the library is built.
namespace plumbline::reports::detail {

extern const std::string_view page_html;
extern const std::string_view page_css;
extern const std::string_view page_script;
extern const std::string_view chart_js;

}  // namespace plumbline::reports::detail
