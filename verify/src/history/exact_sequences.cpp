#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <plumbline/verify/history/confidence_sequence.h>

#include "history/code_change.h"
#include "means/proportion_claim.h"
#include "text.h"

namespace plumbline::verify::history {

namespace {

double log_beta(double a, double b) { return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b); }

/// 0 · ln 0 = 0.
double times_log(double count, double p) { return count == 0 ? 0 : count * std::log(p); }

/// ln of the evidence that the hits have against a probability.
double evidence_against(double p, double hits, double misses) {
  return log_beta(hits + 0.5, misses + 0.5) - log_beta(0.5, 0.5) - times_log(hits, p) -
         times_log(misses, 1 - p);
}

/// Where the evidence passes a limit between the share that was seen, where there is least of it,
/// and an end of [0, 1]. Where it does not, the end.
double end_of_interval(double seen, double end, double hits, double misses, double limit) {
  if (evidence_against(end, hits, misses) < limit) return end;
  double inside = seen, outside = end;
  for (int i = 0; i < 100; ++i) {
    const double middle = (inside + outside) / 2;
    (evidence_against(middle, hits, misses) < limit ? inside : outside) = middle;
  }
  return outside;
}

Interval probabilities(double hits, double misses, double level) {
  const double seen = hits / (hits + misses), limit = -std::log(level);
  return {end_of_interval(seen, 0, hits, misses, limit),
          end_of_interval(seen, 1, hits, misses, limit)};
}

}  // namespace

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

bool ProportionSequence::add_night(std::string_view code_hash, std::uint64_t night_hits,
                                   std::uint64_t night_trials) {
  if (night_trials == 0 || night_hits > night_trials) {
    throw std::invalid_argument("sequence of proportions: " + number(night_hits) + " hits of " +
                                number(night_trials) + " say nothing");
  }
  const bool again = start_again(*this, code_hash);
  ++nights;
  hits += night_hits;
  trials += night_trials;
  return again;
}

CheckResult judge_sequence(const ProportionSequence& sequence, const ProportionOptions& claim,
                           const SequenceBudget& budget) {
  CheckResult r;
  r.kind = CheckKind::proportion;
  r.subject = claim.subject;
  r.expected = claim.expected;
  r.samples = sequence.trials;
  r.leaned_on = "binomial mixture over " + number(sequence.nights) + " nights";
  if (sequence.nights == 0) {
    r.reason = "no night is in yet";
    return r;
  }
  const double hits = static_cast<double>(sequence.hits);
  const double misses = static_cast<double>(sequence.trials) - hits;
  const Interval proven = probabilities(hits, misses, budget.pass_level());
  const Interval sure = probabilities(hits, misses, budget.fail_level());
  r.estimate = hits / (hits + misses);
  r.figures = {{"nights", static_cast<double>(sequence.nights)},
               {Figure::hits, hits},
               {Figure::at_least, claim.at_least},
               {Figure::at_most, claim.at_most}};
  judge_proportion_claim(claim, proven, sure, r);
  return r;
}

}  // namespace plumbline::verify::history
