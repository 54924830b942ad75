#pragma once

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "corpus.h"

/// PLUMBLINE_FAULTS_OFF in the environment switches all faults of this set off: the same code, put
/// up as correct.
namespace plumbline::tests::corpus::fourth {

inline bool faults_off() {
  static const bool off = std::getenv("PLUMBLINE_FAULTS_OFF") != nullptr;
  return off;
}

inline int on(int fault) { return faults_off() ? 0 : fault; }

inline std::string said(const char* fault) { return faults_off() ? std::string() : fault; }

}  // namespace plumbline::tests::corpus::fourth
