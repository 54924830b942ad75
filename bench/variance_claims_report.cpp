#include <fmt/format.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/ratio.h>
#include "publish.h"
#include "variance_claims.h"

namespace plumbline::bench {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

using Values = std::vector<double>;

/// Ratio of two means over replicates with its 99.9 % interval.
struct Ratio {
  double value, low, high;
  bool settled;  ///< not decided by a few replicates
};

Ratio ratio(const Values& a, const Values& b) {
  const verify::CheckResult r = verify::check_variance_ratio({}, a, b);
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const verify::Interval interval = r.interval.value_or(verify::Interval{kUnknown, kUnknown});
  return {r.estimate.value_or(kUnknown), interval.low, interval.high, r.ok()};
}

std::string text(const Ratio& r) {
  return fmt::format("{:.3g} [{:.3g}, {:.3g}]{}", r.value, r.low, r.high, r.settled ? "" : " ?");
}

/// Holds where the interval lies within the claim, does not hold where it lies beside it.
std::string verdict(const Ratio& r, const Range& claim) {
  if (!r.settled) return "inconclusive";
  if (r.low >= claim.low && r.high <= claim.high) return "holds";
  if (r.high < claim.low) return "does not hold: less";
  if (r.low > claim.high) return "does not hold: more";
  return "inconclusive";
}

Values times(const Values& a, const Values& b) {
  Values product;
  for (std::size_t i = 0; i < a.size(); ++i) product.push_back(a[i] * b[i]);
  return product;
}

/// Variance times time: what is left at equal time.
Values inefficiency(const StrategyRuns& runs) { return times(runs.variance, runs.seconds); }

reports::Table claim_table(std::string title, std::string caption,
                           std::vector<std::string> columns) {
  reports::Table table;
  table.group = "Variance claims of RayON's table";
  table.title = std::move(title);
  table.caption = std::move(caption);
  table.columns = std::move(columns);
  return table;
}

reports::Table variance_table(const std::vector<SceneRuns>& all) {
  reports::Table table = claim_table(
      "Variance of other strategies over that of MIS",
      fmt::format(
          "Power heuristic, independent samples, mean over the pixels; 99.9 % intervals over {} "
          "replicates. The claim is of BSDF sampling over MIS at equal samples, and holds where "
          "the interval lies within it. Equal time: variance × CPU time of a path. Relative: "
          "of variance/(μ² + 0.01). A question mark: a few replicates decide.",
          all.front().mis().variance.size()),
      {"scene", "claim", "BSDF / MIS", "verdict", "relative", "equal time", "light / MIS",
       "light / MIS, equal time"});
  for (const SceneRuns& runs : all) {
    const Ratio gain = ratio(runs.bsdf().variance, runs.mis().variance);
    table.rows.push_back({runs.scene.title, runs.scene.claim, text(gain),
                          runs.scene.claim.empty() ? "" : verdict(gain, runs.scene.claimed),
                          text(ratio(runs.bsdf().relative_variance, runs.mis().relative_variance)),
                          text(ratio(inefficiency(runs.bsdf()), inefficiency(runs.mis()))),
                          text(ratio(runs.light().variance, runs.mis().variance)),
                          text(ratio(inefficiency(runs.light()), inefficiency(runs.mis())))});
  }
  return table;
}

/// What a gain of ten in variance leaves at equal time where a path costs that much more.
Ratio speedup(const Ratio& cost) {
  return {10 / cost.value, 10 / cost.high, 10 / cost.low, cost.settled};
}

double mean(const Values& values) { return mean_with_interval(values).value; }

reports::Table cost_table(const std::vector<SceneRuns>& all) {
  reports::Table table = claim_table(
      "What a path of MIS costs",
      "Rays and CPU time of a path over those of BSDF sampling. The ratio of times is also the "
      "break-even: the gain in variance from which on MIS is worth its price. Speedup: ten times "
      "less variance at that price.",
      {"scene", "rays per path, BSDF", "of MIS", "of which shadow rays", "ratio",
       "claim: 1.25 to 1.4", "time", "claim: up to 1.4", "speedup", "claim: 7 and more"});
  for (const SceneRuns& runs : all) {
    const Ratio rays = ratio(runs.mis().rays, runs.bsdf().rays);
    const Ratio cost = ratio(runs.mis().seconds, runs.bsdf().seconds);
    const auto of_light_samples = [&](const std::string& claim) {
      return runs.scene.specular ? std::string() : claim;
    };
    table.rows.push_back({runs.scene.title, fmt::format("{:.2f}", mean(runs.bsdf().rays)),
                          fmt::format("{:.2f}", mean(runs.mis().rays)),
                          fmt::format("{:.2f}", mean(runs.mis().shadow_rays)), text(rays),
                          of_light_samples(verdict(rays, {1.25, 1.4})), text(cost),
                          of_light_samples(verdict(cost, {0, 1.4})), text(speedup(cost)),
                          of_light_samples(verdict(speedup(cost), {7, kNoLimit}))});
  }
  return table;
}

reports::Table firefly_table(const std::vector<SceneRuns>& all) {
  reports::Table table = claim_table(
      "Fireflies",
      "Pixels of a replicate that are brighter than the truth by the mean of the image or more. "
      "Of its chapel the page claims that MIS eliminates them; read as: one in a hundred is left.",
      {"scene", "per image, BSDF", "of MIS", "BSDF / MIS", "claim: 100 and more"});
  for (const SceneRuns& runs : all) {
    if (runs.scene.name != "chapel") continue;
    const Ratio gain = ratio(runs.bsdf().fireflies, runs.mis().fireflies);
    table.rows.push_back({runs.scene.title, fmt::format("{:.1f}", mean(runs.bsdf().fireflies)),
                          fmt::format("{:.1f}", mean(runs.mis().fireflies)), text(gain),
                          verdict(gain, {100, kNoLimit})});
  }
  return table;
}

}  // namespace

void report_variance_claims(reports::ResultLog& log, const std::vector<SceneRuns>& runs) {
  publish(log, variance_table(runs));
  publish(log, cost_table(runs));
  publish(log, firefly_table(runs));
}

}  // namespace plumbline::bench
