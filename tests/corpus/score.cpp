// corpus_score [--correct | --open | --sealed] [--gate] [--seed N] [--filter TEXT]
//              [--set NAME --results DIRECTORY]
//
// Runs the corpus and says how the library did: false alarms on correct code, faults found, causes
// right and wrong. With a directory the causes named are appended to its causes.jsonl, under the
// name of the set, for the page.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plumbline/reports/results.h>

#include "all_cases.h"

namespace plumbline::tests::corpus {
namespace {

using verify::CauseKind;
using verify::CheckResult;
using verify::Verdict;

struct NamedCause {
  CauseKind kind = CauseKind::none;
  std::string text;  ///< as it is shown; empty: nothing is said
};

/// The kind that a result carries, in versions of the library in which it does.
template <class Result>
CauseKind kind_of(const Result& result) {
  if constexpr (requires { result.cause; }) {
    return result.cause;
  } else {
    return CauseKind::none;
  }
}

/// What the library says is wrong: the first diagnosis of a report. A kind is taken from results
/// that have one; until then it is read from the words.
NamedCause named_cause(const Results& results) {
  static const std::vector<std::pair<std::string_view, CauseKind>> kWords{
      {"swapped", CauseKind::directions_swapped},
      {"half-vector Jacobian", CauseKind::half_vector_jacobian},
      {"wo·h", CauseKind::half_vector_jacobian},
      {"hemisphere", CauseKind::constant_per_hemisphere},
      {"G1", CauseKind::masking},
      {"η²", CauseKind::eta_squared},
      {"lobe", CauseKind::lobe_probability},
      {"cosθ", CauseKind::cosine},
      {"sinθ", CauseKind::sine},
      {"constant", CauseKind::constant},
      {"factor", CauseKind::constant}};
  for (const CheckResult& r : results) {
    if (r.as_expected()) continue;
    if (const CauseKind kind = kind_of(r); kind != CauseKind::none) return {kind, r.diagnosis};
    if (r.diagnosis.empty()) continue;
    for (const auto& [word, kind] : kWords) {
      if (r.diagnosis.find(word) != std::string::npos) return {kind, r.diagnosis};
    }
    return {CauseKind::none, r.diagnosis};
  }
  return {};
}

/// "integral fail 2, jacobian inconclusive 1": the kinds of what was not as expected.
std::string summary_of(const Results& results) {
  std::map<std::string, int> counts;
  for (const CheckResult& r : results) {
    if (!r.as_expected())
      ++counts[std::string(to_string(r.kind)) + " " + std::string(to_string(r.verdict))];
  }
  std::string text;
  for (const auto& [kind, count] : counts) {
    text += (text.empty() ? "" : ", ") + kind + " " + std::to_string(count);
  }
  return text;
}

bool any(const Results& results, Verdict verdict) {
  return std::any_of(results.begin(), results.end(), [verdict](const CheckResult& r) {
    return !r.as_expected() && r.verdict == verdict;
  });
}

struct Totals {
  int correct = 0, alarms = 0, undecided = 0;
  int faults = 0, found = 0, right = 0, wrong = 0, silent = 0;
  double seconds = 0;
  std::map<std::string_view, double> seconds_of;  ///< kinds of checks
  std::vector<reports::JudgedTwin> twins;
};

/// First two lines of the first result that is not as expected, for whoever looks into it.
std::string detail_of(const Results& results) {
  for (const CheckResult& r : results) {
    if (!r.as_expected()) return r.subject + ": " + r.reason;
  }
  return {};
}

void run_correct(const Case& c, const Results& results, double seconds, Totals& totals) {
  ++totals.correct;
  const bool alarm = any(results, Verdict::fail);
  const bool undecided = !alarm && any(results, Verdict::inconclusive);
  totals.alarms += alarm;
  totals.undecided += undecided;
  std::printf("%-12s %6.2f s  %s",
              alarm       ? "ALARM"
              : undecided ? "inconclusive"
                          : "pass",
              seconds, c.name.c_str());
  if (alarm || undecided) {
    std::printf("  [%s]\n    %s", summary_of(results).c_str(), detail_of(results).c_str());
  }
  std::printf("\n");
}

void run_twin(const Case& c, const Results& results, double seconds, Totals& totals) {
  ++totals.faults;
  const bool found = any(results, Verdict::fail);
  const NamedCause named = named_cause(results);
  const CauseKind expected = c.causes.empty() ? CauseKind::none : c.causes.front();
  const bool right = std::find(c.causes.begin(), c.causes.end(), named.kind) != c.causes.end();
  const char* judged = named.text.empty() ? "none" : right ? "right" : "WRONG";
  totals.found += found;
  if (named.text.empty()) {
    ++totals.silent;
  } else {
    ++(right ? totals.right : totals.wrong);
  }
  const std::string due(to_string(expected));
  const std::string shown = named.text.empty()              ? ""
                            : named.kind == CauseKind::none ? "something else"
                                                            : std::string(to_string(named.kind));
  // One of several names for the same counts as the first of them.
  totals.twins.push_back({c.name, c.fault, due, right ? due : shown, found});
  std::printf("%-7s %-6s %6.2f s  %s\n", found ? "found" : "MISSED", judged, seconds,
              c.name.c_str());
  std::printf("    fault: %s\n    expected: %s, named: %s%s%s\n", c.fault.c_str(), due.c_str(),
              shown.empty() ? "nothing" : shown.c_str(), shown.empty() ? "" : ": ",
              named.text.c_str());
  std::printf("    %s\n", summary_of(results).c_str());
}

void print_confusion(const Totals& totals) {
  std::map<std::pair<std::string, std::string>, int> confusion;  // expected, named
  std::set<std::string> columns, rows;
  for (const reports::JudgedTwin& twin : totals.twins) {
    const std::string named = twin.named.empty() ? "nothing" : twin.named;
    ++confusion[{twin.expected, named}];
    rows.insert(twin.expected), columns.insert(named);
  }
  std::printf("\n| fault \\ named |");
  for (const auto& column : columns) std::printf(" %s |", column.c_str());
  std::printf("\n|---|");
  for (std::size_t i = 0; i < columns.size(); ++i) std::printf("---|");
  std::printf("\n");
  for (const auto& row : rows) {
    std::printf("| %s |", row.c_str());
    for (const auto& column : columns) {
      const auto cell = confusion.find({row, column});
      std::printf(cell == confusion.end() ? " |" : " %d |",
                  cell == confusion.end() ? 0 : cell->second);
    }
    std::printf("\n");
  }
}

struct Options {
  std::uint64_t seed = 1;
  Effort effort = Effort::user;
  std::string_view filter;
  std::string set = "first", results;
};

int score(const std::vector<Case>& cases, const Options& options) {
  Totals totals;
  for (const Case& c : cases) {
    if (c.name.find(options.filter) == std::string::npos) continue;
    const auto start = std::chrono::steady_clock::now();
    const Results results = c.run(options.seed, options.effort);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    totals.seconds += seconds;
    for (const CheckResult& r : results) totals.seconds_of[to_string(r.kind)] += r.seconds;
    (c.fault.empty() ? run_correct : run_twin)(c, results, seconds, totals);
    std::fflush(stdout);
  }
  if (totals.correct > 0) {
    std::printf("\ncorrect: %d, false alarms %d, inconclusive undeclared %d\n", totals.correct,
                totals.alarms, totals.undecided);
  }
  if (totals.faults > 0) {
    std::printf("\nfaults: %d, found %d; cause right %d, wrong %d, none %d\n", totals.faults,
                totals.found, totals.right, totals.wrong, totals.silent);
    print_confusion(totals);
  }
  for (const auto& [kind, seconds] : totals.seconds_of) {
    std::printf("%8.1f s  %.*s\n", seconds, static_cast<int>(kind.size()), kind.data());
  }
  std::printf("%.1f s, seed %llu\n", totals.seconds, static_cast<unsigned long long>(options.seed));
  if (!options.results.empty() && totals.faults > 0) {
    reports::ResultLog(options.results, "causes")
        .append(reports::CausesRecord{options.set, options.seed, totals.twins});
  }
  return totals.alarms + totals.undecided + totals.faults - totals.found == 0 ? 0 : 1;
}

}  // namespace
}  // namespace plumbline::tests::corpus

