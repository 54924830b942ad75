#pragma once

#include <plumbline/verify/pair.h>

#include "pairs/binned_pair.h"
#include "pairs/mass_balance.h"

namespace plumbline::verify {

/// The integral check on what is known once the bins are integrated, and better after samples were
/// drawn.
CheckResult judge_integral(const ContractOptions& options, const BinnedPair& binned,
                           const RejectedShare& rejected);

}  // namespace plumbline::verify
