#include "history_text.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace plumbline::tools {
namespace {

using reports::History;
using reports::HistoryPart;
using reports::HistoryRun;
using reports::PartStatus;

constexpr std::size_t kShownChecks = 20;  // a job's page is read from the top

std::string short_commit(const reports::RunEnvironment& environment) {
  return environment.commit.substr(0, 12) + (environment.dirty ? "-dirty" : "");
}

std::string duration(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  const auto minutes = static_cast<long>(seconds / 60);
  if (minutes < 60) return fmt::format("{} min", minutes);
  return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

/// "3 passed, 1 failed"
std::string parts_text(const HistoryRun& run) {
  std::string text;
  for (const PartStatus status :
       {PartStatus::passed, PartStatus::failed, PartStatus::timed_out, PartStatus::skipped}) {
    const auto count = std::count_if(run.parts.begin(), run.parts.end(),
                                     [&](const HistoryPart& p) { return p.status == status; });
    if (count == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, reports::to_string(status));
  }
  return text.empty() ? "no parts" : text;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// A cell of a Markdown table: one line, in which a bar ends the cell.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '<') escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

struct SeedTally {
  std::size_t runs = 0, failing = 0;
};

SeedTally tally(const std::vector<reports::SeedRun>& runs) {
  SeedTally sum;
  for (const reports::SeedRun& run : runs) {
    ++sum.runs;
    if (!run.failures.empty()) ++sum.failing;
  }
  return sum;
}

SeedTally tally_of_all(const History& history) {
  SeedTally sum;
  for (const HistoryRun& run : history.runs()) {
    const SeedTally one = tally(run.seed_runs);
    sum.runs += one.runs;
    sum.failing += one.failing;
  }
  return sum;
}

std::string seeds_markdown(const History& history, const HistoryRun& run) {
  const SeedTally night = tally(run.seed_runs), all = tally_of_all(history);
  std::string text = fmt::format(
      "\n## The gate with fresh seeds\n\n{} of {} runs failed this time; {} of {} in this "
      "history.\n",
      night.failing, night.runs, all.failing, all.runs);
  for (const reports::SeedRun& seed_run : run.seed_runs) {
    for (const std::string& failure : seed_run.failures) {
      text += fmt::format("- seed {}: {}\n", seed_run.seed, cell(failure));
    }
  }
  return text;
}

std::string checks_markdown(const History& history, std::int64_t id) {
  const reports::CheckCounts counts = history.count_checks(id);
  std::string text =
      fmt::format("\n## Checks\n\n{} of {} checks did not give their expected verdict.\n",
                  counts.unexpected, counts.checks);
  const std::vector<verify::CheckResult> unexpected = history.unexpected_checks(id);
  for (std::size_t i = 0; i < std::min(unexpected.size(), kShownChecks); ++i) {
    const verify::CheckResult& check = unexpected[i];
    text += fmt::format("\n**{}**: {}, expected {}. {}\n", cell(check.subject),
                        verify::to_string(check.verdict), verify::to_string(check.expected),
                        cell(check.reason));
    if (!check.replay.empty()) text += fmt::format("```sh\n{}\n```\n", check.replay);
  }
  if (unexpected.size() > kShownChecks) {
    text += fmt::format("\n{} more.\n", unexpected.size() - kShownChecks);
  }
  return text;
}

std::string environment_line(const HistoryRun& run) {
  return fmt::format("commit {}, sources {}, seed {}; {}; {}", short_commit(run.environment),
                     run.sources, run.seed, reports::comparable_key(run.environment),
                     run.environment.system);
}

}  // namespace

std::string history_list(const History& history) {
  std::string text =
      fmt::format("{:>5}  {:<20}  {:<8}  {:<18}  {:>7}  {:>10}  {:>9}  {}\n", "run", "time", "kind",
                  "commit", "checks", "unexpected", "gate runs", "parts");
  for (const HistoryRun& run : history.runs()) {
    const reports::CheckCounts counts = history.count_checks(run.id);
    text += fmt::format("{:>5}  {:<20}  {:<8}  {:<18}  {:>7}  {:>10}  {:>9}  {}\n", run.id,
                        run.environment.time, run.kind, short_commit(run.environment),
                        counts.checks, counts.unexpected, run.seed_runs.size(), parts_text(run));
  }
  return text;
}

std::string history_show(const History& history, std::int64_t id) {
  const HistoryRun run = history.run(id);
  const reports::CheckCounts counts = history.count_checks(id);
  std::string text = fmt::format("run {}, {}, {}\n{}\n", id, run.kind, run.environment.time,
                                 environment_line(run));
  for (const HistoryPart& part : run.parts) {
    text += fmt::format("  {:<24} {:<10} {:>10}  {}\n", part.name, reports::to_string(part.status),
                        duration(part.seconds), part.note);
  }
  text += fmt::format("{} checks, {} not as expected\n", counts.checks, counts.unexpected);
  for (const verify::CheckResult& check : history.unexpected_checks(id)) {
    text += fmt::format("  {}: {}, expected {}\n", check.subject, verify::to_string(check.verdict),
                        verify::to_string(check.expected));
  }
  for (const reports::SeedRun& seed_run : run.seed_runs) {
    text += fmt::format("gate with seed {}: {} tests, {} failed\n", seed_run.seed, seed_run.tests,
                        seed_run.failures.size());
  }
  for (const reports::Distribution& d : history.distributions(id)) {
    const auto [least, most] = std::minmax_element(d.values.begin(), d.values.end());
    text += fmt::format("  {:<56} median {:.5g} of {}, {:.5g} to {:.5g} {}\n", d.name,
                        median(d.values), d.values.size(), *least, *most, d.unit);
  }
  for (const reports::Counter& c : history.counters(id)) {
    text += fmt::format("  {:<56} {} {}\n", c.name, c.value, c.unit);
  }
  return text;
}

std::string history_summary(const History& history, std::int64_t id) {
  const HistoryRun run = history.run(id);
  std::string text = fmt::format("# Plumbline, {}: {}\n\n{}\n", run.environment.time,
                                 parts_text(run), cell(environment_line(run)));
  text += "\n| part | status | took | |\n|---|---|---|---|\n";
  for (const HistoryPart& part : run.parts) {
    const bool good = part.status == PartStatus::passed || part.status == PartStatus::skipped;
    const std::string_view status = reports::to_string(part.status);
    text += fmt::format("| {} | {} | {} | {} |\n", cell(part.name),
                        good ? std::string(status) : fmt::format("**{}**", status),
                        duration(part.seconds), cell(part.note));
  }
  return text + checks_markdown(history, id) + seeds_markdown(history, run);
}

}  // namespace plumbline::tools
