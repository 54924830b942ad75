#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/verify/random.h>
#include <plumbline/verify/vector_access.h>

#include "bin_tree.h"
#include "chart.h"
#include "cubature.h"

/// A sampling pair cut into bins: what the pdf expects of each, and what the sampler put there.
namespace plumbline::verify {

struct ChartedPair {
  const Chart* chart = nullptr;
  std::function<std::optional<Vec3>(Random&)> sample;
  std::function<double(const Vec3&)> density;  ///< over the domain's measure
};

struct BinCounts {
  std::vector<std::uint64_t> bins;
  std::uint64_t rejected = 0;
  std::uint64_t stray = 0;  ///< samples where the density is 0, also all around
  std::uint64_t not_finite =
      0;  ///< samples or densities at samples that are not finite, or negative
  std::uint64_t drawn = 0;
  std::optional<Vec3> stray_at, not_finite_at;  ///< an example of each
};

class BinnedPair {
 public:
  /// Draws pilot samples, cuts the domain where they fall, and integrates the density over each
  /// bin.
  ///
  /// @param depth        2^depth finest bins
  /// @param mass_error   error of the total mass to reach
  BinnedPair(const ChartedPair& pair, int depth, double mass_error, std::uint64_t seed);

  /// Draws more samples and counts them.
  void draw(std::uint64_t count);

  int depth() const { return tree_.depth(); }
  const CubatureResult& expected() const { return expected_; }  ///< mass per finest bin
  const BinCounts& counts() const { return counts_; }

  /// Middle of a bin of a depth, in the domain.
  Vec3 center(int depth, std::size_t bin) const;

 private:
  void classify(const Vec3& x);

  const ChartedPair& pair_;
  Random random_;
  std::vector<Point2> pilot_;
  BinTree tree_;
  CubatureResult expected_;
  BinCounts counts_;
};

}  // namespace plumbline::verify
