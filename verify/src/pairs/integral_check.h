#pragma once

#include <plumbline/verify/pair.h>

#include "pairs/binned_pair.h"
#include "pairs/rejected_share.h"

namespace plumbline::verify {

/// ∫pdf + atoms + rejected share, which add up to 1.
struct MassBalance {
  const MassIntegral& integral;
  double atoms = 0;
  RejectedShare rejected;

  double excess() const { return integral.total + atoms + rejected.value - 1; }

  /// |excess − truth| ≤ this with probability 1 − level.
  double error(double level) const { return integral.error(level / 2) + rejected.error(level / 2); }
};

MassBalance balance_mass(const BinnedPair& pair, const RejectedShare& rejected);

/// |excess| that is held against the pair: what the user states, or the strict promise.
double mass_tolerance(const ContractOptions& options, const BinnedPair& pair);

CheckResult judge_integral(const ContractOptions& options, const BinnedPair& binned,
                           const RejectedShare& rejected);

}  // namespace plumbline::verify
