#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "command_line.h"

/// The command in several ranks, as mpirun starts them.
namespace plumbline::tests {

/// What stands before the command: `mpirun` with so many ranks, as any user, on any machine. What
/// Open MPI asks for is said in its variables, which others ignore.
std::string in_ranks(int count);

/// Runs `plumbline ARGUMENTS` in ranks.
Outcome run_in_ranks(const std::filesystem::path& directory, int count,
                     const std::string& arguments);

/// The processes of the ranks of an mpirun, in their order; fewer while they start.
std::vector<pid_t> ranks_of(pid_t mpirun);

/// Expects that `plumbline compare --exact` finds no difference.
void expect_same_bits(const std::filesystem::path& directory, const std::string& a,
                      const std::string& b);

}  // namespace plumbline::tests
