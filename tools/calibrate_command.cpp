#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <plumbline/calibration/experiments.h>
#include <plumbline/output/stop.h>
#include <plumbline/reports/results.h>

#include "command.h"

namespace plumbline::tools {
namespace {

struct Arguments {
  bool full = false;
  std::uint64_t seed = 1;
  std::string only, results;
};

/// What each table shows, and what its numbers must be.
std::string heading(const std::string& table) {
  if (table == calibration::kTableNull) {
    return "p-values of correct code: share below the level tested";
  }
  if (table == calibration::kTableFalseFailures) {
    return "false failures of skewed but correct estimators: share of runs that fail";
  }
  if (table == calibration::kTableWrongPasses) {
    return "wrong passes of estimators that are off by the tolerance: share of runs that pass";
  }
  if (table == calibration::kTableDetection) {
    return "detection of errors as large as `detectable`, which promises 0.99: share of runs that "
           "fail";
  }
  if (table == calibration::kTableCoverage) {
    return "coverage: share of intervals that hold the true ratio of variances";
  }
  return "the same code twice: share of runs that claim a difference";
}

std::string range(const std::optional<double>& low, const std::optional<double>& high) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  return fmt::format("[{:.3g}, {:.3g}]", low.value_or(kUnknown), high.value_or(kUnknown));
}

void print_heading(const std::string& table) {
  fmt::print("\n{}\n{:<52} {:>8} {:>9}  {:<21} {:<19} {}\n", heading(table), "", "runs", "measured",
             "99.9 % interval", "must lie in", "verdict");
}

void print_row(const std::string& name, const verify::CheckResult& r) {
  const verify::Interval proven = r.interval.value_or(verify::Interval{});
  fmt::print("{:<52} {:>8} {:>9.4g}  {:<21} {:<19} {}{}\n", name, r.samples, r.estimate.value_or(0),
             range(proven.low, proven.high),
             range(r.figure(verify::Figure::at_least), r.figure(verify::Figure::at_most)),
             verify::to_string(r.verdict),
             r.as_expected() ? (r.expected == verify::Verdict::fail ? ", as it must" : "")
                             : ", NOT as expected");
  if (!r.as_expected()) fmt::print("    {}\n", r.reason);
  std::fflush(stdout);  // a row can take minutes
}

std::unique_ptr<reports::ResultLog> open_log(const std::string& directory) {
  if (directory.empty()) return nullptr;
  return std::make_unique<reports::ResultLog>(directory, "calibration");
}

/// The mark of a table that lacks rows, which the page shows as what is not as expected.
verify::CheckResult incomplete(int rows, int signal) {
  verify::CheckResult mark;
  mark.kind = verify::CheckKind::calibration;
  mark.subject = "calibration/incomplete";
  mark.verdict = verify::Verdict::inconclusive;
  mark.reason = fmt::format("stopped by signal {} after {} rows", signal, rows);
  return mark;
}

/// A row takes minutes at night, and knows nothing of signals: it is left where it is.
[[noreturn]] void end_incomplete(int rows, reports::ResultLog* log) {
  const int signal = output::stop_signal();
  const verify::CheckResult mark = incomplete(rows, signal);
  if (log != nullptr) log->append(mark);
  fmt::print("\nINCOMPLETE: {}\n", mark.reason);
  std::fflush(stdout);
  std::_Exit(output::exit_code_of_signal(signal));
}

int run_calibrate(const Arguments& arguments) {
  const calibration::Effort effort{arguments.full, arguments.seed};
  const std::unique_ptr<reports::ResultLog> log = open_log(arguments.results);
  const output::StopRequests stops_at_signals;
  std::string table;
  int rows = 0, unexpected = 0;
  for (const calibration::Experiment& experiment : calibration::experiments()) {
    const std::string name = experiment.table + "/" + experiment.name;
    if (name.find(arguments.only) == std::string::npos) continue;
    verify::CheckResult result;
    if (!output::finishes_before_stop([&] { result = calibration::run(experiment, effort); })) {
      end_incomplete(rows, log.get());
    }
    if (experiment.table != table) print_heading(table = experiment.table);
    print_row(experiment.name, result);
    if (log) log->append(result);
    ++rows;
    unexpected += result.as_expected() ? 0 : 1;
  }
  if (rows == 0) {
    throw std::invalid_argument("--only " + arguments.only +
                                ": no experiment has that in its name");
  }
  return unexpected == 0 ? kExitFine : kExitUnexpectedVerdict;
}

}  // namespace

void add_calibrate_command(options::CommandLine& line) {
  const auto arguments = std::make_shared<Arguments>();
  options::Command command =
      line.add_command("calibrate", "Measure what the checks claim: levels, power, coverage");
  command.add_flag("--full", arguments->full, "As many runs as at night: an hour");
  command.add("--seed", arguments->seed, "Seed of all runs").type("N");
  command.add("--only", arguments->only, "Only rows whose \"table/name\" contains this")
      .type("TEXT");
  command.add("--results", arguments->results, "Directory to add the rows to, for report")
      .type("DIR");
  command.footer(
      "Examples:\n  plumbline calibrate\n  plumbline calibrate --full --only coverage\n\nCtrl-C, "
      "TERM "
      "and HUP end it with the rows that are there and a mark that others are missing; exit code "
      "128 + signal.");
  command.runs([arguments] { return run_calibrate(*arguments); });
}

}  // namespace plumbline::tools
