#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <plumbline/verify/joint.h>

#include "joints/cube.h"
#include "joints/cube_tree.h"
#include "pairs/mass_integral.h"

namespace plumbline::verify {

/// What is to be integrated, and what may be spent on it.
struct CubeQuestion {
  Many<double(CubePoint)> density;  ///< per unit of the cube

  /// Samples of the pair, of so many drawn: fewer where some are rejected.
  std::function<std::vector<CubePoint>(std::size_t count)> draw_own;

  std::vector<CubePoint> pilot;                             ///< samples that show where to cut
  double pilots_drawn = 1;                                  ///< so many were drawn for that
  std::array<std::vector<double>, kMostDimensions> breaks;  ///< where the density may jump
  double target = 0;  ///< error of the total at 99.9 % after which nothing more is spent
  std::uint64_t max_evaluations = 4'000'000;
  std::uint64_t seed = 1;
};

struct CubeMass {
  MassIntegral integral;

  /// The total by uniform nodes alone, which knows nothing of the sampler; only its total, its
  /// variance and its largest term are filled in. No bound where a spike is narrower than they see.
  MassIntegral of_uniform;

  /// Share of the samples that lie where uniform nodes are so few that the pair's own samples
  /// stand in for them: there the masses follow the sampler, right or wrong.
  double rests_on_own = 0;
};

/// Masses of the bins of a tree, unbiased whatever the density does, with their sampling error.
///
/// As `integrate_mass` does it in two dimensions: a fit on adaptive cells is a control variate, the
/// rest of the density is estimated at random nodes. These are a multiple importance sample by the
/// balance heuristic of uniform ones in each cell, whose density is known, and of the pair's own,
/// whose density is that of the pair if the pair is right: no spike that it samples adds more than
/// one over their number, however narrow.
///
/// @source Owen, Zhou 2000 (JASA 95:449): control variates with a mixture of densities ·
///         Veach, Guibas 1995: the balance heuristic
CubeMass integrate_cube(const CubeQuestion& question, const CubeTree& tree, std::size_t dimension);

}  // namespace plumbline::verify
