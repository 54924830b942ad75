#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <string>

#include <plumbline/verify/gtest.h>

#include "all_cases.h"

namespace plumbline::tests::corpus {
namespace {

/// GoogleTest takes letters, digits and underscores only; the number keeps names apart that differ
/// in nothing else.
std::string test_name(const testing::TestParamInfo<Case>& info) {
  std::string name;
  for (const char c : info.param.name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (plain) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  return name + "_" + std::to_string(info.index);
}

class CorrectCode : public testing::TestWithParam<Case> {};

TEST_P(CorrectCode, Passes) {
  const Results results = GetParam().run(check_seed(GetParam().name), Effort::gate);
  PLUMBLINE_EXPECT_PASS(repeatable(results));
}

class FaultyTwin : public testing::TestWithParam<Case> {};

TEST_P(FaultyTwin, IsFound) {
  const Results results = GetParam().run(check_seed(GetParam().name), Effort::gate);
  EXPECT_TRUE(std::any_of(results.begin(), results.end(), [](const verify::CheckResult& r) {
    return r.verdict == verify::Verdict::fail;
  })) << GetParam().fault;
}

INSTANTIATE_TEST_SUITE_P(Corpus, CorrectCode, testing::ValuesIn(all_cases(Half::correct)),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Corpus, FaultyTwin, testing::ValuesIn(all_cases(Half::open)), test_name);

}  // namespace

/// GoogleTest prints parameters, in bytes where it does not know better.
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

}  // namespace plumbline::tests::corpus
