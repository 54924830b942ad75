#include <gtest/gtest.h>
#include <plumbline_tests/support.h>
#include <stdio.h>
#include <sys/wait.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

/// docs/adding_a_bsdf_shaders.md shows what is compiled, run and printed, and nothing else.
namespace plumbline::tests {
namespace {

struct DocumentBlock {
  std::string source;  ///< "from FILE", "from output" or "exit N", as the comment before it says
  std::string text;
};

std::vector<DocumentBlock> blocks_of_shaders(const std::string& document) {
  std::vector<DocumentBlock> blocks;
  const std::regex pattern("(?:<!-- ((?:from|exit) \\S+) -->\n)?```[a-z]+\n([^`]*)```\n");
  for (auto i = std::sregex_iterator(document.begin(), document.end(), pattern);
       i != std::sregex_iterator(); ++i) {
    blocks.push_back({(*i)[1], (*i)[2]});
  }
  return blocks;
}

/// What does not depend on the machine.
std::string digits_left_out(const std::string& text) {
  return std::regex_replace(text, std::regex("-?[0-9][0-9.e+-]*"), "#");
}

struct ShellOutcome {
  int exit_code = -1;
  std::string output;
};

ShellOutcome run_in_shell(const std::string& command) {
  ShellOutcome outcome;
  FILE* pipe = ::popen(("{ " + command + "} 2>&1").c_str(), "r");
  char buffer[4096];
  for (std::size_t n; (n = ::fread(buffer, 1, sizeof buffer, pipe)) > 0;) {
    outcome.output.append(buffer, n);
  }
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  return outcome;
}

TEST(ShaderTutorial, ShowsWhatIsRunAndPrinted) {
  namespace fs = std::filesystem;
  const ScratchDirectory scratch;
  const fs::path tutorial = source_file("tests/shaders/tutorial");
  for (const char* file : {"mine.glsl", "glossy.json", "before/glossy.glsl"}) {
    fs::copy_file(tutorial / file, scratch / fs::path(file).filename().string());
  }
  fs::create_symlink(source_file("examples/vulkan_glsl"), scratch / "vulkan_glsl");
  fs::create_symlink(PLUMBLINE_SHADER_HOST, scratch / "host");
  const std::string before = "cd '" + scratch.path().string() +
                             "' && export LP_NUM_THREADS=0 PATH=\"" +
                             fs::path(PLUMBLINE_COMMAND).parent_path().string() + ":" +
                             fs::path(PLUMBLINE_GLSLANG).parent_path().string() + ":$PATH\"\n";
  std::string printed;
  int files = 0, outputs = 0;
  for (const DocumentBlock& block :
       blocks_of_shaders(text_of(source_file("docs/adding_a_bsdf_shaders.md")))) {
    ASSERT_NE(block.source, "") << "nothing is named before\n" << block.text;
    const std::string what = block.source.substr(5);
    if (block.source.rfind("exit", 0) == 0) {
      const ShellOutcome outcome = run_in_shell(before + block.text);
      EXPECT_EQ(std::to_string(outcome.exit_code), what) << outcome.output;
      printed = outcome.output;
    } else if (what == "output") {
      EXPECT_NE(digits_left_out(printed).find(digits_left_out(block.text)), std::string::npos)
          << "shown:\n"
          << block.text << "printed:\n"
          << printed;
      ++outputs;
    } else {
      EXPECT_NE(text_of(source_file(what)).find(block.text), std::string::npos)
          << what << " does not hold\n"
          << block.text;
      if (what.find("after") != std::string::npos)
        scratch.write("glossy.glsl", text_of(source_file(what)));
      ++files;
    }
  }
  EXPECT_EQ(files, 4);
  EXPECT_EQ(outputs, 2);
}

TEST(ShaderTutorial, ComparisonSeesAChange) {
  EXPECT_EQ(blocks_of_shaders("<!-- exit 1 -->\n```sh\nfalse\n```\n").at(0).source, "exit 1");
  EXPECT_EQ(digits_left_out("off by 3.1e-05 at"), digits_left_out("off by 2 at"));
  EXPECT_NE(digits_left_out("jacobian: fail"), digits_left_out("jacobian: pass"));
  EXPECT_EQ(run_in_shell("exit 3\n").exit_code, 3);
}

}  // namespace
}  // namespace plumbline::tests
