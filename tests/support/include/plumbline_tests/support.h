#pragma once

#include <cstdint>
#include <string>

#include <plumbline/verify/result.h>

namespace plumbline::tests {

/// Seed of this run: the environment variable PLUMBLINE_SEED, or the gate's fixed one. At night a fresh
/// seed is set from outside.
std::uint64_t run_seed();

/// Whether the nightly configuration asks for full grids (PLUMBLINE_NIGHTLY=1).
bool nightly();

/// Holds a result against its expectation: adds a GoogleTest failure that explains itself if it differs,
/// fills in the replay command of the running test, and appends the result to the results directory
/// ($PLUMBLINE_RESULTS, if set) for the page.
void expect_verdict(verify::CheckResult result);

}  // namespace plumbline::tests
