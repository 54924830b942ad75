#pragma once

#include <cstdint>
#include <string>

#include <plumbline/verify/budget.h>
#include <plumbline/verify/result.h>

namespace plumbline::verify {

/// A claim about a probability.
struct ProportionOptions {
  std::string subject;
  double at_least = 0;  ///< claim: probability ≥ this
  double at_most = 1;   ///< claim: probability ≤ this
  Verdict expected = Verdict::pass;
  std::uint64_t seed = 0;
  ErrorBudget budget;
};

/// Whether the probability of an event keeps a claim, from how often it happened: a hit rate, the
/// share of runs that fail. The interval is exact for independent trials, whatever the probability.
///
/// `pass` if the 99.9 % interval lies within the claim, `fail` if the claim is proven broken at the
/// level of the error budget, else `inconclusive`.
///
/// @param hits, trials  how often it happened, of how many independent trials; hits ≤ trials ≥ 1
/// @throws std::invalid_argument for counts or a claim that make no sense
/// @source Clopper, Pearson 1934 (Biometrika 26:4)
CheckResult check_proportion(const ProportionOptions& options, std::uint64_t hits,
                             std::uint64_t trials);

}  // namespace plumbline::verify
