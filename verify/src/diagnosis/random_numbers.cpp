#include <cmath>
#include <string>

#include "diagnosis/hypothesis.h"
#include "text.h"

namespace plumbline::verify {

namespace {

/// One random number enters a map that is right as its power u^k: u^k has the density
/// (1/k) u^(1/k − 1) at its own value, which is (1/k) u^(1 − k) at u.
Hypothesis power_of_number(std::size_t which, bool from_end, double k, const Blame& blame) {
  Hypothesis h;
  h.kind = CauseKind::radius;
  // A root too many looks like a factor of the density, which is the likelier.
  h.complexity = (k > 1 ? 1 : 9) + (from_end ? 0.2 : 0) + (k == 2 || k == 0.5 ? 0 : 1);
  h.needs_exact = true;
  h.prediction = [=](const Place& p, std::span<const double>) {
    if (p.u == nullptr) return kNothingSaid;
    const double u = from_end ? 1 - (*p.u)[which] : (*p.u)[which];
    return p.base * std::pow(u, 1 - k) / k;
  };
  const std::string name = (from_end ? "1 − u" : "u") + std::string(which == 0 ? "₁" : "₂");
  const bool root = k < 1;
  h.words = [=](std::span<const double>) {
    const std::string times =
        k == 2 ? "1/2 · 1/(" + name + ")" : number(1 / k) + " · (" + name + ")^" + number(1 - k);
    return std::string(root ? "a root of " : "the root of ") + name +
           (root ? " too many in sample (or r missing from " + blame.function + ")"
                 : " is missing from sample (or the number is squared)") +
           ": " + blame.numerator + " is " + times + " times as large";
  };
  return h;
}

}  // namespace

std::vector<Hypothesis> number_hypotheses(const ReportEvidence& evidence, const Blame& blame) {
  std::vector<Hypothesis> list;
  const SamplingPair& pair = *evidence.views.front().pair;
  if (pair.draw || pair.domain.dimension() == 0) return list;
  for (int n = 0; n < std::min(pair.numbers, pair.domain.dimension()); ++n) {
    for (const bool from_end : {false, true}) {
      for (const double k : {2.0, 0.5, 3.0, 1.0 / 3}) {
        list.push_back(power_of_number(static_cast<std::size_t>(n), from_end, k, blame));
      }
    }
  }
  return list;
}

}  // namespace plumbline::verify
