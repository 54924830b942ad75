#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cstddef>
#include <filesystem>
#include <string>

#include <plumbline/renderer/image_io/exr.h>

#include "ranks.h"

/// The job files of examples/slurm do what they say, with stand-ins for Slurm's own commands.
namespace plumbline::tests {
namespace {

const std::string kOptions = " --size 8x6 --spp 8 ";

class SlurmJobs : public testing::Test {
 protected:
  SlurmJobs() {
    // srun starts as many ranks as it is told to, two where it is not.
    write_program("srun",
                  "ranks=2\n"
                  "while :; do\n"
                  "  case $1 in --ntasks=*) ranks=${1#--ntasks=};; --*) ;; *) break;; esac\n"
                  "  shift\n"
                  "done\n"
                  "[ $ranks -ne 1 ] || exec \"$@\"\n"
                  "exec " +
                      in_ranks(2) + " \"$@\"\n");
    write_program("scontrol", "echo \"$@\" >requeued\n");
  }

  void write_program(const std::string& name, const std::string& script) {
    std::filesystem::permissions(scratch_.write(name, "#!/bin/sh\n" + script),
                                 std::filesystem::perms::owner_all);
  }

  /// Runs a job file and then, if it ends well, the command.
  Outcome run(const std::string& variables, const std::string& job, const std::string& then) {
    const std::string environment =
        "env PATH=\"$PWD:$PATH\" PLUMBLINE='" PLUMBLINE_COMMAND "' SLURM_JOB_ID=7 ";
    const std::string file = source_file("examples/slurm").string() + "/" + job;
    return run_plumbline(scratch_.path(), then, environment + variables + " bash " + file + " &&");
  }

  const ScratchDirectory scratch_;
};

TEST_F(SlurmJobs, OfRanksAndOfShardsMakeTheImageOfOneProcess) {
  const std::string render = "sphere_light" + kOptions;
  ASSERT_EQ(run_plumbline(scratch_.path(), "render -o whole.exr " + render).exit_code, 0);
  const Outcome ranks =
      run("", "ranks.sbatch sphere_light ranks" + kOptions, "compare whole.exr ranks.exr --exact");
  EXPECT_EQ(ranks.exit_code, 0) << ranks.out << ranks.err;
  for (const std::string task : {"1", "2", "2"}) {  // the last one goes on from what is there
    const Outcome shard = run("SLURM_ARRAY_TASK_ID=" + task + " SLURM_ARRAY_TASK_MAX=2",
                              "shards.sbatch sphere_light parts" + kOptions, "--version");
    EXPECT_EQ(shard.exit_code, 0) << shard.err;
  }
  const Outcome merged = run("", "merge.sbatch parts merged.exr", "--version");
  EXPECT_EQ(merged.exit_code, 0) << merged.err;
  // Of the header, merge says other things.
  const renderer::Image whole = renderer::read_exr(scratch_ / "whole.exr");
  const renderer::Image of_shards = renderer::read_exr(scratch_ / "merged.exr");
  ASSERT_EQ(of_shards.pixels.size(), whole.pixels.size());
  for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
    EXPECT_EQ(of_shards.pixels[i].r, whole.pixels[i].r) << i;
    EXPECT_EQ(of_shards.variance[i].g, whole.variance[i].g) << i;
    EXPECT_EQ(of_shards.count[i], 8) << i;
  }
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "requeued"));
}

TEST_F(SlurmJobs, ThatWereStoppedAreQueuedAgain) {
  write_program("srun", "exit 138\n");
  EXPECT_EQ(run("", "ranks.sbatch scene ranks", "--version").exit_code, 0);
  EXPECT_EQ(scratch_.read("requeued"), "requeue 7\n");
  EXPECT_EQ(run("SLURM_ARRAY_JOB_ID=8 SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_MAX=4",
                "shards.sbatch scene parts", "--version")
                .exit_code,
            0);
  EXPECT_EQ(scratch_.read("requeued"), "requeue 8_3\n");
  write_program("srun", "exit 3\n");
  EXPECT_EQ(run("", "ranks.sbatch scene ranks", "--version").exit_code, 3);
}

}  // namespace
}  // namespace plumbline::tests
