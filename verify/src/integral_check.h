#pragma once

#include <plumbline/verify/contract.h>

#include "binned_pair.h"
#include "mass_balance.h"

namespace plumbline::verify {

/// The integral check on what is known once the bins are integrated, and better after samples were
/// drawn.
CheckResult judge_integral(const ContractOptions& options, const BinnedPair& binned,
                           const RejectedShare& rejected);

}  // namespace plumbline::verify
