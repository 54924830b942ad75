// corpus_score [--correct | --open | --sealed] [--gate] [--seed N] [--filter TEXT]
//
// Runs the corpus and says how the library did: false alarms on correct code, faults found, causes
// right and wrong.

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

#include "all_cases.h"

namespace plumbline::tests::corpus {
namespace {

using verify::CauseKind;
using verify::CheckResult;
using verify::Verdict;

/// As the enumeration spells it: what cases are written with.
std::string kind_name(CauseKind kind) {
  static const std::map<CauseKind, const char*> kNames{
      {CauseKind::none, "none"},
      {CauseKind::constant, "constant"},
      {CauseKind::constant_per_hemisphere, "constant_per_hemisphere"},
      {CauseKind::lobe_probability, "lobe_probability"},
      {CauseKind::choice_probability, "choice_probability"},
      {CauseKind::cosine, "cosine"},
      {CauseKind::sine, "sine"},
      {CauseKind::radius, "radius"},
      {CauseKind::half_vector_jacobian, "half_vector_jacobian"},
      {CauseKind::refraction_jacobian, "refraction_jacobian"},
      {CauseKind::masking, "masking"},
      {CauseKind::roughness, "roughness"},
      {CauseKind::fresnel, "fresnel"},
      {CauseKind::eta_squared, "eta_squared"},
      {CauseKind::distance_or_area, "distance_or_area"},
      {CauseKind::directions_swapped, "directions_swapped"},
      {CauseKind::mirrored, "mirrored"},
      {CauseKind::chosen_lobe_only, "chosen_lobe_only"},
      {CauseKind::shifted, "shifted"},
      {CauseKind::tangent_frame, "tangent_frame"},
      {CauseKind::not_rejected, "not_rejected"},
      {CauseKind::numbers_reused, "numbers_reused"},
      {CauseKind::support, "support"},
      {CauseKind::on_a_line, "on_a_line"},
      {CauseKind::atom_as_density, "atom_as_density"},
      {CauseKind::record_pdf, "record_pdf"},
      {CauseKind::value_cosine, "value_cosine"},
      {CauseKind::value_constant, "value_constant"},
      {CauseKind::weight, "weight"},
      {CauseKind::asymmetric, "asymmetric"},
      {CauseKind::energy, "energy"},
      {CauseKind::not_finite, "not_finite"},
      {CauseKind::precision, "precision"},
      {CauseKind::stale_state, "stale_state"}};
  return kNames.at(kind);
}

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
  std::map<std::string_view, double> seconds_of;                 ///< kinds of checks
  std::map<std::pair<std::string, std::string>, int> confusion;  ///< expected, named
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
  const std::string shown = named.text.empty()              ? "nothing"
                            : named.kind == CauseKind::none ? "something else"
                                                            : kind_name(named.kind);
  // One of several names for the same counts as the first of them.
  ++totals.confusion[{kind_name(expected), right ? kind_name(expected) : shown}];
  std::printf("%-7s %-6s %6.2f s  %s\n", found ? "found" : "MISSED", judged, seconds,
              c.name.c_str());
  std::printf("    fault: %s\n    expected: %s, named: %s%s%s\n", c.fault.c_str(),
              kind_name(expected).c_str(), shown.c_str(), named.text.empty() ? "" : ": ",
              named.text.c_str());
  std::printf("    %s\n", summary_of(results).c_str());
}

void print_confusion(const Totals& totals) {
  std::set<std::string> columns, rows;
  for (const auto& [key, count] : totals.confusion)
    rows.insert(key.first), columns.insert(key.second);
  std::printf("\n| fault \\ named |");
  for (const auto& column : columns) std::printf(" %s |", column.c_str());
  std::printf("\n|---|");
  for (std::size_t i = 0; i < columns.size(); ++i) std::printf("---|");
  std::printf("\n");
  for (const auto& row : rows) {
    std::printf("| %s |", row.c_str());
    for (const auto& column : columns) {
      const auto cell = totals.confusion.find({row, column});
      std::printf(cell == totals.confusion.end() ? " |" : " %d |",
                  cell == totals.confusion.end() ? 0 : cell->second);
    }
    std::printf("\n");
  }
}

int score(const std::vector<Case>& cases, std::uint64_t seed, Effort effort,
          std::string_view filter) {
  Totals totals;
  for (const Case& c : cases) {
    if (c.name.find(filter) == std::string::npos) continue;
    const auto start = std::chrono::steady_clock::now();
    const Results results = c.run(seed, effort);
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
  std::printf("%.1f s, seed %llu\n", totals.seconds, static_cast<unsigned long long>(seed));
  return totals.alarms + totals.undecided + totals.faults - totals.found == 0 ? 0 : 1;
}

}  // namespace
}  // namespace plumbline::tests::corpus

int main(int argc, char** argv) {
  using namespace plumbline::tests::corpus;
  std::vector<Half> halves;
  std::uint64_t seed = 1;
  Effort effort = Effort::user;
  std::string_view filter;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--correct") {
      halves.push_back(Half::correct);
    } else if (argument == "--open") {
      halves.push_back(Half::open);
    } else if (argument == "--sealed") {
      halves.push_back(Half::sealed);
    } else if (argument == "--gate") {
      effort = Effort::gate;
    } else if (argument == "--seed" && i + 1 < argc) {
      seed = std::strtoull(argv[++i], nullptr, 10);
    } else if (argument == "--filter" && i + 1 < argc) {
      filter = argv[++i];
    } else {
      std::fprintf(stderr,
                   "usage: corpus_score [--correct] [--open] [--sealed] [--gate] [--seed N] "
                   "[--filter TEXT]\n");
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
  return score(cases, seed, effort, filter);
}
