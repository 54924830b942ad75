#pragma once

#include <limits>
#include <vector>

#include <plumbline/verify/image.h>

/// Residuals of an image against its reference, pooled over square tiles.
namespace plumbline::verify {

/// What is known per pixel.
struct Residuals {
  int width = 0, height = 0;
  std::vector<double> residual;  ///< image − reference
  std::vector<double> variance;  ///< of the residual; empty where it must come from the residuals
  std::vector<double> samples;   ///< per pixel, of the image; empty where unknown
  std::vector<double> reference_samples;  ///< per pixel; empty where the reference is exact
  std::vector<double> image;              ///< mean
  std::vector<double> reference;          ///< mean

  std::size_t size() const { return residual.size(); }
};

Residuals make_residuals(const Image& image, const Image& reference);

/// Skewness of a sum of residuals as they show it, and its noise removed: what cannot be told from
/// 0 by two standard errors (√6/n for n normal residuals) is 0.
struct SumSkewness {
  double skewness = 0;
  double largest_share = 0;  ///< of the squared deviations, carried by one pixel
};
SumSkewness sum_skewness(const std::vector<double>& residuals);

/// One tile's verdict on the hypothesis of no bias; NaN where nothing can be said.
struct TileTest {
  /// Own variance only: uniform without bias; for map and histogram.
  double p_plain = std::numeric_limits<double>::quiet_NaN();
  /// The less extreme of own and neighbourhood's variance.
  double p_safe = std::numeric_limits<double>::quiet_NaN();
  double z = std::numeric_limits<double>::quiet_NaN();  ///< of p_safe
};

/// All tiles of one edge length.
struct TileScale {
  int edge = 1;
  int width = 0, height = 0;  ///< in tiles; partial tiles at the far edges count
  std::vector<TileTest> tests;
};

/// @param rounding_allowance  relative to the reference; residuals within it are none
TileScale test_tiles(const Residuals& residuals, int edge, double rounding_allowance);

}  // namespace plumbline::verify
