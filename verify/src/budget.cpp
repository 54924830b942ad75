#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <plumbline/verify/detail/budget.h>

namespace plumbline::verify {

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
  constexpr double kEven = 0.2, kOnLast = 0.7;
  plan.pass_level.assign(looks, kEven * budget.pass_level() / static_cast<double>(looks));
  double left = (1 - kEven) * budget.pass_level();
  for (std::size_t k = looks; k-- > 0;) {
    const double spent = k == 0 ? left : kOnLast * left;
    plan.pass_level[k] += spent;
    left -= spent;
  }
  return plan;
}

std::uint64_t samples_to_decide(double relative_tolerance, double cv) {
  if (!(relative_tolerance > 0) || !(cv >= 0)) {
    throw std::invalid_argument("samples_to_decide: needs a positive tolerance and cv >= 0");
  }
  const double ratio = cv / relative_tolerance;
  return static_cast<std::uint64_t>(std::clamp(std::ceil(95 * ratio * ratio), 1.0, 0x1p62));
}

}  // namespace plumbline::verify
