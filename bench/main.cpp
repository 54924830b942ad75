#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/reports/results.h>
#include "allocation.h"
#include "equal_error.h"
#include "ray_replay.h"
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

using Measure = std::function<void(plumbline::reports::ResultLog&, bool full)>;

/// A part of the benchmarks: its name on the command line, its log, and what fills it.
struct Part {
  const char *name, *log;
  Measure measure;
  bool only_full = false;  ///< not of the one-minute set
};

std::vector<Part> make_parts(const std::filesystem::path& results) {
  using namespace plumbline::bench;
  using plumbline::reports::ResultLog;
  return {{"equal-error", "bars_equal_error", measure_equal_error},
          {"ray-replay", "bars_ray_replay", measure_ray_replay},
          {"shadow-rays", "shadow_rays", measure_shadow_rays},
          {"speed-error", "speed_error", measure_speed_against_error},
          {"allocation", "allocation",
           [results](ResultLog& log, bool full) { measure_allocation(log, results, full); }},
          {"variance-claims", "variance_claims", measure_variance_claims, true},
          {"sampling-cost", "sampling_cost_table",
           [results](ResultLog&, bool full) { measure_sampling_cost(results, full); }}};
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Benchmarks of Plumbline, part by part"};
  std::filesystem::path results;
  std::string only;
  bool full = false;
  app.add_option("--results", results, "Folder for the JSON results")->required();
  app.add_flag("--full", full, "Everything, instead of the one-minute set");
  app.add_option("--only", only, "One part: its name");
  CLI11_PARSE(app, argc, argv);

  std::filesystem::create_directories(results);
  bool found = false;
  for (const Part& part : make_parts(results)) {
    if (only.empty() ? part.only_full && !full : only != part.name) continue;
    found = true;
    auto log = fresh_log(results, part.log);
    part.measure(log, full);
  }
  if (!found) throw std::invalid_argument("no part is named '" + only + "'");
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "plumbline_bench: {}\n", error.what());
  return 2;
}
