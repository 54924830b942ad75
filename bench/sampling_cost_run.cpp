#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "sampling_cost.h"

namespace plumbline::bench {
namespace {

/// Prints as Google Benchmark does, and keeps medians with their spread.
class KeepingReporter : public benchmark::ConsoleReporter {
 public:
  explicit KeepingReporter(reports::Table& table) : ConsoleReporter(OO_Tabular), table_(table) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    std::string median, spread;
    for (const Run& run : runs) {
      if (run.aggregate_name == "median") median = fmt::format("{:.2f}", run.GetAdjustedCPUTime());
      if (run.aggregate_name == "stddev") spread = fmt::format("{:.2f}", run.GetAdjustedCPUTime());
    }
    if (!median.empty()) table_.rows.push_back({runs[0].run_name.str(), median, spread});
    ConsoleReporter::ReportRuns(runs);
  }

 private:
  reports::Table& table_;
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
                                 fmt::format("--benchmark_repetitions={}", repetitions),
                                 "--benchmark_report_aggregates_only=true"};
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
  KeepingReporter reporter(table);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  log.append(table);
}

}  // namespace plumbline::bench
