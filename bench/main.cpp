#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <plumbline/reports/results.h>
#include "allocation.h"
#include "equal_error.h"
#include "shadow_rays.h"
#include "speed_error.h"
#include "variance_claims.h"

namespace {

/// Google Benchmark takes its settings as a command line.
void measure_sampling_cost(const std::filesystem::path& results, bool full) {
  std::vector<std::string> words{"plumbline_bench",
                                 "--benchmark_out_format=json",
                                 "--benchmark_out=" + (results / "sampling_cost.json").string(),
                                 "--benchmark_enable_random_interleaving=true",
                                 std::string("--benchmark_min_time=") + (full ? "0.2" : "0.02"),
                                 std::string("--benchmark_repetitions=") + (full ? "9" : "5"),
                                 "--benchmark_report_aggregates_only=true"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  int argc = static_cast<int>(argv.size());
  benchmark::Initialize(&argc, argv.data());
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}

/// A log of its own for one part, without what an earlier run left there.
plumbline::reports::ResultLog fresh_log(const std::filesystem::path& results, const char* name) {
  std::filesystem::remove(results / (std::string(name) + ".jsonl"));
  return {results, name};
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{
      "Benchmarks of Plumbline: equal error, shadow rays, speed against error, allocation, "
      "variance "
      "claims, sampling cost"};
  std::filesystem::path results;
  std::string only;
  bool full = false;
  app.add_option("--results", results, "Folder for the JSON results")->required();
  app.add_flag("--full", full, "Everything, instead of the one-minute set");
  app.add_option("--only", only, "One part")
      ->check(CLI::IsMember({"equal-error", "shadow-rays", "speed-error", "allocation",
                             "variance-claims", "sampling-cost"}));
  CLI11_PARSE(app, argc, argv);

  std::filesystem::create_directories(results);
  using namespace plumbline::bench;
  const auto wanted = [&](const char* part) { return only.empty() || only == part; };
  const auto measure = [&](const char* part, const char* file, const auto& function) {
    if (!wanted(part)) return;
    auto log = fresh_log(results, file);
    function(log, full);
  };
  measure("equal-error", "bars_equal_error", measure_equal_error);
  measure("shadow-rays", "shadow_rays", measure_shadow_rays);
  measure("speed-error", "speed_error", measure_speed_against_error);
  measure("allocation", "allocation", [&results](plumbline::reports::ResultLog& log, bool all) {
    measure_allocation(log, results, all);
  });
  // Not of the one-minute set: the claims do not change from day to day.
  if (full || only == "variance-claims") {
    measure("variance-claims", "variance_claims", measure_variance_claims);
  }
  if (wanted("sampling-cost")) measure_sampling_cost(results, full);
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "plumbline_bench: {}\n", error.what());
  return 2;
}
