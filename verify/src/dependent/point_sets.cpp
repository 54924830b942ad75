#include "dependent/point_sets.h"

#include <memory>
#include <stdexcept>
#include <utility>

#include "streams.h"
#include "text.h"

namespace plumbline::verify {

PointSet::PointSet(const PointSets& sets, std::uint64_t replicate, std::size_t n)
    : dimensions_(sets.dimensions), size_(n) {
  if (!sets.points || sets.dimensions == 0 || n == 0) {
    throw std::invalid_argument("point sets '" + sets.name + "': need points and dimensions");
  }
  numbers_ = sets.points(replicate, n);
  if (numbers_.size() != n * dimensions_) {
    throw std::invalid_argument("point sets '" + sets.name + "': " + number(numbers_.size()) +
                                " numbers, asked for " + number(n) + " points of " +
                                number(dimensions_) + " dimensions");
  }
}

std::string PointSet::outside() const {
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    if (numbers_[i] >= 0 && numbers_[i] < 1) continue;
    return "dimension " + number(i % dimensions_) + " of point " + number(i / dimensions_) +
           " is " + number(numbers_[i]) + ", outside [0, 1)";
  }
  return {};
}

std::uint64_t first_replicate(std::uint64_t seed) {
  // Short enough for samplers that keep 32 bits of a seed, long enough for no two runs to meet.
  return random_for(seed, Stream::replicates).bits() >> 33;
}

MomentSampler replicate_means(PointSets sets, std::size_t n,
                              std::function<double(std::span<const double>)> f,
                              std::uint64_t seed) {
  const auto held = std::make_shared<const PointSets>(std::move(sets));
  return [held, n, f = std::move(f), seed](std::uint64_t first, std::uint64_t count) {
    Moments moments;
    for (std::uint64_t r = first; r < first + count; ++r) {
      const PointSet set(*held, first_replicate(seed) + r, n);
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) sum += f({set.point(i), held->dimensions});
      moments.add(sum / static_cast<double>(n));
    }
    return moments;
  };
}

}  // namespace plumbline::verify
