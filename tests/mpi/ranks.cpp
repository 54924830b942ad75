#include "ranks.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>

namespace plumbline::tests {
namespace {

constexpr const char* kRank = "OMPI_COMM_WORLD_RANK=";

std::string content_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

std::string in_ranks(int count) {
  return "env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
         "OMPI_MCA_rmaps_base_oversubscribe=1 "
         // Containers forbid processes to read each other's memory.
         "OMPI_MCA_btl_vader_single_copy_mechanism=none " PLUMBLINE_MPIEXEC " -n " +
         std::to_string(count);
}

Outcome run_in_ranks(const std::filesystem::path& directory, int count,
                     const std::string& arguments) {
  return run_plumbline(directory, arguments + " --mpi", in_ranks(count));
}

std::vector<pid_t> ranks_of(pid_t mpirun) {
  const std::string id = std::to_string(mpirun);
  std::ifstream children("/proc/" + id + "/task/" + id + "/children");
  std::map<int, pid_t> ranks;
  for (pid_t child = 0; children >> child;) {
    const std::string environment = content_of("/proc/" + std::to_string(child) + "/environ");
    const std::size_t at = environment.find(kRank);
    if (at == std::string::npos) continue;
    ranks[std::stoi(environment.substr(at + std::string(kRank).size()))] = child;
  }
  std::vector<pid_t> processes;
  for (const auto& [rank, process] : ranks) processes.push_back(process);
  return processes;
}

void expect_same_bits(const std::filesystem::path& directory, const std::string& a,
                      const std::string& b) {
  const Outcome compared = run_plumbline(directory, "compare " + a + " " + b + " --exact");
  EXPECT_EQ(compared.exit_code, 0) << compared.out << compared.err;
}

}  // namespace plumbline::tests
