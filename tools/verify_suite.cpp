#include "verify_suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <iterator>
#include <string_view>
#include <utility>

#include <plumbline/output/failure.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/reports/results.h>
#include <plumbline/verify/detail/budget.h>
#include <plumbline/verify/detail/stopwatch.h>

#include "command.h"
#include "verify_check.h"

namespace plumbline::tools {
namespace {

/// What came of an entry.
struct Checked {
  int exit_code = kExitFine;
  std::string words;  // where it is not fine
  std::uint64_t values = 0;
  std::vector<verify::CheckResult> results;
};

Checked check_entry(const SuiteEntry& entry) {
  Checked checked;
  try {
    CheckedProgram program = check_program(entry.given);
    note_replay(program.report);
    checked.values = program.values;
    if (!program.report.ok()) {
      checked.exit_code = kExitUnexpectedVerdict;
      checked.words = program.report.summary();
    }
    checked.results = std::move(program.report.results);
  } catch (const exchange::AnswererError& error) {
    checked = {kExitBadInput, error.what(), 0, {}};
  } catch (...) {
    output::Failure failure = output::failure_of(std::current_exception());
    if (failure.exit_code == kExitMachineFailed) throw;  // which is no matter of the program
    checked = {failure.exit_code, std::move(failure.what), 0, {}};
  }
  return checked;
}

/// Texts one after the other in one: the length of each before it.
void put(std::string& all, std::string_view text) {
  all += fmt::format("{}:", text.size());
  all += text;
}

std::string take(std::string_view& all) {
  std::size_t size = 0;
  const char* end = std::from_chars(all.data(), all.data() + all.size(), size).ptr;
  all.remove_prefix(static_cast<std::size_t>(end - all.data()) + 1);
  std::string text(all.substr(0, size));
  all.remove_prefix(size);
  return text;
}

void put(std::string& all, const Checked& checked) {
  put(all, std::to_string(checked.exit_code));
  put(all, checked.words);
  put(all, std::to_string(checked.values));
  put(all, std::to_string(checked.results.size()));
  for (const verify::CheckResult& result : checked.results) put(all, reports::to_json(result));
}

Checked take_checked(std::string_view& all) {
  Checked checked;
  checked.exit_code = std::stoi(take(all));
  checked.words = take(all);
  checked.values = std::stoull(take(all));
  for (std::size_t left = std::stoull(take(all)); left > 0; --left) {
    checked.results.push_back(reports::parse_check(take(all)));
  }
  return checked;
}

/// How many there are of each exit code, and what else is summed.
struct Total {
  std::size_t failed = 0, not_checked = 0;
  std::uint64_t values = 0;
  std::vector<verify::CheckResult> results;

  void add(const SuiteEntry& entry, Checked checked) {
    if (checked.exit_code != kExitFine) fmt::print("{}\n{}\n", entry.place, checked.words);
    failed += checked.exit_code == kExitUnexpectedVerdict ? 1 : 0;
    not_checked += checked.exit_code == kExitBadInput ? 1 : 0;
    values += checked.values;
    std::move(checked.results.begin(), checked.results.end(), std::back_inserter(results));
  }

  int exit_code() const {
    if (not_checked > 0) return kExitBadInput;
    return failed > 0 ? kExitUnexpectedVerdict : kExitFine;
  }
};

/// The levels of the checks add up to that of a run only for so many.
void tell_of_budget(std::size_t checks) {
  const std::uint64_t most = verify::ErrorBudget().max_checks;
  if (checks <= most) return;
  output::tell(
      fmt::format("plumbline: {} checks, the error budget of a run is split over {}: more than one "
                  "run, with the chance of a false failure of each\n",
                  checks, most));
}

}  // namespace

void require_one_suite(mpi::Ranks& ranks, const std::vector<SuiteEntry>& entries) {
  std::string what = PLUMBLINE_VERSION;
  for (const SuiteEntry& entry : entries) {
    const std::uint64_t seed = entry.given.seed.value_or(0);
    what += fmt::format("\n{}\n{}", entry.place, replay_command(entry.given, seed));
  }
  const std::string own = std::to_string(std::hash<std::string>()(what));  // of one program
  const std::vector<std::string> names = gather(ranks, ranks.name());
  const std::vector<std::string> all = gather(ranks, own);
  agree(ranks, [&] {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i] == own) continue;
      throw renderer::InputError(names[i] + ": has another suite, or is another version");
    }
  });
}

int run_suite(mpi::Ranks* ranks, const std::vector<SuiteEntry>& entries, const KeepResults& keep) {
  const auto count = static_cast<std::size_t>(ranks ? ranks->count() : 1);
  const auto rank = static_cast<std::size_t>(ranks ? ranks->rank() : 0);
  const verify::Stopwatch watch;
  std::string own;
  for (std::size_t i = rank; i < entries.size(); i += count) put(own, check_entry(entries[i]));
  const std::vector<std::string> parts =
      ranks ? gather(*ranks, own) : std::vector<std::string>{own};
  if (parts.empty()) return kExitFine;  // the first rank has it
  std::vector<std::string_view> left(parts.begin(), parts.end());
  Total total;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    total.add(entries[i], take_checked(left[i % count]));
  }
  keep(total.results);
  tell_of_budget(total.results.size());
  fmt::print(
      "{} of {} are fine, {} fail, {} could not be checked; {} checks, {} values, {:.1f} s\n",
      entries.size() - total.failed - total.not_checked, entries.size(), total.failed,
      total.not_checked, total.results.size(), total.values, watch.seconds());
  return total.exit_code();
}

}  // namespace plumbline::tools
