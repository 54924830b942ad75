#include <plumbline/renderer/estimators/allocation.h>

#include <algorithm>

namespace plumbline::renderer {

std::string_view name(Allocation policy) {
  switch (policy) {
    case Allocation::equal:
      return "equal";
    case Allocation::lu:
      return "lu";
    case Allocation::sbert_moment:
      return "sbert-moment";
    case Allocation::sbert_variance:
      return "sbert-variance";
    case Allocation::root_v1:
      return "root-v1";
    case Allocation::root_v2:
      return "root-v2";
    case Allocation::root_nodes:
      return "root-nodes";
    case Allocation::cost_aware:
      return "cost-aware";
  }
  return "?";
}

void SlopeSums::add(std::size_t technique, const MixtureSample& sample) {
  const double square = sqr(sample.value);
  const double difference = sample.difference();
  squares_[technique] += square;
  slope_ += square * difference;
  curvature_ += 2 * square * sqr(difference);
}

double SlopeSums::version_1(const TechniqueCounts& drawn) const {
  return squares_[1] / drawn[1] - squares_[0] / drawn[0];
}

void LuAllocation::add(std::size_t, const MixtureSample& sample) {
  // f² (p₂ − p₁)/p(½)² over p, and the like, from g = f/p and the shares.
  const double density = sample.density_at(0.5);
  const double slope = sqr(sample.value / density) * sample.difference();
  slope_ += slope;
  curvature_ += 2 * slope * sample.difference() / density;
}

std::optional<double> LuAllocation::next(const TechniqueCounts&) {
  if (!(curvature_ > 0)) return std::nullopt;
  return 0.5 - slope_ / curvature_;
}

void SbertAllocation::add(std::size_t, const MixtureSample& sample) {
  sum_ += sample.value;
  for (std::size_t i = 0; i < 2; ++i) second_moments_[i] += sqr(sample.value) / sample.share[i];
}

std::optional<double> SbertAllocation::next(const TechniqueCounts& drawn) {
  count_ += total_count(drawn);
  const double square_of_mean = variance_ ? sqr(sum_ / count_) : 0;
  const auto spread = [&](std::size_t i) {
    return std::max(second_moments_[i] / count_ - square_of_mean, 0.0);
  };
  // As a ratio, so that one infinite moment (a technique that misses part of f) gives the other
  // all.
  return 1 / (1 + spread(0) / spread(1));
}

std::optional<double> RootAllocation::next(const TechniqueCounts& drawn) {
  iteration_ += 1;
  const double weight = 1 / std::sqrt(iteration_);
  const double alpha = drawn[0] / total_count(drawn);
  const double slope = version_1_ ? sums_.version_1(drawn) : sums_.version_2(drawn);
  slope_ = (1 - weight) * (slope_ + curvature_ * (alpha - alpha_)) + weight * slope;
  curvature_ = (1 - weight) * curvature_ + weight * sums_.curvature(drawn);
  alpha_ = alpha;
  sums_ = {};
  if (!(curvature_ > 0)) return std::nullopt;
  return alpha_ - slope_ / curvature_;
}

NodeAllocation::NodeAllocation(double limit, double cost_ratio) : cost_ratio_(cost_ratio) {
  for (std::size_t k = 0; k < kNodes; ++k) {
    alpha_[k] = limit + (1 - 2 * limit) * static_cast<double>(k) / (kNodes - 1);
  }
}

void NodeAllocation::add(std::size_t, const MixtureSample& sample) {
  sum_ += sample.value;
  const double square = sqr(sample.value);
  const double difference = sample.difference();
  for (std::size_t k = 0; k < kNodes; ++k) {
    const double inverse = 1 / sample.density_at(alpha_[k]);
    moment_[k] += square * inverse;
    slope_[k] += square * difference * sqr(inverse);
  }
}

double NodeAllocation::slope_at(std::size_t k) const {
  const double cost = alpha_[k] * cost_ratio_ + 1 - alpha_[k];
  return slope_[k] * cost + (moment_[k] - sqr(sum_) / count_) * (cost_ratio_ - 1);
}

std::optional<double> NodeAllocation::next(const TechniqueCounts& drawn) {
  count_ += total_count(drawn);
  double low = slope_at(0);
  if (low > 0) return alpha_[0];
  for (std::size_t k = 1; k < kNodes; ++k) {
    const double high = slope_at(k);
    if (high > 0) {
      // A/(1 − α)² − B/α² through both nodes: A = a/det, B = b/det, neither negative. Its root is
      // where α/(1 − α) = √(B/A).
      const double x0 = 1 / sqr(1 - alpha_[k - 1]), y0 = 1 / sqr(alpha_[k - 1]);
      const double x1 = 1 / sqr(1 - alpha_[k]), y1 = 1 / sqr(alpha_[k]);
      const double a = std::sqrt(y0 * high - y1 * low);
      const double b = std::sqrt(x0 * high - x1 * low);
      return b / (a + b);
    }
    low = high;
  }
  return low < 0 ? std::optional(alpha_.back()) : std::nullopt;
}

Allocator::Allocator(const AllocationOptions& options)
    : policy_(make_policy(options)), limit_(options.limit) {}

Allocator::Policy Allocator::make_policy(const AllocationOptions& options) {
  switch (options.policy) {
    case Allocation::equal:
      return EqualAllocation();
    case Allocation::lu:
      return LuAllocation();
    case Allocation::sbert_moment:
      return SbertAllocation(false);
    case Allocation::sbert_variance:
      return SbertAllocation(true);
    case Allocation::root_v1:
      return RootAllocation(true);
    case Allocation::root_v2:
      return RootAllocation(false);
    case Allocation::root_nodes:
      return NodeAllocation(options.limit, 1);
    case Allocation::cost_aware:
      return NodeAllocation(options.limit, options.cost_ratio);
  }
  return EqualAllocation();
}

TechniqueCounts Allocator::counts(std::uint32_t n) const {
  const auto wanted = static_cast<std::uint32_t>(std::lround(alpha_ * n));
  const std::uint32_t first = std::clamp(wanted, 1u, n - 1);
  return {first, n - first};
}

void Allocator::add(std::size_t technique, const MixtureSample& sample) {
  if (!std::isfinite(sample.value) || !std::isfinite(sample.share[0]) ||
      !std::isfinite(sample.share[1])) {
    return;
  }
  std::visit([&](auto& policy) { policy.add(technique, sample); }, policy_);
}

void Allocator::end_iteration(const TechniqueCounts& drawn) {
  const std::optional<double> next =
      std::visit([&](auto& policy) { return policy.next(drawn); }, policy_);
  // Sums that overflowed may have made it NaN, which must not replace an α that is good.
  if (next && !std::isnan(*next)) alpha_ = std::clamp(*next, limit_, 1 - limit_);
}

}  // namespace plumbline::renderer
