#include <plumbline/renderer/scene_file/nearest_name.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace plumbline::renderer {
namespace {

/// Longer names are nobody's slip of the finger, and the distance takes time in their square.
constexpr std::size_t kLongestName = 64;

/// Insertions, deletions and substitutions that turn `a` into `b` (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, diagonal + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string name_hint(std::string_view name, const std::vector<std::string>& known) {
  if (known.empty()) return {};
  if (name.size() <= kLongestName) {
    const auto distance = [&](const std::string& other) { return edit_distance(name, other); };
    const std::string& nearest = *std::ranges::min_element(known, {}, distance);
    if (distance(nearest) <= (name.size() + 1) / 2) {
      return fmt::format("did you mean \"{}\"?", nearest);
    }
  }
  return fmt::format("supported: {}", fmt::join(known, ", "));
}

}  // namespace plumbline::renderer
