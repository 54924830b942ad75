#pragma once

#include <plumbline_tests/support.h>

#include <cstdint>
#include <string>

#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/history/confidence_sequence.h>
#include <plumbline/verify/ratio.h>

/// How often a sequence over the nights errs in its life, at levels that can be simulated.
namespace plumbline::verify::history {

/// One sequence, whose fails may come with a probability that can be simulated.
inline SequenceBudget inflated(double level) {
  SequenceBudget budget;
  budget.life_level = level;
  budget.max_sequences = 1;
  return budget;
}

/// Of so many lifetimes, the share in which something ever happens, against a claim.
template <class Happens>
CheckResult share_of_lifetimes(const std::string& subject, std::uint64_t lifetimes, double at_least,
                               double at_most, Verdict expected, Happens happens) {
  ProportionOptions options;
  options.subject = subject;
  options.seed = tests::check_seed(subject);
  options.at_least = at_least;
  options.at_most = at_most;
  options.expected = expected;
  Random random(options.seed);
  std::uint64_t hits = 0;
  for (std::uint64_t i = 0; i < lifetimes; ++i) hits += happens(random) ? 1u : 0u;
  return check_proportion(options, hits, lifetimes);
}

}  // namespace plumbline::verify::history
