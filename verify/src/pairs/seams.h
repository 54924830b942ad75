#pragma once

#include <vector>

#include "pairs/differences.h"

/// Long differences may straddle a seam of a map.
namespace plumbline::verify {

/// Differences that do not converge at more than this share of the points prove too little: of maps
/// of texels three quarters of the points are at seams, and the others are hundreds.
inline constexpr double kMostFolds = 0.9;

/// Shorter steps, with which a point that fails is looked at again: within a pixel of a map, if not
/// before its edge. Coarse ones may straddle a seam and agree by coincidence.
inline constexpr double kShortSteps[] = {0x1p-9, 0x1p-13, 0x1p-16};

/// More points than a seam may make fail by a coincidence of its differences.
bool more_than_seams(double points, double of);

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

/// pdf and density are one, as closely as both are known.
bool agree(double pdf, const DensityAt& density, double tolerance);

/// @param dimension, epsilon  as for `densities_by_differences`
/// @param tolerance           of a density, relative
std::vector<Closely> look_closely(const Map& map, const std::vector<Differing>& points,
                                  int dimension, double epsilon, double tolerance);

}  // namespace plumbline::verify
