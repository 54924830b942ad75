#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <plumbline/reports/results.h>

namespace plumbline::reports {

/// A picture on the page, which shows it with values rounded by 0.4 % at most. Pictures of one
/// group stand side by side under one exposure.
struct PageImage {
  std::string group;  ///< "furnace_sphere"
  std::string name;   ///< "mis, power"
  int width = 0, height = 0;
  std::vector<float> rgb;  ///< 3 · width · height linear values, row by row from the top
};

struct PageInput {
  Results results;
  std::vector<PageImage> images;
  /// Closed forms of scenes by name, each one line: "furnace_sphere" → "L = Le / (1 - albedo)"
  std::map<std::string, std::string> answers;
};

/// The page as one self-contained HTML text: no file or address is fetched when it is opened.
///
/// @throws std::invalid_argument for an image whose size and data disagree
std::string make_page(const PageInput& input);

/// Writes make_page(input) to `path`. Missing parent directories are made.
///
/// @throws std::system_error where it cannot be written
void write_page(const PageInput& input, const std::filesystem::path& path);

}  // namespace plumbline::reports
