#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <string>

#include <plumbline/output/checkpoint.h>
#include <plumbline/renderer/image_io/exr.h>

#include "ranks.h"

/// A rank that dies, hangs or is told to stop ends the job, and what was kept is gone on with.
namespace plumbline::tests {
namespace {

const std::string kRender = "render glass_sphere --size 8x6 --threads 1 -o out.exr ";
constexpr int kRanks = 3;

/// A long render that keeps what it has done, until all ranks have a part in that.
class FailedRanks : public testing::Test {
 protected:
  explicit FailedRanks(const std::string& options = "")
      : running_(scratch_.path(),
                 kRender + "--spp 100000000 --checkpoint state --every 0.1 --mpi " + options,
                 in_ranks(kRanks)) {}

  void SetUp() override {
    ASSERT_TRUE(running_.waits_for([&] { return is_kept_of_all(); }));
    ASSERT_EQ(ranks_of(running_.process()).size(), static_cast<std::size_t>(kRanks));
  }

  pid_t rank(std::size_t number) const { return ranks_of(running_.process())[number]; }

  bool is_kept_of_all() const {
    return std::filesystem::exists(scratch_ / "state") && state().least_drawn() > 0;
  }

  renderer::RenderState state() const { return output::read_checkpoint(scratch_ / "state").state; }

  /// What was kept and one sample more, by two ranks, is what one process renders.
  void expect_goes_on() const {
    std::uint32_t most = 0;
    for (const std::uint32_t drawn : state().drawn) most = std::max(most, drawn);
    const std::string render = kRender + "--spp " + std::to_string(most + 1);
    const Outcome on = run_in_ranks(scratch_.path(), 2, render + " --resume state");
    ASSERT_EQ(on.exit_code, 0) << on.err;
    std::filesystem::rename(scratch_ / "out.exr", scratch_ / "on.exr");
    ASSERT_EQ(run_plumbline(scratch_.path(), render).exit_code, 0);
    expect_same_bits(scratch_.path(), "out.exr", "on.exr");
  }

  const ScratchDirectory scratch_;
  Running running_;
};

class HungRanks : public FailedRanks {
 protected:
  HungRanks() : FailedRanks("--mpi-timeout 4") {}
};

TEST_F(FailedRanks, ThatDieEndTheJobWithTheirName) {
  kill(rank(1), SIGKILL);
  const Outcome outcome = running_.ended();
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("rank 1 "), std::string::npos) << outcome.err;
  expect_goes_on();
}

TEST_F(HungRanks, EndTheJobWithTheirName) {
  const pid_t hung = rank(1);
  kill(hung, SIGSTOP);
  const Outcome outcome = running_.ended();
  EXPECT_EQ(outcome.exit_code, 3);
  const std::string silence = "plumbline: rank 1 (process " + std::to_string(hung) + " on ";
  EXPECT_NE(outcome.err.find(silence), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("has said nothing for 4 s; the job ends"), std::string::npos);
  EXPECT_EQ(outcome.err.find("plumbline: rank 0"), std::string::npos) << outcome.err;
  EXPECT_GT(state().least_drawn(), 0u);
}

TEST_F(FailedRanks, ThatAreToldToStopThroughMpirunKeepTheSamplesOfAll) {
  running_.signal(SIGUSR1);
  const Outcome outcome = running_.ended();
  EXPECT_EQ(outcome.exit_code, 128 + SIGUSR1) << outcome.err;
  EXPECT_NE(outcome.err.find("plumbline: stopped by signal 10 at "), std::string::npos);
  EXPECT_NE(outcome.err.find("the same command with --resume state goes on"), std::string::npos);
  const renderer::Image image = renderer::read_exr(scratch_ / "out.exr");
  const float least = std::stof(image.metadata.at("samples"));
  for (const float count : image.count) EXPECT_GE(count, least);
  EXPECT_EQ(scratch_.listing(), "out.exr state");
  expect_goes_on();
}

TEST_F(FailedRanks, OfWhichOneIsToldToStopAllStop) {
  kill(rank(2), SIGTERM);
  const Outcome outcome = running_.ended();
  EXPECT_EQ(outcome.exit_code, 128 + SIGTERM) << outcome.err;
  EXPECT_NE(outcome.err.find("plumbline: stopped by signal 15 at "), std::string::npos);
  EXPECT_EQ(scratch_.listing(), "out.exr state");
}

}  // namespace
}  // namespace plumbline::tests
