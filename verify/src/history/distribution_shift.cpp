#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>

#include <plumbline/verify/history/distribution_shift.h>

#include "streams.h"

namespace plumbline::verify::history {

namespace {

using Night = std::vector<double>;

/// Mean distance of values of two nights, both sorted.
double mean_distance(const Night& a, const Night& b) {
  // Σ|x − y| = Σ over x of (number of y below)·x − their sum, and the other way round.
  const double sum_b = std::accumulate(b.begin(), b.end(), 0.0);
  double total = 0, below = 0;
  std::size_t count = 0;
  for (const double x : a) {
    for (; count < b.size() && b[count] <= x; ++count) below += b[count];
    const double n = static_cast<double>(count), above = static_cast<double>(b.size() - count);
    total += n * x - below + (sum_b - below) - above * x;
  }
  return total / (static_cast<double>(a.size()) * static_cast<double>(b.size()));
}

/// Chance that a value of b exceeds one of a, both sorted; ties count half.
double chance_larger(const Night& a, const Night& b) {
  double total = 0;
  for (const double x : b) {
    const auto [first, last] = std::equal_range(a.begin(), a.end(), x);
    total += static_cast<double>(first - a.begin()) + 0.5 * static_cast<double>(last - first);
  }
  return total / (static_cast<double>(a.size()) * static_cast<double>(b.size()));
}

/// Distances of all pairs of nights, so that the energy distance of any grouping is a few sums.
class NightDistances {
 public:
  explicit NightDistances(const std::vector<Night>& nights)
      : size_(nights.size()), distances_(size_ * size_), rows_(size_) {
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double d = mean_distance(nights[i], nights[j]);
        distances_[i * size_ + j] = distances_[j * size_ + i] = d;
        rows_[i] += d;
        rows_[j] += d;
        total_ += d;
      }
    }
  }

  /// Between one group of nights and all others, by pairs of different nights.
  double energy(std::span<const std::size_t> group) const {
    double within = 0, touching = 0;
    for (std::size_t k = 0; k < group.size(); ++k) {
      touching += rows_[group[k]];
      for (std::size_t l = 0; l < k; ++l) within += distances_[group[k] * size_ + group[l]];
    }
    const double n = static_cast<double>(group.size()), m = static_cast<double>(size_) - n;
    const double between = touching - 2 * within, others = total_ - within - between;
    return 2 * between / (n * m) - 2 * within / (n * (n - 1)) - 2 * others / (m * (m - 1));
  }

 private:
  std::size_t size_;
  std::vector<double> distances_, rows_;
  double total_ = 0;
};

/// Number of ways to choose k of n, or infinity's worth.
double ways(std::size_t n, std::size_t k) {
  double result = 1;
  for (std::size_t i = 0; i < k; ++i) {
    result *= static_cast<double>(n - i) / static_cast<double>(i + 1);
  }
  return result;
}

/// The next group in lexicographic order; false after the last.
bool next_group(std::vector<std::size_t>& group, std::size_t n) {
  for (std::size_t k = group.size(); k-- > 0;) {
    if (group[k] + group.size() - k >= n) continue;
    ++group[k];
    for (std::size_t l = k + 1; l < group.size(); ++l) group[l] = group[l - 1] + 1;
    return true;
  }
  return false;
}

// Groupings that are the same but for the order of their sums must count as equal.
constexpr double kRoundingOfSums = 1e-9;

double p_of_all(const NightDistances& distances, std::size_t n, std::size_t k, double seen) {
  std::vector<std::size_t> group(k);
  std::iota(group.begin(), group.end(), std::size_t{0});
  double extreme = 0, all = 0;
  do {
    extreme += distances.energy(group) >= seen ? 1 : 0;
    ++all;
  } while (next_group(group, n));
  return extreme / all;
}

double p_of_drawn(const NightDistances& distances, std::size_t n, std::size_t k, double seen,
                  int permutations, std::uint64_t seed) {
  Random random = random_for(seed, Stream::nights);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  int extreme = 0;
  for (int i = 0; i < permutations; ++i) {
    for (std::size_t j = 0; j < k; ++j) {
      const auto step = static_cast<std::size_t>(random.uniform() * static_cast<double>(n - j));
      std::swap(order[j], order[j + step]);
    }
    extreme += distances.energy(std::span(order).first(k)) >= seen ? 1 : 0;
  }
  // The grouping that was seen is one of them.
  return (extreme + 1.0) / (permutations + 1.0);
}

std::vector<Night> sorted_nights(std::span<const Night> before, std::span<const Night> after) {
  std::vector<Night> nights(before.begin(), before.end());
  nights.insert(nights.end(), after.begin(), after.end());
  for (Night& night : nights) {
    const auto finite = [](double x) { return std::isfinite(x); };
    if (night.empty() || !std::all_of(night.begin(), night.end(), finite)) {
      throw std::invalid_argument("distribution shift: a night is empty or not finite");
    }
    std::sort(night.begin(), night.end());
  }
  return nights;
}

}  // namespace

DistributionShift distribution_shift(std::span<const std::vector<double>> before,
                                     std::span<const std::vector<double>> after, int permutations,
                                     std::uint64_t seed) {
  if (before.size() < 2 || after.size() < 2 || permutations < 1) {
    throw std::invalid_argument(
        "distribution shift: needs at least two nights on each side and a permutation");
  }
  const std::vector<Night> nights = sorted_nights(before, after);
  const NightDistances distances(nights);
  const bool before_is_smaller = before.size() <= after.size();
  const std::size_t n = nights.size(), k = std::min(before.size(), after.size());
  std::vector<std::size_t> group(k);
  std::iota(group.begin(), group.end(), before_is_smaller ? std::size_t{0} : before.size());
  DistributionShift result;
  result.energy_distance = distances.energy(group);
  const double seen = result.energy_distance - kRoundingOfSums * std::abs(result.energy_distance);
  result.p_value = ways(n, k) <= permutations
                       ? p_of_all(distances, n, k, seen)
                       : p_of_drawn(distances, n, k, seen, permutations, seed);
  double larger = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t j = before.size(); j < n; ++j) larger += chance_larger(nights[i], nights[j]);
  }
  result.larger = larger / (static_cast<double>(before.size()) * static_cast<double>(after.size()));
  return result;
}

}  // namespace plumbline::verify::history
