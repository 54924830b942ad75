#include "publish.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
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

void publish(reports::ResultLog& log, const reports::Bar& bar) {
  fmt::print("  {}: {:.4g} [{:.4g}, {:.4g}] {}, bar {} {:.4g}: {}\n    {}\n", bar.name,
             bar.measured, bar.low, bar.high, bar.unit, bar.at_least ? "≥" : "≤", bar.limit,
             verdict(bar), bar.note);
  if (!bar.comparison.empty()) fmt::print("    {}\n", bar.comparison);
  log.append(bar);
}

void keep(reports::ResultLog& log, std::string name, std::string unit,
          std::vector<double> repetitions) {
  log.append(reports::Distribution{std::move(name), std::move(unit), true, std::move(repetitions)});
}

std::string text_of(const Estimate& e) {
  return fmt::format("{:.3g} [{:.3g}, {:.3g}]", e.value, e.low, e.high);
}

}  // namespace plumbline::bench
