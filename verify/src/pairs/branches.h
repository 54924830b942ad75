#pragma once

#include <cstddef>
#include <optional>
#include <span>
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

  /// A point, and numbers that lead there, if any are known.
  struct Target {
    Vec3 x{};
    std::optional<Uniforms> known = {};
  };

  /// All that were found of each, `known` among them, each once. All points are searched for in
  /// step, so that the map is asked for many values at once.
  std::vector<std::vector<Uniforms>> preimages(std::span<const Target> targets) const;

 private:
  struct Node {
    Uniforms u{};
    std::optional<Vec3> x;
  };

  /// A solution on its way from one start.
  struct Path {
    std::size_t target = 0;
    Vec3 x{};  ///< of the target
    Uniforms u{};
    Vec3 here{};
    double off = 0;  ///< squared distance
    Uniforms change{};
    bool lost = false;
  };
  using Paths = std::vector<Path*>;

  std::vector<std::optional<Vec3>> at(const std::vector<Uniforms>& u) const;
  std::vector<Uniforms> starts(const Vec3& x) const;
  double enough(const Vec3& x) const;
  void begin(std::vector<Path>& paths) const;
  void find_changes(const Paths& paths) const;
  Paths approach(const Paths& paths) const;
  Uniforms moved(const Path& path, double length) const;

  Map map_;
  int dimension_;
  double epsilon_;
  std::size_t per_side_;
  std::vector<Node> grid_;
};

}  // namespace plumbline::verify
