#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "diagnosis/evidence.h"
#include "pairs/branches.h"
#include "pairs/differences.h"

/// A sampler taken apart: one of its numbers chooses a part, a lobe as a rule, and what each part
/// adds to the density is found by itself, without a word from the code about it.
namespace plumbline::verify {

/// Which number chooses, and where it goes from one part to the next: 0, …, 1. No borders: there
/// are far too many parts, or the sampler cannot be taken apart.
struct Parts {
  std::size_t chooser = 0;
  std::vector<double> borders;

  std::size_t count() const { return borders.size() < 3 ? 1 : borders.size() - 1; }
  double share(std::size_t part) const { return borders[part + 1] - borders[part]; }
};

/// The number whose map jumps at the same values whatever the other numbers are.
Parts parts_of(const SamplingPair& pair);

/// A map of numbers, no lobes or preimages that are known.
bool can_be_taken_apart(const SamplingPair& pair);

/// What densities by differences and their sums are known to.
double tolerance_of_parts(const SamplingPair& pair);

/// A density at a point that certain numbers of a part's map bring.
struct WayThere {
  DensityAt density;
  Uniforms u{};
};

/// All ways to a point; nullopt where the density of one of them is not known.
using Ways = std::optional<std::vector<WayThere>>;

/// Densities by differences of every way of a map to each of some points.
std::vector<Ways> ways_to(const BranchSearch& search, const Map& map, const SamplingPair& pair,
                          std::span<const BranchSearch::Target> targets);

/// A part's map from its own numbers in [0, 1), as many as the domain has dimensions.
class PartMap {
 public:
  PartMap(const SamplingPair& pair, const Parts& parts, std::size_t part);
  PartMap(const PartMap&) = delete;
  PartMap& operator=(const PartMap&) = delete;

  bool usable() const { return numbers_.size() == dimension(); }
  const Map& map() const { return map_; }

  /// The number that chooses the part moves samples in it as well.
  bool uses_chooser() const;

  Uniforms draw(Random& random) const;

  /// Of all numbers of the part that lead to points.
  std::vector<Ways> ways(std::span<const BranchSearch::Target> targets) const {
    return ways_to(*search_, map_, pair_, targets);
  }

  /// Share of the part's numbers that are not rejected.
  double accepted() const;

 private:
  std::size_t dimension() const { return static_cast<std::size_t>(pair_.domain.dimension()); }
  Uniforms whole(const Uniforms& u) const;
  void find_numbers();

  const SamplingPair& pair_;
  const Parts& parts_;
  std::size_t part_;
  std::vector<std::size_t> numbers_;
  Map map_;
  std::optional<BranchSearch> search_;
};

/// The number that chooses a part moves samples in one of the parts as well.
bool choice_is_used_again(const SamplingPair& pair, const Parts& parts);

}  // namespace plumbline::verify
