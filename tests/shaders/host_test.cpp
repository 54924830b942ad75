#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cstddef>
#include <string>
#include <vector>

#include <plumbline/exchange/answerer.h>

#include "command_line.h"
#include "shaders.h"

/// What the host says where it cannot work: at once, in words, and plumbline's exit code is 2.
namespace plumbline::tests {
namespace {

const std::string kGgx = text_of(PLUMBLINE_SHADER_MODULES "/ggx.spv");

class ShaderHost : public testing::Test {
 protected:
  void expect_refusal(const std::string& command, const std::string& message) const {
    const Outcome outcome =
        run_plumbline(scratch_.path(), "verify --quick --exec \"" + command + "\"");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out << outcome.err;
    EXPECT_NE(outcome.err.find("host: " + message), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("ended with exit status 2"), std::string::npos) << outcome.err;
  }

  void expect_refusal_of_module(const std::string& bytes, const std::string& message) const {
    scratch_.write("mine.spv", bytes);
    expect_refusal(PLUMBLINE_SHADER_HOST " mine.spv", "mine.spv: " + message);
  }

  const ScratchDirectory scratch_;
};

TEST_F(ShaderHost, RefusesWhatIsNoModule) {
  expect_refusal(PLUMBLINE_SHADER_HOST " missing.spv", "missing.spv: cannot be read");
  expect_refusal_of_module("", "is no SPIR-V module");
  expect_refusal_of_module("#version 450\nvoid main() {}\n", "is no SPIR-V module");
  expect_refusal_of_module(kGgx.substr(0, kGgx.size() - 3), "is no SPIR-V module");
}

TEST_F(ShaderHost, RefusesAnInvalidModule) {
  expect_refusal_of_module(kGgx.substr(0, kGgx.size() / 8 * 4), "is invalid SPIR-V: ");
  std::string changed = kGgx;
  for (std::size_t i = changed.size() / 2; i < changed.size() / 2 + 16; ++i) changed[i] = '\x7f';
  expect_refusal_of_module(changed, "is invalid SPIR-V: ");
}

/// Two words of the module's: the binding of a variable, its descriptor set.
std::string with_decoration(std::string module, char decoration, char old_value, char value) {
  const std::string old{decoration, 0, 0, 0, old_value, 0, 0, 0};
  const std::size_t at = module.find(old);
  EXPECT_NE(at, std::string::npos);
  module[at + 4] = value;
  return module;
}

TEST_F(ShaderHost, RefusesAnotherInterface) {
  expect_refusal_of_module(with_decoration(kGgx, 33, 5, 6), "uses binding 6; those of verify.comp");
  expect_refusal_of_module(with_decoration(kGgx, 34, 0, 1), "uses a descriptor set beside 0");
}

TEST_F(ShaderHost, SaysThatThereIsNoDevice) {
  const std::string ggx = PLUMBLINE_SHADER_HOST " " PLUMBLINE_SHADER_MODULES "/ggx.spv";
  expect_refusal("VK_ICD_FILENAMES=/dev/null VK_DRIVER_FILES=/dev/null " + ggx, "no Vulkan driver");
  expect_refusal(ggx + " --device nosuch", "no Vulkan device has");
  expect_refusal("PLUMBLINE_VULKAN_DEVICE=nosuch " + ggx, "no Vulkan device has");
  expect_refusal(PLUMBLINE_SHADER_HOST, "usage: host MODULE.spv");
}

/// On the CPU, for a GPU that computes for too long is reset, with all that others do on it.
TEST(SlowShader, IsGivenUp) {
  exchange::Answerer host({host_command("slow") + " --device llvmpipe --wait 1", {}});
  const std::vector<verify::Vec3> directions(100'000, {0.6, 0, 0.8});
  std::vector<double> pdfs(directions.size());
  try {
    host.pdf(directions, directions, pdfs);
    FAIL() << "it has ended";
  } catch (const exchange::AnswererError& error) {
    EXPECT_NE(std::string(error.what()).find("exit status 2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace plumbline::tests
