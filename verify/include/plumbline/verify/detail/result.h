#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plumbline::verify {

/// What a check concludes. `pass` is a proof (a bound at the stated confidence), `fail` is a proof
/// of a difference, everything else is `inconclusive`.
enum class Verdict { pass, fail, inconclusive };

/// "pass", "fail" or "inconclusive".
std::string_view to_string(Verdict verdict);

inline constexpr double kNotApplicable = std::numeric_limits<double>::quiet_NaN();

/// The outcome of one check. Plain data: what a person needs to act on it, what the page shows, and
/// what replays it. Fields that a kind of check has no use for stay NaN (`kNotApplicable`) or
/// empty.
struct CheckResult {
  std::string check;    ///< kind of check: "mean", "chi_square", "variance_ratio", "integral", …
  std::string subject;  ///< what was checked, coarse to fine: "furnace_sphere/mis/power"
  Verdict verdict = Verdict::inconclusive;
  Verdict expected = Verdict::pass;  ///< what the check declares that it must give

  double estimate = kNotApplicable;       ///< in units of the quantity
  double reference = kNotApplicable;      ///< the known answer, same units
  double tolerance = kNotApplicable;      ///< largest |bias| that a pass allows, same units
  double bound = kNotApplicable;          ///< proven: |bias| <= bound with 99.9 % confidence
  double detectable = kNotApplicable;     ///< smallest effect that fails with 99 % probability
  double p_value = kNotApplicable;        ///< of the null hypothesis "no difference"
  double interval_low = kNotApplicable;   ///< 99.9 % confidence interval of `estimate`
  double interval_high = kNotApplicable;  ///< 99.9 % confidence interval of `estimate`
  std::uint64_t samples = 0;
  double seconds = 0;

  std::string leaned_on;  ///< assumption behind the verdict: "exact variance", "skewness guard", …
  std::string reason;     ///< why it failed or stayed inconclusive, one sentence for a person
  std::string diagnosis;  ///< what is likely wrong, and how well that fits; empty if nothing fits
  std::uint64_t seed = 0;
  std::string replay;  ///< one command that repeats the check; filled in by the suite that ran it

  /// Further numbers worth keeping (degrees of freedom, bins, a variance), by name.
  std::vector<std::pair<std::string, double>> figures;

  /// The gate's question.
  bool as_expected() const { return verdict == expected; }
};

/// Several lines for a person: subject, verdict against expectation, the numbers, where, why,
/// replay.
std::string describe(const CheckResult& result);

}  // namespace plumbline::verify
