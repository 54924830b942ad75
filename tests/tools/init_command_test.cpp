#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <string>

#include "command_line.h"

namespace plumbline::tests {
namespace {

TEST(InitCommand, WritesAProjectAndSaysHowToRunIt) {
  const ScratchDirectory scratch;
  const Outcome cpp = run_plumbline(scratch.path(), "init a");
  EXPECT_EQ(cpp.exit_code, 0) << cpp.err;
  EXPECT_NE(cpp.out.find("cmake -S a -B a/build"), std::string::npos) << cpp.out;
  EXPECT_NE(scratch.read("a/my_bsdf_test.cpp").find("check_bsdf"), std::string::npos);
  const Outcome python = run_plumbline(scratch.path(), "init b/c --language python");
  EXPECT_EQ(python.exit_code, 0) << python.err;
  EXPECT_NE(python.out.find("python3 -m pytest b/c"), std::string::npos) << python.out;
  EXPECT_NE(scratch.read("b/c/test_my_bsdf.py").find("check_bsdf"), std::string::npos);
}

TEST(InitCommand, WritesNothingOver) {
  const ScratchDirectory scratch;
  scratch.write("my_bsdf.h", "mine");
  const Outcome outcome = run_plumbline(scratch.path(), "init .");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("my_bsdf.h: is there already; nothing was written"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(scratch.listing(), "my_bsdf.h");
  EXPECT_EQ(scratch.read("my_bsdf.h"), "mine");
}

TEST(InitCommand, RefusesWhatIsNoDirectory) {
  const ScratchDirectory scratch;
  scratch.write("file", "");
  for (const char* arguments : {"init file", "init file/below", "init", "init x --language java"}) {
    EXPECT_EQ(run_plumbline(scratch.path(), arguments).exit_code, 2) << arguments;
  }
  EXPECT_EQ(scratch.listing(), "file");
}

}  // namespace
}  // namespace plumbline::tests
