#pragma once

#include <string_view>

/// The files of reports/page/ and Chart.js, embedded when the library is built.
namespace plumbline::reports::detail {

extern const std::string_view page_html;
extern const std::string_view page_css;
extern const std::string_view page_base_js;
extern const std::string_view page_bench_js;
extern const std::string_view page_causes_js;
extern const std::string_view page_checks_js;
extern const std::string_view page_images_js;
extern const std::string_view page_plots_js;
extern const std::string_view page_stability_js;
extern const std::string_view page_main_js;
extern const std::string_view chart_js;

}  // namespace plumbline::reports::detail
