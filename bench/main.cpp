#include <fmt/core.h>

#include <exception>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/options/options.h>
#include <plumbline/reports/results.h>

#include "accelerators.h"
#include "allocation.h"
#include "equal_error.h"
#include "languages.h"
#include "ray_replay.h"
#include "sampling_cost.h"
#include "scaling.h"
#include "shadow_rays.h"
#include "speed_error.h"
#include "variance_claims.h"
#include "verdict_time.h"

namespace {

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

std::vector<Part> make_parts(const std::filesystem::path& results,
                             const std::vector<std::string>& peers) {
  using namespace plumbline::bench;
  using plumbline::reports::ResultLog;
  return {{"equal-error", "bars_equal_error",
           [peers](ResultLog& log, bool full) { measure_equal_error(log, peers, full); }},
          {"ray-replay", "bars_ray_replay", measure_ray_replay},
          {"shadow-rays", "shadow_rays", measure_shadow_rays},
          {"accelerators", "accelerators", measure_accelerators},
          {"scaling", "bars_scaling", measure_scaling},
          {"speed-error", "speed_error", measure_speed_against_error},
          {"allocation", "sample_allocation",
           [results](ResultLog& log, bool full) { measure_allocation(log, results, full); }},
          {"variance-claims", "variance_claims", measure_variance_claims, true},
          {"sampling-cost", "sampling_cost_table",
           [results](ResultLog& log, bool full) { measure_sampling_cost(log, results, full); }},
          {"languages", "languages", measure_languages},
          {"verdict-time", "verdict_time", measure_verdict_time}};
}

}  // namespace

int main(int argc, char** argv) try {
  plumbline::options::CommandLine line("Benchmarks of Plumbline, part by part");
  plumbline::options::Command program = line.program();
  std::string folder, only, scaling_point;
  std::vector<std::string> peers;
  bool full = false;
  program.add("--results", folder, "Folder for the JSON results");
  program.add_flag("--full", full, "Everything, instead of the one-minute set");
  program.add("--only", only, "One part: its name");
  program
      .add("--peer", peers,
           "Beside us in equal-error: another renderer's command, with {scene} (.pbrt) or {xml}, "
           "{out}, "
           "{spp}, {seed}, {threads} in it; repeatable")
      .one_value_each()
      .type("COMMAND");
  // How this program measures in a process of its own, see scaling_point.cpp.
  program.add("--scaling-point", scaling_point, "").excludes("--results").hidden();
  if (const auto printed = line.parse(argc, argv)) return *printed ? 0 : 2;
  if (!scaling_point.empty()) {
    plumbline::bench::measure_scaling_point(scaling_point);
    return 0;
  }
  if (folder.empty()) throw std::invalid_argument("--results FOLDER is required");

  const std::filesystem::path results = folder;
  std::filesystem::create_directories(results);
  bool found = false;
  for (const Part& part : make_parts(results, peers)) {
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
