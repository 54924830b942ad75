#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <plumbline/output/output_file.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/reports/history.h>
#include <plumbline/reports/history_report.h>

#include "command.h"
#include "history_text.h"

namespace plumbline::tools {
namespace {

using reports::History;

struct HistoryArguments {
  std::string action, what, file;
  std::string table = history_tables().front();
  bool csv = false, whole = false;
  std::string kind = "nightly", sources;
  std::uint64_t seed = 0;
  std::vector<std::string> parts;
  std::string machine, json;
};

std::int64_t id_of(const std::string& text) {
  std::int64_t id = 0;
  for (const char c : text) {
    if (c < '0' || c > '9' || id > 1'000'000'000) {
      throw renderer::InputError(text + ": not the number of a run; `list` shows them");
    }
    id = 10 * id + (c - '0');
  }
  return id;
}

/// The run that the command line names, or the latest.
std::int64_t chosen_run(const History& history, const HistoryArguments& arguments) {
  if (!arguments.what.empty()) return id_of(arguments.what);
  const auto runs = history.runs();
  if (runs.empty()) throw renderer::InputError(arguments.file + ": holds no run yet");
  return runs.back().id;
}

/// "mutants=failed,12.5,3 bugs were not seen"
reports::HistoryPart part_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::size_t first = std::min(text.find(',', equals), text.size());
  const std::size_t second = std::min(text.find(',', first + 1), text.size());
  reports::HistoryPart part;
  double seconds = 0;
  char rest = 0;
  if (equals != std::string::npos && equals > 0 && first < text.size()) {
    const auto status = reports::part_status(text.substr(equals + 1, first - equals - 1));
    const std::string number = text.substr(first + 1, second - first - 1);
    if (status && std::sscanf(number.c_str(), "%lf%c", &seconds, &rest) == 1 && seconds >= 0) {
      part.name = text.substr(0, equals);
      part.status = *status;
      part.seconds = seconds;
      if (second < text.size()) part.note = text.substr(second + 1);
      return part;
    }
  }
  throw renderer::InputError("--part " + text +
                             ": not NAME=STATUS,SECONDS or NAME=STATUS,SECONDS,NOTE with the "
                             "status passed, failed, timed out or skipped");
}

/// Numbers of another build would be kept under the name of this one.
void require_this_build(const reports::Results& results, const reports::RunEnvironment& here) {
  for (const reports::RunEnvironment& made : results.environments) {
    if (made.commit == here.commit &&
        reports::comparable_key(made) == reports::comparable_key(here)) {
      continue;
    }
    throw renderer::InputError(fmt::format(
        "the results hold records of another build: commit {}, {}; clear the directory and run "
        "again",
        made.commit, reports::comparable_key(made)));
  }
}

/// A night of which no part came to a record is a run too.
reports::Results results_of(const std::string& directory) {
  if (directory.empty()) throw renderer::InputError("append: which directory of results?");
  try {
    return reports::read_results(directory);
  } catch (const reports::ResultsError&) {
    std::error_code ignored;
    if (std::filesystem::is_directory(directory, ignored)) return {};
    throw;
  }
}

/// How many samples the checks of each kind took to decide. With the gate's own seed, and no test
/// left out, they are the same at every run of the same code.
void count_samples(reports::Results& results) {
  std::map<std::string, std::uint64_t> samples;
  for (const verify::CheckResult& check : results.checks) {
    samples[std::string(verify::to_string(check.kind))] += check.samples;
  }
  for (const auto& [kind, count] : samples) {
    results.counters.push_back({fmt::format("gate/{}/samples", kind), "samples", count});
  }
}

int append_run(const HistoryArguments& arguments) {
  reports::Results results = results_of(arguments.what);
  reports::HistoryRun run;
  run.kind = arguments.kind;
  run.seed = arguments.seed;
  run.sources = arguments.sources;
  run.environment = reports::current_environment();
  require_this_build(results, run.environment);
  // Of a part that was ended in the middle of a line: what it had written counts.
  for (const reports::ReadWarning& warning : results.warnings) {
    output::tell(
        fmt::format("plumbline: {}:{}: {}\n", warning.file.string(), warning.line, warning.what));
  }
  for (const std::string& part : arguments.parts) run.parts.push_back(part_of(part));
  run.seed_runs = std::move(results.seed_runs);
  if (arguments.whole && arguments.seed == 0) count_samples(results);
  History history(arguments.file, History::Access::append);
  const std::int64_t id = history.append(
      run,
      {std::move(results.checks), std::move(results.distributions), std::move(results.counters)});
  fmt::print("{}: run {}\n", arguments.file, id);
  return kExitFine;
}

/// The machine that the command line names, or that of the latest run of the kind.
std::string chosen_machine(const History& history, const HistoryArguments& arguments) {
  const auto runs = history.runs({.kind = arguments.kind, .comparable = {}});
  if (runs.empty()) {
    throw renderer::InputError(
        fmt::format("{}: holds no run of the kind \"{}\" yet", arguments.file, arguments.kind));
  }
  if (arguments.machine.empty()) return reports::comparable_key(runs.back().environment);
  for (const reports::HistoryRun& run : runs) {
    if (reports::comparable_key(run.environment) == arguments.machine) return arguments.machine;
  }
  throw renderer::InputError(
      fmt::format("--machine {}: none of the runs; export shows theirs", arguments.machine));
}

int report_runs(const History& history, const HistoryArguments& arguments) {
  const reports::HistoryRecord record =
      reports::judge_runs(history, chosen_machine(history, arguments), arguments.kind);
  fmt::print("{}", history_changes(record));
  if (!arguments.json.empty()) {
    output::Files files;
    files.reads(arguments.file);
    output::OutputFile& file = files.writes("--json", arguments.json);
    file.fill([&](const auto& path) { write_history(path, record); });
    files.finish();
  }
  const bool refuted = std::any_of(
      record.sequences.begin(), record.sequences.end(),
      [](const reports::TrackedSequence& s) { return s.verdict == verify::Verdict::fail; });
  return refuted ? kExitUnexpectedVerdict : kExitFine;
}

int run_history(const HistoryArguments& arguments) {
  try {
    if (arguments.action == "append") return append_run(arguments);
    const History history(arguments.file, History::Access::read);
    if (arguments.action == "report") return report_runs(history, arguments);
    if (arguments.action == "list") {
      fmt::print("{}", history_list(history));
    } else if (arguments.action == "show") {
      fmt::print("{}", history_show(history, chosen_run(history, arguments)));
    } else if (arguments.action == "summary") {
      fmt::print("{}", history_summary(history, chosen_run(history, arguments)));
    } else if (!arguments.csv) {
      throw renderer::InputError("export: in which form? --csv");
    } else {
      fmt::print("{}", history_csv(history, arguments.table));
    }
    return kExitFine;
  } catch (const reports::HistoryError& error) {
    throw renderer::InputError(error.what());
  } catch (const reports::ResultsError& error) {
    throw renderer::InputError(error.what());
  }
}

}  // namespace

