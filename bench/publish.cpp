#include "publish.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace plumbline::bench {

void publish(reports::ResultLog& log, const reports::Table& table) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::size_t width = table.columns[c].size();
    for (const auto& row : table.rows) width = std::max(width, row[c].size());
    widths.push_back(width);
  }
  const auto print = [&](const std::vector<std::string>& cells) {
    fmt::print("  {:<{}}", cells[0], widths[0]);
    for (std::size_t c = 1; c < cells.size(); ++c) fmt::print("  {:>{}}", cells[c], widths[c]);
    fmt::print("\n");
  };
  fmt::print("\n  {}\n", table.title);
  print(table.columns);
  for (const auto& row : table.rows) print(row);
  log.append(table);
}

}  // namespace plumbline::bench
