#pragma once

#include <optional>
#include <vector>

#include <plumbline/verify/pair.h>

#include "pairs/differences.h"

namespace plumbline::verify {

/// Finds the random numbers that a map takes to a point: several, where a lobe is chosen by a
/// number that is used again, or a map folds. No finite search proves that it has found all.
class BranchSearch {
 public:
  /// @param dimension  of the domain, and how many numbers the map takes: 1 or 2
  /// @param epsilon    rounding unit of the map
  BranchSearch(const Map& map, int dimension, double epsilon);

  /// All that were found, `known` among them, each once.
  std::vector<Uniforms> preimages(const Vec3& x, std::optional<Uniforms> known = {}) const;

 private:
  struct Node {
    Uniforms u{};
    std::optional<Vec3> x;
  };

  std::optional<Vec3> at(const Uniforms& u) const;
  std::vector<Uniforms> starts(const Vec3& x) const;
  std::optional<Uniforms> solve(const Vec3& x, Uniforms u) const;
  std::optional<Uniforms> step(const Vec3& here, const Vec3& x, const Uniforms& u) const;

  Map map_;
  int dimension_;
  double epsilon_;
  std::size_t per_side_;
  std::vector<Node> grid_;
};

}  // namespace plumbline::verify
