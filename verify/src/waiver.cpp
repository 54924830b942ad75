#include <plumbline/verify/waiver.h>

#include <charconv>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace plumbline::verify {

namespace {

using Day = std::chrono::year_month_day;

/// * stands for any text, also for none.
bool matches(std::string_view pattern, std::string_view text) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return pattern == text;
  if (text.substr(0, star) != pattern.substr(0, star)) return false;
  for (std::size_t rest = star; rest <= text.size(); ++rest) {
    if (matches(pattern.substr(star + 1), text.substr(rest))) return true;
  }
  return false;
}

std::string in_words(const Day& day) {
  const auto digits = [](int number, std::size_t count) {
    std::string text = std::to_string(number);
    return std::string(text.size() < count ? count - text.size() : 0, '0') + text;
  };
  return digits(static_cast<int>(day.year()), 4) + "-" +
         digits(static_cast<int>(static_cast<unsigned>(day.month())), 2) + "-" +
         digits(static_cast<int>(static_cast<unsigned>(day.day())), 2);
}

void require_sense(const Waiver& waiver) {
  const auto refuse = [&](const char* what) {
    throw std::invalid_argument("waiver of \"" + waiver.check + "\": " + what);
  };
  if (waiver.check.empty()) refuse("names no check");
  if (waiver.reason.empty()) refuse("gives no reason");
  if (!waiver.until.ok()) refuse("its last day is none of the calendar");
}

CheckResult complaint(const Waiver& waiver, std::string why) {
  CheckResult result;
  result.subject = "waiver/" + waiver.check;
  result.verdict = Verdict::fail;
  result.reason = std::move(why);
  return result;
}

/// What is wrong with a waiver itself; empty if it is needed.
std::string fault_of(const Waiver& waiver, bool named, bool failing, const Day& on) {
  if (!named) return "no check has the name that it states";
  if (!failing) return "what it waives passes: take it away";
  if (std::chrono::sys_days(waiver.until) < std::chrono::sys_days(on)) {
    return "expired on " + in_words(waiver.until) + ": " + waiver.reason;
  }
  return {};
}

}  // namespace

std::chrono::year_month_day parse_day(std::string_view text) {
  const auto number = [&](std::size_t first, std::size_t count) {
    int value = -1;
    const char* end = text.data() + first + count;
    const auto read = std::from_chars(text.data() + first, end, value);
    return read.ec == std::errc() && read.ptr == end ? value : -1;
  };
  if (text.size() == 10 && text[4] == '-' && text[7] == '-') {
    const int year = number(0, 4), month = number(5, 2), day = number(8, 2);
    const Day parsed{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                     std::chrono::day(static_cast<unsigned>(day))};
    if (year >= 0 && month >= 0 && day >= 0 && parsed.ok()) return parsed;
  }
  throw std::invalid_argument("\"" + std::string(text) +
                              "\" is no day; it must read like 2027-01-31");
}

std::chrono::year_month_day today() {
  return Day(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()));
}

Report waive(Report report, const std::vector<Waiver>& waivers, std::chrono::year_month_day on) {
  std::vector<CheckResult> complaints;
  for (const Waiver& waiver : waivers) {
    require_sense(waiver);
    bool named = false;
    std::vector<CheckResult*> failing;
    for (CheckResult& result : report) {
      if (!matches(waiver.check, result.subject)) continue;
      named = true;
      if (!result.as_expected()) failing.push_back(&result);
    }
    const std::string fault = fault_of(waiver, named, !failing.empty(), on);
    if (!fault.empty()) {
      complaints.push_back(complaint(waiver, fault));
      continue;
    }
    for (CheckResult* result : failing) {
      result->expected = result->verdict;
      result->waived = waiver.reason + " (until " + in_words(waiver.until) + ")";
    }
  }
  report.append(Report(std::move(complaints)));
  return report;
}

}  // namespace plumbline::verify
