#pragma once

#include <cstdlib>
#include <string>

/// With PLUMBLINE_FAULTS_OFF in the environment no fault of this set is put in, and each twin
/// enters as correct code.
namespace plumbline::tests::corpus::fifth {

inline bool without_faults() {
  static const bool without = std::getenv("PLUMBLINE_FAULTS_OFF") != nullptr;
  return without;
}

/// The number of the fault, 0 where none is put in.
inline int put(int fault) { return without_faults() ? 0 : fault; }

/// What was done, nothing where none is put in.
inline std::string because(const char* words) { return without_faults() ? "" : words; }

}  // namespace plumbline::tests::corpus::fifth
