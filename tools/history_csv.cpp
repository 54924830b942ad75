#include <fmt/core.h>
#include <fmt/format.h>

#include <functional>
#include <optional>
#include <stdexcept>
#include <utility>

#include "history_text.h"

namespace plumbline::tools {
namespace {

using reports::History;
using reports::HistoryRun;

using Row = std::vector<std::string>;
using AddRow = std::function<void(const Row&)>;

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

/// Shortest text that is read back as the same number.
std::string number(double value) { return fmt::format("{}", value); }

std::string number(const std::optional<double>& value) { return value ? number(*value) : ""; }

std::string word(std::string_view text) { return std::string(text); }

void add_parts(const History&, const HistoryRun& run, const AddRow& add) {
  for (const reports::HistoryPart& p : run.parts) {
    add({p.name, word(reports::to_string(p.status)), number(p.seconds), p.note});
  }
}

void add_seed_runs(const History&, const HistoryRun& run, const AddRow& add) {
  for (const reports::SeedRun& s : run.seed_runs) {
    add({std::to_string(s.seed), std::to_string(s.tests), std::to_string(s.failures.size()),
         fmt::format("{}", fmt::join(s.failures, "; "))});
  }
}

void add_checks(const History& history, const HistoryRun& run, const AddRow& add) {
  for (const verify::CheckResult& c : history.checks(run.id)) {
    add({word(verify::to_string(c.kind)), c.subject, word(verify::to_string(c.verdict)),
         word(verify::to_string(c.expected)), number(c.estimate), number(c.reference),
         number(c.figure(verify::Figure::standard_error)), number(c.bound), number(c.p_value),
         std::to_string(c.samples), number(c.seconds)});
  }
}

void add_distributions(const History& history, const HistoryRun& run, const AddRow& add) {
  for (const reports::Distribution& d : history.distributions(run.id)) {
    for (const double value : d.values) {
      add({d.name, d.unit, d.lower_is_better ? "lower" : "higher", number(value)});
    }
  }
}

void add_counters(const History& history, const HistoryRun& run, const AddRow& add) {
  for (const reports::Counter& c : history.counters(run.id)) {
    add({c.name, c.unit, std::to_string(c.value)});
  }
}

struct CsvTable {
  std::string name;
  Row columns;
  std::function<void(const History&, const HistoryRun&, const AddRow&)> add;
};

const std::vector<CsvTable>& csv_tables() {
  static const std::vector<CsvTable> tables{
      {"distributions", {"name", "unit", "better", "value"}, add_distributions},
      {"counters", {"name", "unit", "value"}, add_counters},
      {"checks",
       {"check", "subject", "verdict", "expected", "estimate", "reference", "standard_error",
        "bound", "p_value", "samples", "seconds"},
       add_checks},
      {"parts", {"part", "status", "seconds", "note"}, add_parts},
      {"gate-runs", {"seed_of_gate", "tests", "failed", "failures"}, add_seed_runs}};
  return tables;
}

void append_row(std::string& text, const Row& front, const Row& cells) {
  const char* separator = "";
  for (const Row* row : {&front, &cells}) {
    for (const std::string& c : *row) {
      text += std::exchange(separator, ",");
      text += csv_cell(c);
    }
  }
  text += "\r\n";
}

}  // namespace

std::vector<std::string> history_tables() {
  std::vector<std::string> names;
  for (const CsvTable& table : csv_tables()) names.push_back(table.name);
  return names;
}

std::string history_csv(const History& history, std::string_view name) {
  for (const CsvTable& table : csv_tables()) {
    if (table.name != name) continue;
    std::string text;
    append_row(text, {"run", "time", "kind", "commit", "sources", "machine"}, table.columns);
    for (const HistoryRun& run : history.runs()) {
      const Row front{
          std::to_string(run.id), run.environment.time, run.kind,
          run.environment.commit, run.sources,          reports::comparable_key(run.environment)};
      table.add(history, run, [&](const Row& cells) { append_row(text, front, cells); });
    }
    return text;
  }
  throw std::invalid_argument("no table is named " + std::string(name));
}

}  // namespace plumbline::tools
