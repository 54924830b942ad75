#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "publish.h"
#include "sampling_cost.h"

namespace plumbline::bench {
namespace {

/// Prints as Google Benchmark does, but for single repetitions, and keeps these, and medians with
/// their spread.
class KeepingReporter : public benchmark::ConsoleReporter {
 public:
  KeepingReporter(reports::Table& table, reports::ResultLog& log)
      : ConsoleReporter(OO_Tabular), table_(table), log_(log) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    if (runs[0].run_type == Run::RT_Iteration) return keep_repetitions(runs);
    std::string median, spread;
    for (const Run& run : runs) {
      if (run.aggregate_name == "median") median = fmt::format("{:.2f}", run.GetAdjustedCPUTime());
      if (run.aggregate_name == "stddev") spread = fmt::format("{:.2f}", run.GetAdjustedCPUTime());
    }
    if (!median.empty()) table_.rows.push_back({runs[0].run_name.str(), median, spread});
    ConsoleReporter::ReportRuns(runs);
  }

 private:
  void keep_repetitions(const std::vector<Run>& runs) {
    std::vector<double> repetitions;
    for (const Run& run : runs) repetitions.push_back(run.GetAdjustedCPUTime());
    keep(log_, runs[0].run_name.str(), "ns", std::move(repetitions));
  }

  reports::Table& table_;
  reports::ResultLog& log_;
};

}  // namespace

void measure_sampling_cost(reports::ResultLog& log, const std::filesystem::path& results,
                           bool full) {
  const int repetitions = full ? 7 : 5;
  // Google Benchmark takes its settings as a command line.
  std::vector<std::string> words{"plumbline_bench",
                                 "--benchmark_out_format=json",
                                 "--benchmark_out=" + (results / "sampling_cost.json").string(),
                                 "--benchmark_enable_random_interleaving=true",
                                 std::string("--benchmark_min_time=") + (full ? "0.05" : "0.01"),
                                 fmt::format("--benchmark_repetitions={}", repetitions)};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  int argc = static_cast<int>(argv.size());
  reports::Table table;
  table.group = "Cost of sampling";
  table.title = "Nanoseconds per call";
  table.caption = fmt::format(
      "BSDFs, lights, warps and sampler dimensions as rendered: in float, through the variant. CPU "
      "time, median and standard deviation of {} repetitions in random order.",
      repetitions);
  table.columns = {"function", "median [ns]", "standard deviation [ns]"};
  benchmark::Initialize(&argc, argv.data());
  KeepingReporter reporter(table, log);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  log.append(table);
}

}  // namespace plumbline::bench