int main(int argc, char** argv) {
  using namespace plumbline::tests::corpus;
  std::vector<Half> halves;
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--correct") {
      halves.push_back(Half::correct);
    } else if (argument == "--open") {
      halves.push_back(Half::open);
    } else if (argument == "--sealed") {
      halves.push_back(Half::sealed);
    } else if (argument == "--gate") {
      options.effort = Effort::gate;
    } else if (argument == "--seed" && i + 1 < argc) {
      options.seed = std::strtoull(argv[++i], nullptr, 10);
    } else if (argument == "--filter" && i + 1 < argc) {
      options.filter = argv[++i];
    } else if (argument == "--set" && i + 1 < argc) {
      options.set = argv[++i];
    } else if (argument == "--results" && i + 1 < argc) {
      options.results = argv[++i];
    } else {
      std::fprintf(stderr,
                   "usage: corpus_score [--correct] [--open] [--sealed] [--gate] [--seed N] "
                   "[--filter TEXT] [--set NAME] [--results DIRECTORY]\n");
      return 2;
    }
  }
  if (halves.empty()) halves = {Half::correct, Half::open};
  std::vector<Case> cases;
  for (const Half half : halves) {
    for (Case& c : all_cases(half)) cases.push_back(std::move(c));
  }
  if (cases.empty()) {
    std::fprintf(stderr, "corpus_score: this build has no such cases\n");
    return 2;
  }
  return score(cases, options);
}
