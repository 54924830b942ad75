#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <string>

#include "command_line.h"

namespace plumbline::tests {
namespace {

struct Example {
  const char* language;
  std::string command;  ///< empty where nothing here runs it
};

class ExampleAnswerer : public testing::TestWithParam<Example> {
 protected:
  void SetUp() override {
    if (GetParam().command.empty()) GTEST_SKIP() << "nothing here runs " << GetParam().language;
  }

  Outcome run_verify(const std::string& arguments,
                     const std::string& program_arguments = "") const {
    return run_plumbline(scratch_.path(), "verify --exec '" + GetParam().command +
                                              program_arguments + "' " + arguments);
  }

 private:
  ScratchDirectory scratch_;
};

TEST_P(ExampleAnswerer, KeepsToTheProtocol) {
  const Outcome outcome = run_verify("--self-test");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

TEST_P(ExampleAnswerer, Passes) {
  const Outcome outcome = run_verify("--quick --angles 0,60");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

TEST_P(ExampleAnswerer, WithAFaultFailsWithTheCause) {
  const Outcome outcome = run_verify("--quick --angles 60 --faces front", " --faulty");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("likely cause: factor cosθi missing from pdf()"), std::string::npos)
      << outcome.out;
}

INSTANTIATE_TEST_SUITE_P(Languages, ExampleAnswerer,
                         testing::Values(Example{"Python", PLUMBLINE_PYTHON_EXAMPLE},
                                         Example{"JavaScript", PLUMBLINE_NODE_EXAMPLE},
                                         Example{"Go", PLUMBLINE_GO_EXAMPLE}),
                         [](const auto& language) { return language.param.language; });

}  // namespace
}  // namespace plumbline::tests
