#include <cmath>
#include <cstdio>

#include <plumbline/verify/detail/result.h>

#include "text.h"

namespace plumbline::verify {

namespace {

void line(std::string& out, const std::string& name, const std::string& text) {
  if (text.empty()) return;
  out += "  " + name + std::string(name.size() < 12 ? 12 - name.size() : 1, ' ') + text + "\n";
}

std::string if_known(double value) { return std::isnan(value) ? std::string() : number(value); }

std::string estimate_line(const CheckResult& r) {
  if (std::isnan(r.estimate)) return {};
  std::string text = number(r.estimate);
  if (!std::isnan(r.interval_low)) {
    text += "  [" + number(r.interval_low) + ", " + number(r.interval_high) + "] (99.9 %)";
  }
  if (!std::isnan(r.reference)) text += "  against " + number(r.reference);
  return text;
}

std::string bound_line(const CheckResult& r) {
  if (std::isnan(r.bound)) return {};
  std::string text = number(r.bound);
  if (!std::isnan(r.tolerance)) text += "  (tolerance " + number(r.tolerance) + ")";
  return text;
}

std::string samples_line(const CheckResult& r) {
  if (r.samples == 0) return {};
  std::string text = number(r.samples);
  if (r.seconds > 0) text += " in " + number(r.seconds) + " s";
  return text;
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "fail";
    case Verdict::inconclusive:
      return "inconclusive";
  }
  return "?";
}

std::string describe(const CheckResult& r) {
  std::string out =
      r.subject + ": " + r.check + " check gives " + std::string(to_string(r.verdict));
  out += r.as_expected() ? ", as expected\n"
                         : ", expected " + std::string(to_string(r.expected)) + "\n";
  line(out, "why", r.reason);
  line(out, "diagnosis", r.diagnosis);
  line(out, "estimate", estimate_line(r));
  line(out, "|bias| <=", bound_line(r));
  line(out, "detectable", if_known(r.detectable));
  line(out, "p-value", if_known(r.p_value));
  line(out, "samples", samples_line(r));
  line(out, "leans on", r.leaned_on);
  for (const auto& [name, value] : r.figures) line(out, name, number(value));
  line(out, "seed", number(r.seed));
  line(out, "replay", r.replay);
  return out;
}

}  // namespace plumbline::verify
