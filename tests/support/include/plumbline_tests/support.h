#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <plumbline/verify/detail/report.h>
#include <plumbline/verify/detail/result.h>
#include <plumbline/verify/pair.h>

namespace plumbline::tests {

/// Seed of this run: the environment variable PLUMBLINE_SEED, or the gate's fixed one. At night a
/// fresh seed is set from outside.
///
/// @throws std::runtime_error where PLUMBLINE_SEED is not a whole number in [0, 2⁶⁴)
std::uint64_t run_seed();

/// Seed of one check: run_seed() mixed with the check's subject, so that no two checks of a run
/// share a stream and all of them change with the run's seed.
std::uint64_t check_seed(std::string_view subject);

/// Whether the nightly configuration asks for full grids (PLUMBLINE_NIGHTLY=1). With "gate" a night
/// runs what the gate does; both are held to the night's level (verify::run_level).
bool nightly();

/// Options of the contract's checks, seeded for the subject. At night as users have them; in the
/// gate a quarter of the bins, samples until twice the deviation is excluded, and masses that add
/// up to 1 within 4e-4.
verify::ContractOptions contract_options(std::string_view subject);

/// The one command that repeats the running test with this run's seed; empty outside a test. It is
/// printed under every test that fails, unless a message of the failure says it already.
std::string replay_command();

/// The report with that command, for PLUMBLINE_EXPECT_PASS: by itself it knows no seed of ours.
verify::Report repeatable(verify::Report report);

/// Holds a result against its expectation: adds a GoogleTest failure that explains itself if it
/// differs, and appends the result to $PLUMBLINE_RESULTS/checks.jsonl, if that variable is set, for
/// the page. Fills in what the check left empty: the replay command of the running test,
/// run_seed(), and the seconds since the test began or the last result in it.
///
/// @param file, line  where the failure is reported: the caller's place
void expect_verdict(verify::CheckResult result, const char* file = __builtin_FILE(),
                    int line = __builtin_LINE());

/// A file of the source tree, by its path from the root: "analytic/scenes/furnace_sphere.xml".
std::filesystem::path source_file(std::string_view path_from_root);

/// What a file holds, byte by byte; empty if it cannot be read.
std::string text_of(const std::filesystem::path& file);

/// An empty directory of the running test's own, removed with what is in it.
class ScratchDirectory {
 public:
  ScratchDirectory();
  ~ScratchDirectory();
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

  /// @return the path of the file written
  std::filesystem::path write(std::string_view name, std::string_view content) const;
  std::string read(std::string_view name) const;

  /// The names of the files in it, sorted, with spaces between.
  std::string listing() const;

 private:
  std::filesystem::path path_;
};

}  // namespace plumbline::tests
