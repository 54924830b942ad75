#include <algorithm>
#include <system_error>

#include <plumbline/reports/budgets.h>
#include <plumbline/reports/results.h>

#include "files.h"
#include "history_fields.h"
#include "record_fields.h"

namespace plumbline::reports {
namespace {

namespace fs = std::filesystem;
using detail::Json;

/// Adds every file below the directory that may hold records; what cannot be looked at becomes a
/// warning.
void find_record_files(const fs::path& directory, Results& results) {
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& path = entry->path();
    std::error_code unknown;
    if (entry->is_directory(unknown) && !entry->is_symlink(unknown)) {
      find_record_files(path, results);
    } else if (path.extension() == ".jsonl" || path.extension() == ".json") {
      const bool is_file = entry->is_regular_file(unknown);
      if (unknown) results.warnings.push_back({path, 0, unknown.message()});
      if (is_file) results.files.push_back(path);
    }
  }
  if (error) results.warnings.push_back({directory, 0, error.message()});
}

void add_environment(std::vector<RunEnvironment>& environments, RunEnvironment environment) {
  for (RunEnvironment& known : environments) {
    if (!known.same_build(environment)) continue;
    environment.libraries.merge(known.libraries);
    if (environment.time < known.time) environment.time = known.time;
    known = std::move(environment);
    return;
  }
  environments.push_back(std::move(environment));
}

void add_document(Results& results, const std::string& text, const fs::path& directory) {
  const std::string format = detail::format_of(Json::parse(text));
  if (format == detail::kCheckFormat) {
    results.checks.push_back(parse_check(text));
  } else if (format == detail::kRenderFormat) {
    RenderRecord record = parse_render_record(text);
    if (!record.image.empty()) record.image = directory / record.image;
    results.renders.push_back(std::move(record));
  } else if (format == detail::kSpeedFormat) {
    results.speed.push_back(parse_speed_point(text));
  } else if (format == detail::kRayCostFormat) {
    results.ray_costs.push_back(parse_ray_cost(text));
  } else if (format == detail::kBarFormat) {
    results.bars.push_back(parse_bar(text));
  } else if (format == detail::kStabilityFormat) {
    results.stability.push_back(parse_stability_record(text));
  } else if (format == detail::kCausesFormat) {
    results.causes.push_back(parse_causes_record(text));
  } else if (format == detail::kDuetFormat) {
    results.duets.push_back(parse_duet_record(text));
  } else if (format == detail::kFigureFormat) {
    results.figures.push_back(parse_figure(text));
  } else if (format == detail::kTableFormat) {
    results.tables.push_back(parse_table(text));
  } else if (format == detail::kDistributionFormat) {
    results.distributions.push_back(parse_distribution(text));
  } else if (format == detail::kCounterFormat) {
    results.counters.push_back(parse_counter(text));
  } else if (format == detail::kSeedRunFormat) {
    results.seed_runs.push_back(parse_seed_run(text));
  } else if (format == detail::kHistoryFormat) {
    results.histories.push_back(parse_history(text));
  } else if (format == detail::kEnvironmentFormat) {
    add_environment(results.environments, parse_environment(text));
  } else if (format.empty()) {
    throw FormatError("states no \"format\"");
  } else {
    throw FormatError("format \"" + format + "\" is not one that this version reads");
  }
}

/// What is larger than any result is not passed over with a warning: it may be all that there is.
[[noreturn]] void refuse(const fs::path& file, std::size_t line, const BudgetError& error) {
  const std::string where = line == 0 ? "" : ":" + std::to_string(line);
  throw ResultsError(file.string() + where + ": " + error.what());
}

/// Records of all files together.
class RecordCount {
 public:
  explicit RecordCount(std::size_t most) : most_(most) {}

  void add_one() {
    if (++count_ <= most_) return;
    throw BudgetError("more than " + std::to_string(most_) + " records: split them");
  }

 private:
  std::size_t most_, count_ = 0;
};

void read_lines(Results& results, const fs::path& file, const std::string& text,
                RecordCount& records) {
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    ++number;
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (line.empty()) continue;
    try {
      records.add_one();
      add_document(results, line, file.parent_path());
    } catch (const BudgetError& error) {
      refuse(file, number, error);
    } catch (const FormatError& error) {
      results.warnings.push_back({file, number, error.what()});
    }
  }
}

/// A whole file as one document; those that state no format belong to somebody else.
void read_single(Results& results, const fs::path& file, const std::string& text,
                 RecordCount& records) {
  try {
    if (detail::format_of(Json::parse(text)).empty()) return;
    records.add_one();
    add_document(results, text, file.parent_path());
  } catch (const BudgetError&) {
    throw;
  } catch (const FormatError& error) {
    results.warnings.push_back({file, 0, error.what()});
  }
}

bool holds_nothing(const Results& results) {
  return results.checks.empty() && results.renders.empty() && results.speed.empty() &&
         results.ray_costs.empty() && results.bars.empty() && results.stability.empty() &&
         results.causes.empty() && results.duets.empty() && results.figures.empty() &&
         results.tables.empty() && results.distributions.empty() && results.counters.empty() &&
         results.seed_runs.empty() && results.histories.empty() && results.warnings.empty();
}

}  // namespace

Results read_results(const fs::path& directory, std::size_t most_records) {
  std::error_code ignored;
  if (!fs::exists(directory, ignored)) {
    throw ResultsError(directory.string() + ": no such directory");
  }
  if (!fs::is_directory(directory, ignored)) {
    throw ResultsError(directory.string() + ": not a directory");
  }
  Results results;
  find_record_files(directory, results);
  std::sort(results.files.begin(), results.files.end());
  RecordCount records(most_records);
  for (const fs::path& file : results.files) {
    try {
      const std::string text = detail::read_file(file);
      if (file.extension() == ".jsonl") {
        read_lines(results, file, text, records);
      } else {
        read_single(results, file, text, records);
      }
    } catch (const BudgetError& error) {
      refuse(file, 0, error);
    } catch (const std::system_error& error) {
      results.warnings.push_back({file, 0, error.what()});
    }
  }
  if (holds_nothing(results)) {
    throw ResultsError(directory.string() +
                       ": holds no results (*.jsonl, or *.json with a format)");
  }
  return results;
}

Summary summarise(const Results& results) {
  Summary summary;
  for (const verify::CheckResult& check : results.checks) {
    if (!check.as_expected()) {
      ++summary.unexpected;
    } else if (!check.waived.empty()) {
      ++summary.waived;
    } else if (check.verdict == verify::Verdict::pass) {
      ++summary.passed;
    } else if (check.verdict == verify::Verdict::fail) {
      ++summary.failed_as_expected;
    } else {
      ++summary.inconclusive_as_expected;
    }
  }
  summary.unreadable = results.warnings.size();
  return summary;
}

}  // namespace plumbline::reports
