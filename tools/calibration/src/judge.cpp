#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include <plumbline/verify/ratio.h>

#include "tables.h"

namespace plumbline::calibration {

namespace {

constexpr double kTailHits = 300;  // proves a rate to a factor of 2 with room to spare

double share_below(const std::vector<double>& p_values, double limit) {
  const auto below =
      std::count_if(p_values.begin(), p_values.end(), [limit](double p) { return p < limit; });
  return static_cast<double>(below) / static_cast<double>(p_values.size());
}

/// Largest distance between the distribution of the p-values and the uniform one.
double distance_from_uniform(std::vector<double> p_values) {
  std::sort(p_values.begin(), p_values.end());
  const double n = static_cast<double>(p_values.size());
  double distance = 0;
  for (std::size_t i = 0; i < p_values.size(); ++i) {
    const double below = static_cast<double>(i) / n;
    distance = std::max({distance, p_values[i] - below, below + 1 / n - p_values[i]});
  }
  return distance;
}

/// Distance that chance exceeds with a probability of at most `level`.
double dkw_distance(double level, double n) { return std::sqrt(std::log(2 / level) / (2 * n)); }

}  // namespace

double excludable_rate(double rate, std::uint64_t runs) {
  const double n = static_cast<double>(runs), mean = rate * n;
  const double most = mean + 5.2 * std::sqrt(mean) + 4.5;
  return std::min(1.0, (most + 3.3 * std::sqrt(most) + 5.5) / n);
}

verify::CheckResult judge_uniform(const std::vector<double>& p_values, verify::Verdict expected) {
  const double n = static_cast<double>(p_values.size());
  const double limit = kTailHits / n;
  verify::ProportionOptions o;
  o.at_least = limit / 2;
  o.at_most = 2 * limit;
  o.expected = expected;
  const double hits = std::round(n * share_below(p_values, limit));
  verify::CheckResult r = check_proportion(o, static_cast<std::uint64_t>(hits), p_values.size());
  const verify::ErrorBudget budget;
  const double distance = distance_from_uniform(p_values);
  const double margin = dkw_distance(budget.pass_level(), n);
  const double sure = dkw_distance(budget.fail_level(), n);
  const double allowed = margin + sure;
  r.figures.insert(r.figures.end(), {{"share below 0.1", share_below(p_values, 0.1)},
                                     {"share below 0.01", share_below(p_values, 0.01)},
                                     {"share below 0.001", share_below(p_values, 0.001)},
                                     {"distance from uniform", distance},
                                     {"distance allowed", allowed}});
  const bool valid =
      std::all_of(p_values.begin(), p_values.end(), [](double p) { return p >= 0 && p <= 1; });
  if (!valid || distance - sure > allowed) {
    r.verdict = verify::Verdict::fail;
    r.reason = valid ? fmt::format("the distribution of p-values is {:.3g} off", distance)
                     : "a p-value lies outside [0, 1]";
  } else if (r.verdict == verify::Verdict::pass && !(distance + margin <= allowed)) {
    r.verdict = verify::Verdict::inconclusive;
    r.reason = fmt::format("the distribution of p-values may be {:.3g} off", distance + margin);
  }
  return r;
}

}  // namespace plumbline::calibration
