#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "allocation.h"
#include "publish.h"

namespace plumbline::bench {
namespace {

using Measure = std::function<double(const MethodRun&)>;

/// The paper's Table 1; it does not say what the efficiency is measured by.
const std::map<std::string, std::string> kPaper = {
    {"bsdf", "0.59"},         {"light", "0.16"},   {"equal", "1"},      {"lu", "1.24"},
    {"sbert-moment", "1.24"}, {"root-v1", "1.40"}, {"root-v2", "1.31"}, {"optimum", "1.43"}};

const std::vector<std::string>& methods() {
  static const std::vector<std::string> names = {"bsdf",
                                                 "light",
                                                 "equal",
                                                 "lu",
                                                 "sbert-moment",
                                                 "sbert-variance",
                                                 "root-v1",
                                                 "root-v2",
                                                 "root-nodes",
                                                 "cost-aware",
                                                 "optimum",
                                                 "optimal weights, equal",
                                                 "optimal weights, best share"};
  return names;
}

const MethodRun& find(const std::vector<MethodRun>& runs, const std::string& method) {
  return *std::find_if(runs.begin(), runs.end(),
                       [&](const MethodRun& run) { return run.method == method; });
}

std::string with_interval(const Estimate& e) {
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]", e.value, e.low, e.high);
}

/// Efficiency: 1/error, relative to `equal`; `error` is of the dimension of a variance.
Estimate efficiency(const AllocationResults& results, const std::string& method,
                    const Measure& error) {
  std::vector<double> values;
  for (const auto& runs : results.replicates) {
    values.push_back(error(find(runs, "equal")) / error(find(runs, method)));
  }
  return mean_with_interval(values);
}

/// (efficiency − 1)/(efficiency of the optimum − 1)
Estimate share_of_gain(const AllocationResults& results, const std::string& method,
                       const Measure& error) {
  std::vector<double> values;
  for (const auto& runs : results.replicates) {
    const double equal = error(find(runs, "equal"));
    values.push_back((equal / error(find(runs, method)) - 1) /
                     (equal / error(find(runs, "optimum")) - 1));
  }
  return mean_with_interval(values);
}

struct Column {
  std::string name;
  Measure error;
};

std::vector<Column> columns(bool mixture) {
  const auto of = [mixture](const MethodRun& run) -> const ImageError& {
    return mixture ? run.mixture : run.counts;
  };
  return {{"MSE", [of](const MethodRun& run) { return of(run).mse; }},
          {"mean SD", [of](const MethodRun& run) { return of(run).mean_sd * of(run).mean_sd; }},
          {"relMSE", [of](const MethodRun& run) { return of(run).rel_mse; }}};
}

std::string group() { return "Sample allocation on Veach's plates"; }

reports::Table efficiency_table(const AllocationScene& scene, const AllocationResults& results,
                                bool mixture) {
  reports::Table table;
  table.group = group();
  table.title = fmt::format(
      "{}: efficiency against equal counts, {}", scene.title,
      mixture ? "by the variance of random mixtures" : "by the variance of the counts drawn");
  table.caption =
      mixture
          ? "The same with V(α) = ∫ f²/p − μ², what the policies and the optimum minimise."
          : "Exact variances at the shares that each pixel visited in 20 iterations of 50 "
            "samples, summed over the image; in brackets 95 % over replicates. Of the gain: "
            "(efficiency − 1) over that of the optimum, which also starts with 25 + 25. Mean SD "
            "is squared, so that all columns count samples. Paper: Table 1, whose measure is "
            "not stated.";
  table.columns = {"method", "paper"};
  for (const Column& column : columns(mixture)) {
    table.columns.push_back(column.name);
    table.columns.push_back("of the gain");
  }
  for (const std::string& method : methods()) {
    const auto paper = kPaper.find(method);
    std::vector<std::string> row = {method, paper == kPaper.end() ? "" : paper->second};
    for (const Column& column : columns(mixture)) {
      row.push_back(with_interval(efficiency(results, method, column.error)));
      row.push_back(with_interval(share_of_gain(results, method, column.error)));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

reports::Table check_table(const AllocationScene& scene, const AllocationResults& results) {
  reports::Table table;
  table.group = group();
  table.title = scene.title + ": the renders against the exact integrals";
  table.caption =
      "Bias: mean over pixels of (pixel − integral), in standard deviations of an equal-MIS pixel "
      "of 1000 samples, with its 99.9 % interval. Squared error over the variance that the shares "
      "predict: 1 if the exact variances are right. Pixels beside a light or a far noisier pixel "
      "are "
      "left out.";
  table.columns = {"method", "bias [equal-MIS SD]", "squared error / predicted"};
  for (const RenderCheck& check : results.checks) {
    table.rows.push_back({check.method,
                          fmt::format("{:+.4f} [{:+.4f}, {:+.4f}]", check.bias.value,
                                      check.bias.low, check.bias.high),
                          with_interval(check.squared_ratio)});
  }
  return table;
}

reports::Figure error_figure(const AllocationScene& scene, const AllocationResults& results) {
  reports::Figure figure;
  figure.group = group();
  figure.title = scene.title + ": error against samples per pixel";
  figure.caption =
      "Root mean square error after each iteration, from the exact variances at the shares "
      "visited.";
  figure.x = {"samples per pixel", true};
  figure.y = {"RMSE [luminance]", true};
  for (const std::string& method : methods()) {
    if (method.find("weights") != std::string::npos) continue;
    reports::FigureSeries series;
    series.name = method;
    series.style = reports::SeriesStyle::line;
    for (std::size_t i = 0; i < kIterations; ++i) {
      double mean = 0;
      for (const auto& runs : results.replicates) mean += find(runs, method).rmse[i];
      series.x.push_back(static_cast<double>((i + 1) * kIterationSamples));
      series.y.push_back(mean / static_cast<double>(results.replicates.size()));
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
}

}  // namespace

void report_allocation(reports::ResultLog& log, const AllocationScene& scene,
                       const AllocationResults& results) {
  publish(log, efficiency_table(scene, results, false));
  publish(log, efficiency_table(scene, results, true));
  publish(log, check_table(scene, results));
  log.append(error_figure(scene, results));
}

void report_costs(reports::ResultLog& log, const AllocationScene& scene,
                  const AllocationResults& results, const Estimate& cost_ratio,
                  const std::vector<PolicyCost>& costs) {
  const auto cost = [&](const MethodRun& run) {
    return run.bsdf_share * cost_ratio.value + 1 - run.bsdf_share;
  };
  reports::Table table;
  table.group = group();
  table.title = scene.title + ": cost of a sample";
  table.caption = fmt::format(
      "CPU time per sample on one thread over that of equal, interleaved; the part of it that the "
      "share of BSDF samples explains, one of which costs {} light samples; and efficiency per "
      "time, 1/(MSE × cost of the samples drawn), against equal.",
      with_interval(cost_ratio));
  table.columns = {"policy", "share of BSDF samples", "time / equal", "of which by the share",
                   "1/(MSE × time)"};
  for (const PolicyCost& policy : costs) {
    const auto& runs = results.replicates[0];
    table.rows.push_back(
        {policy.method, fmt::format("{:.3f}", policy.bsdf_share), with_interval(policy.ratio),
         fmt::format("{:.3f}", cost(find(runs, policy.method)) / cost(find(runs, "equal"))),
         with_interval(efficiency(results, policy.method, [&](const MethodRun& run) {
           return run.counts.mse * cost(run);
         }))});
  }
  publish(log, table);
}

}  // namespace plumbline::bench
