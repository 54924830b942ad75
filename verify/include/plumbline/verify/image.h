#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <plumbline/verify/detail/report.h>
#include <plumbline/verify/detail/settings.h>
#include <plumbline/verify/mean.h>

namespace plumbline::verify {

/// One channel of an image as a check sees it. Row by row, index y·width + x.
struct Image {
  int width = 0, height = 0;
  std::vector<double> mean;      ///< estimate (or exact value) per pixel
  std::vector<double> variance;  ///< of one sample; empty: unknown, or exact for a reference
  std::vector<double> count;     ///< samples per pixel; empty where `variance` is
};

/// What an image check is asked.
struct ImageOptions : CheckSettings {
  std::string subject;
  double tolerance = 0.01;           ///< bias of the global mean, relative to the reference's mean
  double rounding_allowance = 1e-5;  ///< relative, per pixel: what float rounding may do
  std::uint64_t non_finite = 0;      ///< samples that were not finite: any fails
  int look = 0;                      ///< which of `looks` looks at a growing image this is
  int looks = 1;                     ///< both levels are split evenly over them
  Verdict expected = Verdict::pass;
};

/// Outcome of an image check, with what the page shows.
struct ImageResult {
  CheckResult check;  ///< of the global mean; fails also if a tile or a pixel does
  int tile = 0;       ///< edge of the tiles of `p_map`, in pixels
  int map_width = 0, map_height = 0;
  std::vector<double> p_map;  ///< p-value per tile, row by row; NaN where nothing can be said
  std::vector<double>
      histogram;  ///< share of the p-values in each of 20 equal bins: flat if unbiased
};

/// Holds an image against a reference: the global mean, tiles of 64, 32, 16, 8, 4 and 2 pixels,
/// single pixels, one error budget across them.
///
/// The global mean is a mean check: it proves a bound on the bias or a difference. Tiles and pixels
/// can only fail. Noise comes from the variance layers of both images (Welch); without one it is
/// estimated from the residuals in each tile, and single pixels are not judged. A tile is judged
/// where its noise is not too skewed for its size; its z-score is the less extreme of the one with
/// its own variance and the one with its neighbourhood's, so that a pixel that nothing has hit yet
/// proves nothing. Nor does one where a render shows less than half of what the other side does,
/// from fewer than 2^20 samples: light that none of them has hit is not in its variance.
///
/// @param reference  without variance: exact, averaged over each pixel's footprint; with: a second
///                   render
/// @throws std::invalid_argument if sizes differ, an array has the wrong length, or a count is none
/// @source Jung, Hanika, Dachsbacher 2020 (JCGT 9:2): Welch's test per tile, map and histogram of
///         p-values
ImageResult check_image(const ImageOptions& options, const Image& image, const Image& reference);

}  // namespace plumbline::verify
