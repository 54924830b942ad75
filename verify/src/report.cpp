#include <plumbline/verify/detail/report.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "text.h"

namespace plumbline::verify {

namespace {

// Names of further results; more than this nobody reads.
constexpr std::size_t kMostNames = 12;

bool skipped(const CheckResult& r) {
  return r.verdict == Verdict::inconclusive && r.expected == Verdict::inconclusive;
}

bool acceptable(const CheckResult& r) { return r.ok() || skipped(r) || !r.waived.empty(); }

/// What the summary is about: results that are not what their checks declare; where there are none,
/// those that declare something else than a pass. Fails first.
std::vector<CheckResult> notable(const Report& report) {
  std::vector<CheckResult> list;
  const auto keep = [&](bool (*wanted)(const CheckResult&)) {
    std::copy_if(report.begin(), report.end(), std::back_inserter(list), wanted);
  };
  keep([](const CheckResult& r) { return !r.as_expected(); });
  if (list.empty()) keep([](const CheckResult& r) { return !acceptable(r); });
  std::stable_partition(list.begin(), list.end(),
                        [](const CheckResult& r) { return r.verdict == Verdict::fail; });
  return list;
}

std::string count(std::size_t n) { return number(std::uint64_t{n}); }

std::string checks(std::size_t n) { return count(n) + (n == 1 ? " check" : " checks"); }

std::string summary_of_good(const Report& report) {
  const auto passed = static_cast<std::size_t>(
      std::count_if(report.begin(), report.end(), [](const CheckResult& r) { return r.ok(); }));
  std::string text = count(passed) + " of " + checks(report.size()) + " passed";
  std::size_t waived = 0;
  std::string reasons;
  for (const CheckResult& r : report) {
    if (r.waived.empty()) continue;
    ++waived;
    reasons += "waived: " + r.subject + ": " + r.waived + "\n";
  }
  const std::size_t skipped = report.size() - passed - waived;
  if (skipped > 0) text += ", " + count(skipped) + " skipped";
  if (waived > 0) text += ", " + count(waived) + " waived";
  return text + "\n" + reasons;
}

std::string first_diagnosis(const std::vector<CheckResult>& results) {
  for (const CheckResult& r : results) {
    if (!r.diagnosis.empty()) return r.diagnosis;
  }
  return {};
}

/// The first of each kind and verdict in full, without what the summary says once.
std::string in_full(std::vector<CheckResult>& results, const std::string& cause,
                    const std::string& replay) {
  std::string text, others;
  std::size_t more = 0;
  std::set<std::pair<CheckKind, Verdict>> seen;
  for (CheckResult& r : results) {
    if (seen.emplace(r.kind, r.verdict).second) {
      if (r.diagnosis == cause) r.diagnosis.clear();
      if (!replay.empty()) r.replay.clear();
      text += describe(r);
    } else if (++more <= kMostNames) {
      others += "  " + r.subject + "\n";
    }
  }
  if (more > kMostNames) others += "  and " + count(more - kMostNames) + " more\n";
  return others.empty() ? text : text + "in the same way:\n" + others;
}

}  // namespace

bool Report::ok() const { return !empty() && std::all_of(begin(), end(), acceptable); }

Verdict Report::verdict() const {
  const auto any = [&](Verdict v) {
    return std::any_of(begin(), end(),
                       [v](const CheckResult& r) { return r.verdict == v && r.waived.empty(); });
  };
  if (any(Verdict::fail)) return Verdict::fail;
  return ok() && any(Verdict::pass) ? Verdict::pass : Verdict::inconclusive;
}

bool Report::as_expected() const {
  return !empty() &&
         std::all_of(begin(), end(), [](const CheckResult& r) { return r.as_expected(); });
}

std::string Report::summary() const {
  if (empty()) return "nothing was checked\n";
  std::vector<CheckResult> list = notable(*this);
  if (list.empty()) return summary_of_good(*this);
  std::string text;
  if (size() > 1) {
    text = count(list.size()) + " of " + checks(size()) +
           (as_expected() ? " declared not to pass, and did not\n"
                          : " did not give what they should\n");
  }
  const std::string& likely = cause.empty() ? first_diagnosis(list) : cause;
  if (!likely.empty()) text += "likely cause: " + likely + "\n";
  if (!second_cause.empty()) text += "or, nearly as well: " + second_cause + "\n";
  text += in_full(list, likely, replay);
  if (!replay.empty()) text += "replay: " + replay + "\n";
  return text;
}

void Report::append(Report other) {
  results.insert(results.end(), std::make_move_iterator(other.begin()),
                 std::make_move_iterator(other.end()));
  if (!cause.empty() || other.cause.empty()) return;
  cause = std::move(other.cause);
  second_cause = std::move(other.second_cause);
  cause_kind = other.cause_kind;
}

}  // namespace plumbline::verify
