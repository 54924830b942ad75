#include <gtest/gtest.h>
#include <plumbline_tests/support.h>
#include <stdio.h>

#include <regex>
#include <string>
#include <vector>

/// docs/adding_a_bsdf.md shows what is compiled and what is printed, and nothing else.
namespace plumbline::tests {
namespace {

struct Block {
  std::string source;  ///< file it is from, as the comment before it says; empty without one
  std::string text;
};

/// Fenced blocks, each after a line `<!-- from FILE -->`.
std::vector<Block> blocks_of(const std::string& document) {
  std::vector<Block> blocks;
  const std::regex pattern("(?:<!-- from (\\S+) -->\n)?```[a-z]*\n([^`]*)```\n");
  for (auto i = std::sregex_iterator(document.begin(), document.end(), pattern);
       i != std::sregex_iterator(); ++i) {
    blocks.push_back({(*i)[1], (*i)[2]});
  }
  return blocks;
}

/// What does not depend on the compiler, the machine or the directory: numbers and paths left out.
std::string without_numbers(const std::string& text) {
  const std::string no_paths =
      std::regex_replace(text, std::regex("[^ \n]*/(?=\\w+_test.cpp|tutorial_before)"), "");
  return std::regex_replace(no_paths, std::regex("-?[0-9][0-9.e+-]*"), "#");
}

struct Outcome {
  int status = 0;
  std::string output;
};

Outcome run(const std::string& command) {
  Outcome outcome;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  char buffer[4096];
  for (std::size_t n; (n = ::fread(buffer, 1, sizeof buffer, pipe)) > 0;) {
    outcome.output.append(buffer, n);
  }
  outcome.status = ::pclose(pipe);
  return outcome;
}

class Tutorial : public testing::Test {
 protected:
  const std::vector<Block> blocks_ = blocks_of(text_of(source_file("docs/adding_a_bsdf.md")));
};

TEST_F(Tutorial, CodeIsWhatIsCompiled) {
  int compared = 0;
  for (const Block& block : blocks_) {
    ASSERT_NE(block.source, "") << "no file is named before\n" << block.text;
    if (block.source == "output") continue;
    const std::string source = text_of(source_file(block.source));
    EXPECT_NE(source.find(block.text), std::string::npos) << block.source << " does not hold\n"
                                                          << block.text;
    ++compared;
  }
  EXPECT_GE(compared, 4);
}

TEST_F(Tutorial, WrongBsdfFailsWithTheMessageShown) {
  const Outcome outcome = run(PLUMBLINE_TUTORIAL_BEFORE);
  EXPECT_NE(outcome.status, 0);
  const std::string printed = without_numbers(outcome.output);
  int compared = 0;
  for (const Block& block : blocks_) {
    if (block.source != "output") continue;
    EXPECT_NE(printed.find(without_numbers(block.text)), std::string::npos)
        << "shown:\n"
        << block.text << "printed:\n"
        << outcome.output;
    ++compared;
  }
  EXPECT_EQ(compared, 1);
}

TEST_F(Tutorial, ComparisonSeesAChange) {
  // The negative control of the above.
  EXPECT_EQ(blocks_of("<!-- from a.h -->\n```cpp\nint x;\n```\n").at(0).source, "a.h");
  EXPECT_EQ(without_numbers("off by 3.1e-05 at"), without_numbers("off by 2 at"));
  EXPECT_NE(without_numbers("jacobian: fail"), without_numbers("jacobian: pass"));
}

}  // namespace
}  // namespace plumbline::tests
