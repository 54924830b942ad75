#include <plumbline/reports/page.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base64.h"
#include "deflate.h"
#include "files.h"
#include "page_assets.h"
#include "page_data.h"
#include "page_pixels.h"

namespace plumbline::reports {
namespace {

/// One line for each image, in the order in which the data names them.
std::string pixels_of_all(const std::vector<PageImage>& images) {
  std::string text;
  for (const PageImage& image : images) text += detail::page_pixels(image) + '\n';
  return text;
}

std::string part(std::string_view name, const PageInput& input) {
  if (name == "css") return std::string(detail::page_css);
  // Nothing that a record says can end the element that it stands in: base64 has no '<'.
  if (name == "data") return detail::base64_of(detail::deflate(detail::page_data(input)));
  if (name == "images") return pixels_of_all(input.images);
  if (name == "chart") return std::string(detail::chart_js);
  if (name == "script") return std::string(detail::page_script);
  throw std::logic_error("index.html names an unknown part: " + std::string(name));
}

}  // namespace

std::string make_page(const PageInput& input) {
  static constexpr std::string_view kOpen = "{{", kClose = "}}";
  std::string page;
  std::string_view rest = detail::page_html;
  for (;;) {
    const std::size_t open = rest.find(kOpen);
    page += rest.substr(0, open);
    if (open == std::string_view::npos) return page;
    rest.remove_prefix(open + kOpen.size());
    const std::size_t close = rest.find(kClose);
    page += part(rest.substr(0, close), input);
    rest.remove_prefix(close + kClose.size());
  }
}

void write_page(const PageInput& input, const std::filesystem::path& path) {
  const std::string page = make_page(input);
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  detail::write_file(path, page);
}

}  // namespace plumbline::reports
