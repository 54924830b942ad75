#pragma once

#include <functional>
#include <string>
#include <vector>

#include <plumbline/mpi/ranks.h>
#include <plumbline/verify/detail/result.h>

#include "verify_options.h"

/// Many programs and seeds, checked one after the other or by the ranks of an mpirun.
namespace plumbline::tools {

/// Where the results of all go: in their order, however many ranks there are.
using KeepResults = std::function<void(const std::vector<verify::CheckResult>&)>;

/// @throws mpi::AgreedFailure where a rank has other entries, or is of another version
void require_one_suite(mpi::Ranks& ranks, const std::vector<SuiteEntry>& entries);

/// Checks all of them, prints those that are not as they should be, and says how many are. To be
/// called by all ranks with the same entries; the first one prints and keeps.
///
/// @param ranks  may be null: all by this process
/// @return 0, 1 where a check did not give its verdict, 2 where a program could not be checked
int run_suite(mpi::Ranks* ranks, const std::vector<SuiteEntry>& entries, const KeepResults& keep);

}  // namespace plumbline::tools
