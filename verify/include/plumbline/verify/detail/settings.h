#pragma once

#include <cstdint>

#include <plumbline/verify/detail/budget.h>

namespace plumbline::verify {

/// What every check is given: the options of each derive from it.
struct CheckSettings {
  /// Of the random numbers that the check draws. Where the samples are the caller's (means, ratios,
  /// images) it is only passed on to the result.
  std::uint64_t seed = 1;

  /// How often correct code may fail. The same for all checks of a suite.
  ErrorBudget budget;
};

}  // namespace plumbline::verify
