#include <plumbline/renderer/core/sampling/discrete.h>

#include <cassert>
#include <numeric>

namespace plumbline::renderer {
namespace {

constexpr std::uint32_t kUnits = 1u << 24;

}  // namespace

DiscreteDistribution::DiscreteDistribution(std::span<const double> weights) {
  assert(!weights.empty() && weights.size() <= kUnits);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto weight = [&](std::size_t i) { return total > 0 ? weights[i] / total : 1.0; };
  // Every positive weight has one unit for certain; the rest is dealt out in proportion, rounding
  // the cumulative sum, so that no error adds up.
  std::uint32_t certain = 0;
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    certain += weight(i) > 0 ? 1u : 0u;
    sum += weight(i);
  }
  const double to_deal_out = kUnits - certain;
  bounds_.reserve(weights.size() + 1);
  std::uint32_t given = 0;
  double cumulative = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    given += weight(i) > 0 ? 1u : 0u;
    cumulative += weight(i);
    const double dealt = std::round(std::min(cumulative / sum, 1.0) * to_deal_out);
    bounds_.push_back(static_cast<float>(given + dealt) * 0x1p-24f);
  }
  bounds_.back() = 1;
}

}  // namespace plumbline::renderer
