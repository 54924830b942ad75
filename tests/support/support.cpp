#include <gtest/gtest.h>
#include <plumbline_tests/figures.h>
#include <plumbline_tests/support.h>
#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <plumbline/reports/results.h>

namespace plumbline::tests {
namespace {

/// The gate's seed: fixed, so that the gate gives the same answer twice. Its value means nothing.
constexpr std::uint64_t kGateSeed = 20240229;

/// @source Stafford 2011, variant 13 of the MurmurHash3 finaliser (the one of SplitMix64)
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// @source Fowler, Noll, Vo: FNV-1a, 64 bits
std::uint64_t hash(std::string_view text) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return h;
}

/// The name that gtest_discover_tests registers: a typed test goes by its type instead of a number.
std::string ctest_name(const testing::TestInfo& test) {
  const std::string suite = test.test_suite_name();
  if (test.type_param() == nullptr) return suite + "." + test.name();
  return suite.substr(0, suite.find('/')) + "." + test.name() + "<" + test.type_param() + ">";
}

std::string quoted_for_regex(std::string_view text) {
  std::string quoted;
  for (const char c : text) {
    if (std::string_view(".+*?()[]{}|^$\\").find(c) != std::string_view::npos) quoted += '\\';
    quoted += c;
  }
  return quoted;
}

/// Seconds since the running test began or last asked, whichever is later: what the check in hand
/// took.
double seconds_since_last_check() {
  static std::int64_t last_ms = 0;
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  const std::int64_t now_ms =
      std::chrono::duration_cast<std::chrono::milliseconds>(since_epoch).count();
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::int64_t test_began_ms = test != nullptr ? test->result()->start_timestamp() : now_ms;
  const std::int64_t began_ms = std::max(last_ms, test_began_ms);
  last_ms = now_ms;
  return static_cast<double>(now_ms - began_ms) * 1e-3;
}

std::string night_words() {
  const char* text = std::getenv("PLUMBLINE_NIGHTLY");
  return text == nullptr ? "" : text;
}

/// Checks of data that was made before: its making is the larger part of what they cost.
bool judges_what_it_is_given(verify::CheckKind kind) {
  return kind == verify::CheckKind::variance_ratio || kind == verify::CheckKind::proportion ||
         kind == verify::CheckKind::image;
}

/// Prints the command that repeats a failed test where no message of the failure says it.
class ReplayPrinter final : public testing::EmptyTestEventListener {
  void OnTestEnd(const testing::TestInfo& test) override {
    if (!test.result()->Failed()) return;
    const std::string command = replay_command();
    for (int i = 0; i < test.result()->total_part_count(); ++i) {
      const char* message = test.result()->GetTestPartResult(i).message();
      if (std::string_view(message).find(command) != std::string_view::npos) return;
    }
    std::printf("replay: %s\n", command.c_str());
  }
};

/// GoogleTest owns its listeners.
[[maybe_unused]] const bool kPrinterIsThere = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new ReplayPrinter);
  return true;
}();

void append_to_results(const verify::CheckResult& result) {
  const char* directory = std::getenv("PLUMBLINE_RESULTS");
  if (directory == nullptr || *directory == '\0') return;
  reports::ResultLog(directory, "checks").append(result);
}

}  // namespace

void publish(const reports::Figure& figure, const std::string& log) {
  EXPECT_EQ(reports::parse_figure(reports::to_json(figure)).series.size(), figure.series.size());
  const char* directory = std::getenv("PLUMBLINE_RESULTS");
  if (directory == nullptr || *directory == '\0') return;
  reports::ResultLog(directory, "figures_" + log).append(figure);
}

std::uint64_t run_seed() {
  const char* text = std::getenv("PLUMBLINE_SEED");
  if (text == nullptr || *text == '\0') return kGateSeed;
  const std::string_view digits = text;
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), seed);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    throw std::runtime_error("PLUMBLINE_SEED is not a whole number in [0, 2^64): " +
                             std::string(digits));
  }
  return seed;
}

std::uint64_t check_seed(std::string_view subject) { return mix(run_seed() ^ mix(hash(subject))); }

verify::ContractOptions contract_options(std::string_view subject) {
  verify::ContractOptions options;
  options.seed = check_seed(subject);
  if (nightly()) return options;
  options.finest_bins /= 4;
  options.first_look /= 4;
  options.deviation *= 2;
  options.mass_tolerance = 4e-4;
  return options;
}

bool nightly() { return night_words() == "1"; }

std::string replay_command() {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  if (test == nullptr) return {};
  const std::string night = night_words();
  const bool at_night = !night.empty() && night != "0";
  return (at_night ? "PLUMBLINE_NIGHTLY=" + night + " " : "") +
         "PLUMBLINE_SEED=" + std::to_string(run_seed()) + " " PLUMBLINE_CTEST " -R '^" +
         quoted_for_regex(ctest_name(*test)) + "$'";
}

verify::Report repeatable(verify::Report report) {
  if (report.replay.empty()) report.replay = replay_command();
  return report;
}

void expect_verdict(verify::CheckResult result, const char* file, int line) {
  const double seconds = seconds_since_last_check();
  if (judges_what_it_is_given(result.kind)) {
    result.seconds = std::max(result.seconds, seconds);
  } else if (result.seconds == 0) {
    result.seconds = seconds;
  }
  if (result.replay.empty()) result.replay = replay_command();
  if (result.seed == 0) result.seed = run_seed();
  append_to_results(result);
  if (!result.as_expected()) ADD_FAILURE_AT(file, line) << verify::describe(result);
}

std::filesystem::path source_file(std::string_view path_from_root) {
  return std::filesystem::path(PLUMBLINE_SOURCE_DIR) / path_from_root;
}

ScratchDirectory::ScratchDirectory() {
  std::string name = (std::filesystem::temp_directory_path() / "plumbline-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw std::system_error(errno, std::generic_category(), name);
  }
  path_ = name;
}

ScratchDirectory::~ScratchDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path ScratchDirectory::write(std::string_view name,
                                              std::string_view content) const {
  std::filesystem::path file = path_ / name;
  std::ofstream out(file, std::ios::binary);
  out << content;
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
  return file;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string ScratchDirectory::read(std::string_view name) const { return text_of(path_ / name); }

std::string ScratchDirectory::listing() const {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    names.insert(entry.path().filename().string());
  }
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

}  // namespace plumbline::tests
