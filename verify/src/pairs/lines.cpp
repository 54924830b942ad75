#include "pairs/lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plumbline::verify {

namespace {

// A group of samples that lie within 32 roundings, with fewer of them near it than in it, where
// near is 64 times as far. A density that is smooth so closely gives a group a 64th of what lies
// near: of eight or more it holds half with a probability below 64^-8 (16 over 8) = 5e-11, and
// there are some thousand groups so large at the most. Lattices of floats are as fine as the group.
constexpr double kGroupRoundings = 32;
constexpr double kNear = 64;
constexpr std::size_t kFewest = 8;

}  // namespace

SharedValues shared_values(std::vector<double> values, double resolution) {
  SharedValues result;
  std::sort(values.begin(), values.end());
  const double width = kGroupRoundings * resolution, near = kNear * width;
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
    result.share += static_cast<double>(group) / static_cast<double>(n);
    ++result.count;
    if (group > largest) {
      largest = group;
      result.example = value;
    }
  }
  return result;
}

}  // namespace plumbline::verify
