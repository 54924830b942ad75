#pragma once

#include <vector>

#include "pairs/differences.h"

/// Long differences may straddle a seam of a map.
namespace plumbline::verify {

/// A point where the density by long differences is not the pdf.
struct Differing {
  Uniforms u{};
  double pdf = 0;
  DensityAt far;
};

/// What differences that are shorter, or on one side only, say there.
struct Closely {
  bool agrees = false;       ///< with the pdf: they are as close, or contradict the long ones
  bool contradicts = false;  ///< the long ones, which straddle a seam
};

bool agree(double pdf, const DensityAt& density, double tolerance);

/// @param dimension, epsilon  as for `densities_by_differences`
/// @param tolerance           of a density, relative
std::vector<Closely> look_closely(const Map& map, const std::vector<Differing>& points,
                                  int dimension, double epsilon, double tolerance);

}  // namespace plumbline::verify