void add_history_command(options::CommandLine& line) {
  const auto arguments = std::make_shared<HistoryArguments>();
  options::Command command =
      line.add_command("history", "The runs of nights and of CI, kept in one file");
  command
      .add(
          "action", arguments->action,
          "list: all runs; show: one; summary: one, in Markdown; export: a table of all runs; "
          "report: what all show together, in Markdown; append: add what a results directory holds")
      .one_of({"list", "show", "summary", "export", "report", "append"})
      .required()
      .type("");
  command
      .add("what", arguments->what,
           "show, summary: number of a run, the latest without it; append: the directory")
      .type("");
  command.add("--history", arguments->file, "The SQLite file").required().type("FILE");
  command.add_flag("--csv", arguments->csv, "export: comma-separated values");
  command.add("--table", arguments->table, "export: which values")
      .one_of(history_tables())
      .shows_default();
  command.add("--kind", arguments->kind, "append: what ran; report: which runs")
      .one_of({"nightly", "test"})
      .shows_default();
  command.add("--seed", arguments->seed, "append: of the checks; 0: the gate's own").type("N");
  command.add_flag("--whole", arguments->whole,
                   "append: the whole gate ran; without --seed its samples are counted");
  command.add("--sources", arguments->sources, "append: hash of the code under test").type("HASH");
  command
      .add("--part", arguments->parts,
           "append: a part that ran or was skipped, NAME=STATUS,SECONDS[,NOTE]; repeated")
      .one_value_each()
      .type("TEXT");
  command
      .add("--machine", arguments->machine,
           "report: whose runs, as export shows it; those like the latest without it")
      .type("TEXT");
  command.add("--json", arguments->json, "report: a record for the page too").type("FILE");
  command.footer(
      "Examples:\n  plumbline history list --history build/history.db\n"
      "  plumbline history export --csv --table checks --history build/history.db");
  command.runs([arguments] { return run_history(*arguments); });
}

}  // namespace plumbline::tools
