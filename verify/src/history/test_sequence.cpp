#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <plumbline/verify/history/confidence_sequence.h>

#include "history/code_change.h"
#include "text.h"

namespace plumbline::verify::history {

bool TestSequence::add_night(std::string_view code_hash, double p_value) {
  if (!(p_value >= 0 && p_value <= 1)) {
    throw std::invalid_argument("sequence of tests: " + number(p_value) + " is no p-value");
  }
  const bool again = start_again(*this, code_hash);
  ++nights;
  minus_log_p -= std::log(p_value);
  return again;
}

double TestSequence::log_evidence() const {
  const double n = static_cast<double>(nights), sum = minus_log_p;
  if (std::isinf(sum)) return sum;
  // ∫ κ^n e^((1 − κ) L) dκ over (0, 1) = Σ L^k / ((n + 1) … (n + 1 + k)), by parts; with the powers
  // of two taken out that would overflow.
  constexpr double kLarge = 0x1p900;
  double term = 1 / (n + 1), total = term, taken_out = 0;
  for (double k = 1; term > total * 1e-17 || k < sum - n; ++k) {
    term *= sum / (n + 1 + k);
    total += term;
    if (total > kLarge) {
      term /= kLarge;
      total /= kLarge;
      taken_out += std::log(kLarge);
    }
  }
  return std::log(total) + taken_out;
}

CheckResult judge_sequence(const TestSequence& sequence, std::string subject,
                           const SequenceBudget& budget, CheckKind kind) {
  CheckResult r;
  r.kind = kind;
  r.subject = std::move(subject);
  r.expected = Verdict::inconclusive;
  r.leaned_on = "evidence of " + number(sequence.nights) + " nights";
  const double evidence = sequence.log_evidence();
  r.p_value = std::exp(-std::max(0.0, evidence));
  r.figures = {{"nights", static_cast<double>(sequence.nights)}, {"log evidence", evidence}};
  if (sequence.nights > 0 && evidence >= -std::log(budget.fail_level())) {
    r.verdict = Verdict::fail;
    r.reason = "the p-values of " + number(sequence.nights) +
               " nights are together too small: evidence e^" + number(evidence);
  } else {
    r.reason = "nothing is proven against it in " + number(sequence.nights) + " nights";
  }
  return r;
}

}  // namespace plumbline::verify::history
