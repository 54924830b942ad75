#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace plumbline::tests {

/// One way in which a file leaves the supported subset, and the words it is refused with.
struct Refusal {
  const char* name;
  const char* text;      ///< whole file, or body from line 3 on where it does not start a file
  const char* expected;  ///< after "scene.xml:"
};

inline void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }

inline std::string name_of(const testing::TestParamInfo<Refusal>& tested) {
  return tested.param.name;
}

}  // namespace plumbline::tests
