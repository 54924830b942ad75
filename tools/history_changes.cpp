#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "history_text.h"

namespace plumbline::tools {
namespace {

using reports::HistoryChange;
using reports::HistoryRecord;
using reports::TrackedNumber;
using reports::TrackedSequence;

/// "3.1 % [2.2 %, 4 %] slower": in words, a sign is soon misread.
std::string size_of(const TrackedNumber& number, const HistoryChange& change) {
  if (number.counter) return fmt::format("{:.0f} to {:.0f}", change.before, change.after);
  return fmt::format("{:+.3g} % [{:+.3g} %, {:+.3g} %], {:.4g} to {:.4g} {}", 100 * change.relative,
                     100 * change.low, 100 * change.high, change.before, change.after, number.unit);
}

std::string commit_range(const HistoryChange& change) {
  return fmt::format("after {}, up to {}", change.commit_before.substr(0, 12),
                     change.commit_last.substr(0, 12));
}

std::string changes_text(const HistoryRecord& record, bool regressions) {
  std::string text;
  for (const TrackedNumber& number : record.numbers) {
    for (const HistoryChange& change : number.changes) {
      if (change.regression != regressions) continue;
      text += fmt::format("- {}: {}, {} {}, {}\n", number.name, size_of(number, change),
                          change.drift ? "drift from" : "since",
                          record.nights[change.first_night].time, commit_range(change));
    }
  }
  return text;
}

std::string section(const char* title, const std::string& lines) {
  return lines.empty() ? "" : fmt::format("\n### {}\n\n{}", title, lines);
}

/// How far the bounds of the means have come, as shares of what a pass allows.
std::string bounds_text(const HistoryRecord& record) {
  std::vector<double> shares;
  std::uint64_t nights = 0;
  for (const TrackedSequence& sequence : record.sequences) {
    nights = std::max(nights, sequence.nights);
    const auto last = std::find_if(sequence.bound.rbegin(), sequence.bound.rend(),
                                   [](double b) { return std::isfinite(b); });
    if (last == sequence.bound.rend() || sequence.tolerance.value_or(0) <= 0) continue;
    shares.push_back(*last / *sequence.tolerance);
  }
  std::string text =
      fmt::format("\n{} checks are followed over up to {} nights with the same code.",
                  record.sequences.size(), nights);
  if (!shares.empty()) {
    const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
    std::nth_element(shares.begin(), middle, shares.end());
    text +=
        fmt::format(" Of {} means the proven bound of |bias| is {:.2g} of the tolerance (median).",
                    shares.size(), *middle);
  }
  return text + "\n";
}

std::string refuted_text(const HistoryRecord& record) {
  std::string text;
  for (const TrackedSequence& sequence : record.sequences) {
    if (sequence.verdict != verify::Verdict::fail) continue;
    text += fmt::format("- {} ({}, {} nights): {}\n", sequence.subject,
                        verify::to_string(sequence.check), sequence.nights, sequence.reason);
  }
  return text;
}

std::string seeds_text(const HistoryRecord& record) {
  std::uint64_t runs = 0;
  for (const reports::HistoryNight& night : record.nights) runs += night.gate_runs;
  std::string text = fmt::format("\n{} of {} runs of the gate with fresh seeds failed.\n",
                                 record.failing_gate_runs.size(), runs);
  for (const reports::SeedRun& run : record.failing_gate_runs) {
    text += fmt::format("- seed {}, {}: {}\n", run.seed, run.commit, fmt::join(run.failures, ", "));
  }
  return text;
}

}  // namespace

std::string history_changes(const HistoryRecord& record) {
  const std::string worse = changes_text(record, true), better = changes_text(record, false);
  std::string text =
      fmt::format("## Over all {} runs, {} by now\n\n{}\n\n{} numbers are followed; {}.\n",
                  record.kind, record.nights.size(), record.machine, record.numbers.size(),
                  worse.empty() && better.empty() ? "none has changed" : "these have changed");
  text += section("Worse", worse) + section("Better", better);
  text += bounds_text(record) + section("Refuted over the nights", refuted_text(record));
  return text + seeds_text(record);
}

}  // namespace plumbline::tools
