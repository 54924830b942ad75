#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
          ? fmt::format(
                "{}. The same with V(α) = ∫ f²/p − μ², what the policies and the optimum "
                "minimise.",
                scene.exponents)
          : fmt::format(
                "{}. Exact variances at the shares that each pixel visited in 20 iterations of 50 "
                "samples, summed over the image; in brackets 95 % over replicates. Of the gain: "
                "(efficiency − 1) over that of the optimum, which also starts with 25 + 25. Mean "
                "SD is squared, so that all columns count samples. Paper: Table 1, whose measure "
                "is not stated.",
                scene.exponents);
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
      "of 1000 samples, with its 99.9 % interval; less noisy by controls whose expectation is 0: "
      "for "
      "equal the second moment of the samples, for the others the further renders of root-nodes, "
      "which draw nearly the same samples from the same seeds. Squared error "
      "over the variance that the shares predict, with a 95 % interval: 1 if the exact variances "
      "are right. Pixels beside a light or a far noisier pixel are left out.";
  table.columns = {"method", "renders", "bias [equal-MIS SD]", "squared error / predicted"};
  for (const RenderCheck& check : results.checks) {
    table.rows.push_back({check.method, std::to_string(check.renders),
                          fmt::format("{:+.4f} [{:+.4f}, {:+.4f}]", check.bias.value,
                                      check.bias.low, check.bias.high),
                          with_interval(check.squared_ratio)});
  }
  return table;
}

/// Root mean square error after each iteration, mean over replicates, of the methods named;
/// over that of `equal` where `relative`.
reports::Figure error_figure(const AllocationScene& scene, const AllocationResults& results,
                             const std::vector<std::string>& names, bool relative) {
  reports::Figure figure;
  figure.group = group();
  figure.title = fmt::format("{}: error {}against samples per pixel", scene.title,
                             relative ? "over that of equal counts " : "");
  figure.caption =
      relative ? "The same, divided by the error of equal at as many samples: what adapting gains."
               : "Root mean square error after each iteration, from the exact variances at the "
                 "shares visited.";
  figure.x = {"samples per pixel", true};
  figure.y = {relative ? "RMSE / RMSE of equal" : "RMSE [luminance]", !relative};
  for (const std::string& method : names) {
    reports::FigureSeries series;
    series.name = method;
    series.style = method == "optimum" ? reports::SeriesStyle::dashed : reports::SeriesStyle::line;
    for (std::size_t i = 0; i < kIterations; ++i) {
      double mean = 0;
      for (const auto& runs : results.replicates) {
        mean += find(runs, method).rmse[i] / (relative ? find(runs, "equal").rmse[i] : 1);
      }
      series.x.push_back(static_cast<double>((i + 1) * kIterationSamples));
      series.y.push_back(mean / static_cast<double>(results.replicates.size()));
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
}

/// A bar of the issue; `short_run` where the image is smaller than it asks for.
reports::Bar make_bar(const AllocationScene& scene, const std::string& what, const Estimate& e,
                      double limit, bool short_run) {
  reports::Bar bar;
  bar.name = fmt::format("{}, {}", what, scene.title);
  bar.limit = limit;
  bar.measured = e.value;
  bar.low = e.low;
  bar.high = e.high;
  bar.indicative = short_run;
  return bar;
}

struct GainBar {
  const char* method;
  double mse, mean_sd;
};

constexpr GainBar kGainBars[] = {
    {"root-v1", 0.55, 0.75}, {"root-v2", 0.95, 0.93}, {"root-nodes", 0.97, 0.96}};

void publish_gain_bars(reports::ResultLog& log, const AllocationScene& scene,
                       const AllocationResults& results, const AllocationWork& work) {
  const std::vector<Column> measures = columns(false);
  for (const GainBar& gain : kGainBars) {
    for (std::size_t m = 0; m < 2; ++m) {
      reports::Bar bar =
          make_bar(scene, fmt::format("Gain of {} by {}", gain.method, measures[m].name),
                   share_of_gain(results, gain.method, measures[m].error),
                   m == 0 ? gain.mse : gain.mean_sd, !work.full_size);
      bar.unit = "of the optimum's";
      bar.at_least = true;
      bar.note = fmt::format(
          "{}×{}, 20 iterations of 50 samples, exact variances at the shares visited, {} "
          "replicates",
          work.width, work.height, work.replicates);
      publish(log, bar);
    }
  }
}

/// The policy of which the least is proven speaks for all.
void publish_bias_bar(reports::ResultLog& log, const AllocationScene& scene,
                      const AllocationResults& results, const AllocationWork& work) {
  const auto bound = [](const RenderCheck& check) {
    return std::max(-check.bias.low, check.bias.high);
  };
  const RenderCheck& worst = *std::max_element(
      results.checks.begin(), results.checks.end(),
      [&](const RenderCheck& a, const RenderCheck& b) { return bound(a) < bound(b); });
  const Estimate& bias = worst.bias;
  const bool crosses = bias.low < 0 && bias.high > 0;
  const Estimate size{std::abs(bias.value),
                      crosses ? 0 : std::min(std::abs(bias.low), std::abs(bias.high)),
                      bound(worst)};
  reports::Bar bar = make_bar(scene, "Bias of any policy", size, 0.01, !work.full_size);
  bar.unit = "SD of an equal-MIS pixel";
  bar.note = fmt::format(
      "{}×{}, 1000 samples per pixel; |bias| of {}, of which the least is proven, with a 99.9 % "
      "interval",
      work.width, work.height, worst.method);
  publish(log, bar);
}

void publish_cost_bar(reports::ResultLog& log, const AllocationScene& scene,
                      const std::vector<PolicyCost>& costs, const AllocationWork& work) {
  const PolicyCost& dearest = *std::max_element(
      costs.begin(), costs.end(),
      [](const PolicyCost& a, const PolicyCost& b) { return a.ratio.value < b.ratio.value; });
  reports::Bar bar =
      make_bar(scene, "Time per sample of the dearest policy", dearest.ratio, 1.1, !work.full_size);
  bar.unit = "of equal's";
  bar.note = fmt::format("{}; {}×{}, one thread, {} repetitions in turn with equal", dearest.method,
                         work.cost_width, work.cost_height, work.cost_repetitions);
  publish(log, bar);
}

}  // namespace

void report_allocation(reports::ResultLog& log, const AllocationScene& scene,
                       const AllocationResults& results, const AllocationWork& work) {
  publish_gain_bars(log, scene, results, work);
  publish_bias_bar(log, scene, results, work);
  publish(log, efficiency_table(scene, results, false));
  publish(log, efficiency_table(scene, results, true));
  publish(log, check_table(scene, results));
  log.append(error_figure(
      scene, results, {"bsdf", "light", "equal", "lu", "sbert-variance", "root-nodes", "optimum"},
      false));
  log.append(error_figure(scene, results,
                          {"lu", "sbert-variance", "root-v1", "root-v2", "root-nodes", "optimum"},
                          true));
}

void report_costs(reports::ResultLog& log, const AllocationScene& scene,
                  const AllocationResults& results, const Estimate& cost_ratio,
                  const std::vector<PolicyCost>& costs, const AllocationWork& work) {
  publish_cost_bar(log, scene, costs, work);
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
