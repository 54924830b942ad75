#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "targets.h"

/// Every input that lies in tests/fuzz/inputs, once: those that the fuzzer starts from, and those
/// that it has found something with.
namespace plumbline::tests {
namespace {

class FuzzInputs : public testing::TestWithParam<FuzzTarget> {};

TEST_P(FuzzInputs, AreReadOrRefused) {
  int count = 0;
  const auto folder = std::filesystem::path(PLUMBLINE_FUZZ_INPUTS) / GetParam().name;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NO_THROW(GetParam().run(bytes));
    ++count;
  }
  EXPECT_GT(count, 0) << "no inputs in " << folder;
}

INSTANTIATE_TEST_SUITE_P(All, FuzzInputs, testing::ValuesIn(kFuzzTargets),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace plumbline::tests
