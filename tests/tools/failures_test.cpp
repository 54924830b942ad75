#include <gtest/gtest.h>
#include <plumbline_tests/support.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <plumbline/output/failure.h>
#include <plumbline/renderer/core/errors.h>

#include "command_line.h"

/// Whatever fails, the exit code says whose fault it is, and what is opened at the start stays what
/// it is.
namespace plumbline::tests {
namespace {

TEST(Failures, HaveTheExitCodeOfWhoseFaultTheyAre) {
  const auto code_of = [](const std::exception_ptr& thrown) {
    return output::failure_of(thrown).exit_code;
  };
  const auto code_of_errno = [&](int error) {
    return code_of(
        std::make_exception_ptr(std::system_error(error, std::generic_category(), "path")));
  };
  EXPECT_EQ(code_of(std::make_exception_ptr(renderer::InputError("x"))), 2);
  EXPECT_EQ(code_of(std::make_exception_ptr(std::invalid_argument("x"))), 2);
  EXPECT_EQ(code_of(std::make_exception_ptr(renderer::MachineError("x"))), 3);
  EXPECT_EQ(code_of(std::make_exception_ptr(std::bad_alloc())), 3);
  EXPECT_EQ(code_of(std::make_exception_ptr(std::logic_error("x"))), 3);
  EXPECT_EQ(code_of(std::make_exception_ptr(1)), 3);
  for (const int error : {ENOSPC, EDQUOT, EFBIG, EIO, ENOMEM, EAGAIN, EMFILE, ENFILE}) {
    EXPECT_EQ(code_of_errno(error), 3) << error;
  }
  for (const int error : {ENOENT, EACCES, EPERM, EROFS, ELOOP, ENOTDIR, EISDIR, ENAMETOOLONG}) {
    EXPECT_EQ(code_of_errno(error), 2) << error;
  }
}

TEST(Failures, OfADiskAreTheMachinesInEveryCommand) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch / "results");
  std::filesystem::create_symlink("/dev/full", scratch / "results/calibration.jsonl");
  const std::string calibrate = "calibrate --only \"agreement, same seed\" --results ";
  EXPECT_EQ(run_plumbline(scratch.path(), calibrate + "results").exit_code, 3);
  EXPECT_EQ(run_plumbline(scratch.path(), calibrate + "small", "ulimit -f 0;").exit_code, 3);
  ASSERT_EQ(run_plumbline(scratch.path(), calibrate + "fine").exit_code, 0);
  scratch.write("page.html", "old");
  const Outcome outcome = run_plumbline(scratch.path(), "report fine -o page.html", "ulimit -f 1;");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("plumbline: page.html: "), std::string::npos) << outcome.err;
  EXPECT_EQ(scratch.read("page.html"), "old");
  EXPECT_EQ(scratch.listing(), "fine page.html results small");
}

TEST(Failures, OfAPathAreTheUsers) {
  const ScratchDirectory scratch;
  std::filesystem::create_symlink("loop.exr", scratch / "loop.exr");
  for (const std::string arguments :
       {"compare loop.exr loop.exr", "render loop.exr -o x.exr", "report loop.exr -o x.html",
        "render furnace_open -o loop.exr", "history list --history loop.exr", "init loop.exr",
        "calibrate --only \"agreement, same seed\" --results loop.exr"}) {
    const Outcome outcome = run_plumbline(scratch.path(), arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << ": " << outcome.err;
    EXPECT_NE(outcome.err, "") << arguments;
  }
  EXPECT_EQ(scratch.listing(), "loop.exr");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these need threads too
TEST(Failures, OfThreadsAreTheMachines) {
  const ScratchDirectory scratch;
  // Root has as many threads as it likes.
  const std::string as_nobody =
      geteuid() == 0 ? "setpriv --reuid 65533 --clear-groups env " : "env ";
  if (run_plumbline(scratch.path(), "list scenes", "prlimit --nproc=99 " + as_nobody).exit_code !=
      0) {
    GTEST_SKIP() << "nobody else may run the command here";
  }
  std::filesystem::permissions(scratch.path(), std::filesystem::perms::all);
  const Outcome outcome =
      run_plumbline(scratch.path(), "render furnace_open -o x.exr --spp 1 --size 8x8 --threads 4",
                    "prlimit --nproc=1 " + as_nobody);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_EQ(scratch.listing(), "");
}
#endif

TEST(Start, AFileThatIsOpenedDoesNotBecomeTheStandardOutput) {
  const ScratchDirectory scratch;
  const std::string calibrate = "calibrate --only \"agreement, same seed\" --results ";
  EXPECT_EQ(run_plumbline(scratch.path(), calibrate + "results >&-").exit_code, 0);
  const std::string log = scratch.read("results/calibration.jsonl");
  ASSERT_FALSE(log.empty());
  for (std::size_t line = 0; line < log.size(); line = log.find('\n', line) + 1) {
    EXPECT_EQ(log[line], '{') << log.substr(line, 80);
  }
  EXPECT_EQ(run_plumbline(scratch.path(),
                          "render furnace_open -o x.exr --spp 1 --size 8x8 <&- >&- 2>&- #")
                .exit_code,
            0);
}

TEST(Start, AStandardErrorThatTakesNothingChangesNoExitCode) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch / "results");
  scratch.write("results/torn.jsonl", "{\n");
  for (const std::string to : {"2>/dev/full #", "2>&- #"}) {
    EXPECT_EQ(run_plumbline(scratch.path(), "render missing -o x.exr >/dev/null " + to).exit_code,
              2);
    EXPECT_EQ(run_plumbline(scratch.path(), "rendr >/dev/null " + to).exit_code, 2);
    EXPECT_EQ(run_plumbline(scratch.path(), "report results -o p.html >/dev/null " + to).exit_code,
              1);
  }
}

}  // namespace
}  // namespace plumbline::tests
