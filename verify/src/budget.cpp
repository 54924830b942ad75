#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string_view>

#include <plumbline/verify/detail/budget.h>

#include "distributions.h"

namespace plumbline::verify {

namespace {

// Of the level of a pass: what is split evenly over the looks, and what the last look takes of the
// rest.
constexpr double kEven = 0.2, kOnLast = 0.7;

// Of the level of a pass, what a mean check spends at its last look.
constexpr double kPassOnLast = 0.1;

}  // namespace

double run_level() {
  const char* text = std::getenv("PLUMBLINE_NIGHTLY");
  const std::string_view night = text == nullptr ? "" : text;
  return night.empty() || night == "0" ? kRunLevel : kNightLevel;
}

LookPlan plan_looks(std::uint64_t n0, std::uint64_t max_samples, const ErrorBudget& budget) {
  if (n0 == 0 || max_samples == 0) {
    throw std::invalid_argument("plan_looks: the first look and the cap must be at least 1 sample");
  }
  LookPlan plan;
  for (std::uint64_t n = n0; n < max_samples; n *= 2) {
    plan.samples.push_back(n);
    if (n > max_samples / 2) break;  // doubling would overflow or pass the cap
  }
  // A look less than a tenth short of the cap would cost a level and show nothing new.
  if (!plan.samples.empty() && max_samples - plan.samples.back() < max_samples / 10) {
    plan.samples.pop_back();
  }
  plan.samples.push_back(max_samples);

  const std::size_t looks = plan.samples.size();
  plan.fail_level.assign(looks, budget.fail_level() / static_cast<double>(looks));
  plan.pass_level.assign(looks, kEven * budget.pass_level() / static_cast<double>(looks));
  double left = (1 - kEven) * budget.pass_level();
  for (std::size_t k = looks; k-- > 0;) {
    const double spent = k == 0 ? left : kOnLast * left;
    plan.pass_level[k] += spent;
    left -= spent;
  }
  return plan;
}

LookPlan plan_mean_looks(std::uint64_t n0, std::uint64_t max_samples, const ErrorBudget& budget) {
  if (n0 == 0 || max_samples == 0) {
    throw std::invalid_argument(
        "plan_mean_looks: the first look and the cap must be at least 1 sample");
  }
  LookPlan plan;
  const double first = static_cast<double>(n0), last = static_cast<double>(max_samples);
  // A step that fits just so must not be lost to rounding.
  const double steps = std::floor(std::log(last / first) / std::log(kLookRatio) + 1e-9);
  for (double k = 0; k < steps; ++k) {
    const auto n =
        static_cast<std::uint64_t>(std::round(first * std::pow(last / first, k / steps)));
    if (plan.samples.empty() || n > plan.samples.back()) plan.samples.push_back(n);
  }
  if (plan.samples.empty() || plan.samples.back() < max_samples) {
    plan.samples.push_back(max_samples);
  }

  const std::size_t looks = plan.samples.size();
  if (looks == 1) {
    plan.fail_level = {budget.fail_level()};
    plan.pass_level = {budget.pass_level()};
    return plan;
  }
  constexpr double kFailOnLast = 0.25;
  const double others = static_cast<double>(looks - 1);
  plan.fail_level.assign(looks, (1 - kFailOnLast) * budget.fail_level() / others);
  plan.fail_level.back() = kFailOnLast * budget.fail_level();
  constexpr double kLine = 0.72, kUnseen = 0.15;
  constexpr double kRest = 1 - kLine - kUnseen - kPassOnLast;
  plan.pass_level.assign(looks, kRest * budget.pass_level() / others);
  plan.pass_level.back() = kPassOnLast * budget.pass_level();
  plan.line_level = kLine * budget.pass_level();
  plan.unseen_level = kUnseen * budget.pass_level();
  return plan;
}

double line_quantile(double s, double level) {
  const double log_level = std::log(1 / level);
  // Below 1e-8 and above 0.01 less is subtracted than could be.
  const double late = std::min(0.33 * log_level, 0.7 * std::cbrt(std::min(log_level, 18.4)));
  const double line = log_level - late;
  return s * s < 2 * line ? std::numeric_limits<double>::infinity() : s / 2 + line / s;
}

std::uint64_t samples_to_decide(double relative_tolerance, double cv, const ErrorBudget& budget) {
  if (!(relative_tolerance > 0) || !(cv >= 0)) {
    throw std::invalid_argument("samples_to_decide: needs a positive tolerance and cv >= 0");
  }
  const double reach =
      normal_quantile(kPassOnLast * budget.pass_level()) + normal_quantile(budget.fail_level() / 2);
  const double ratio = cv / relative_tolerance;
  const double samples = std::ceil(std::ceil(reach * reach) * ratio * ratio);
  return static_cast<std::uint64_t>(std::clamp(samples, 1.0, 0x1p62));
}

}  // namespace plumbline::verify
