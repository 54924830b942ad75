#include "pairs/lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace plumbline::verify {

namespace {

// A group of samples that lie within 32 roundings, with fewer of them near it than in it, where
// near is 64 times as far. A density that is smooth so closely gives a group a 64th of what lies
// near: of eight or more it holds half with a probability below 64^-8 (16 over 8) = 5e-11, and
// there are some thousand groups so large at the most. Lattices of floats are as fine as the group.
constexpr double kGroupRoundings = 32;
constexpr double kNear = 64;
constexpr std::size_t kFewest = 8;

/// Values that are in a group, and all that are near them, with others: to be sorted in place of
/// all. A group falls into two neighbouring buckets.
std::vector<double> crowded(const std::vector<double>& values, double width, double near) {
  constexpr std::size_t kBuckets = 1 << 17;
  if (width * kBuckets > 1) return values;
  const auto bucket_of = [](double value) {
    return static_cast<std::size_t>(std::clamp(value, 0.0, 1.0) * (kBuckets - 1));
  };
  std::vector<std::uint32_t> counts(kBuckets + 1);
  for (const double value : values) ++counts[bucket_of(value)];
  // Of how many groups a bucket is near, by where that begins and ends.
  std::vector<std::int32_t> changes(kBuckets + 1);
  const auto reach = static_cast<std::size_t>(near * kBuckets) + 2;
  for (std::size_t b = 0; b < kBuckets; ++b) {
    if (counts[b] + counts[b + 1] < kFewest) continue;
    ++changes[b - std::min(b, reach)];
    --changes[std::min(b + reach + 1, kBuckets)];
  }
  std::vector<bool> is_near(kBuckets);
  std::int32_t groups = 0;
  for (std::size_t b = 0; b < kBuckets; ++b) is_near[b] = (groups += changes[b]) > 0;
  std::vector<double> kept;
  for (const double value : values) {
    if (is_near[bucket_of(value)]) kept.push_back(value);
  }
  return kept;
}

}  // namespace

SharedValues shared_values(const std::vector<double>& all, double resolution) {
  SharedValues result;
  const double width = kGroupRoundings * resolution, near = kNear * width;
  std::vector<double> values = crowded(all, width, near);
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  std::size_t largest = 0;
  for (std::size_t first = 0, last = 0; first < n; first = std::max(last, first + 1)) {
    const double value = values[first];
    last = first;
    while (last < n && values[last] - value <= width) ++last;
    const std::size_t group = last - first;
    // At the edges coordinates may be finer than roundings of 1 are, and lobes narrower.
    if (group < kFewest || value < near || value > 1 - near) continue;
    const auto begin = std::lower_bound(values.begin(), values.end(), value - near);
    const auto end = std::upper_bound(values.begin(), values.end(), values[last - 1] + near);
    const auto around = static_cast<std::size_t>(end - begin) - group;
    if (around > group) continue;
    result.share += static_cast<double>(group) / static_cast<double>(all.size());
    ++result.count;
    if (group > largest) {
      largest = group;
      result.example = value;
    }
  }
  return result;
}

}  // namespace plumbline::verify
