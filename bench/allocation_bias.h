#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <plumbline/renderer/assembly/render.h>
#include "allocation_reference.h"
#include "statistics.h"

namespace plumbline::bench {

/// What the renders of one policy said about its bias and its variance.
struct RenderCheck {
  std::string method;
  int renders = 0;
  Estimate bias;  ///< mean over pixels, in standard deviations of an equal-MIS pixel, 99.9 %
  Estimate squared_ratio;  ///< squared error over the variance predicted from the shares, 95 %
};

/// What the errors of a pixel are counted in. From a pilot of its own: what shares the noise of the
/// reference that the errors are taken against would be correlated with them.
struct PixelUnit {
  double deviation = 0;   ///< of an equal-MIS pixel's mean; 0 where the pixel is not judged
  double per_square = 0;  ///< mean over second moment, of a sample
};

/// Judged are pixels whose variance the pilot is sure to know: none that sees a light, which is not
/// shared out, and none that has less than a tenth of the variance of a pixel beside it, of whose
/// surface a sliver may reach into it that no sample has hit.
///
/// @param samples  per pixel of the renders to be judged
std::vector<PixelUnit> pixel_units(const std::vector<PixelIntegrals>& pilot, int width,
                                   double samples);

/// Errors of the renders of one policy with seeds 1, 2, …, pixel by pixel.
class RenderErrors {
 public:
  /// @param exact          independent of the units
  /// @param exact_samples  behind it, per pixel
  void add(const renderer::RenderResult& result, const std::vector<PixelUnit>& units,
           const std::vector<PixelIntegrals>& exact, const std::vector<double>& exact_variance,
           double exact_samples);

  int renders() const { return static_cast<int>(errors_.size()); }

  /// Means over pixels with intervals from their spread: pixels are independent, what the renders
  /// of one pixel share (the reference) is in its mean. Noise is taken out by two controls whose
  /// expectation is 0 whatever the bias is: at fixed counts how far the second moment of the
  /// samples is off; else how far another policy's renders with the same seeds, which draw nearly
  /// the same samples, are from the mean of all its renders.
  ///
  /// @param anchor  the other policy, with more renders than this one, or this one itself
  RenderCheck result(const std::string& method, const RenderErrors& anchor) const;

 private:
  /// Mean over the first renders, pixel by pixel.
  std::vector<double> mean_error(int renders) const;

  std::vector<std::vector<double>> errors_;  // in units, of the judged pixels, render by render
  std::vector<double> moments_, squares_, predicted_;  // of the judged pixels, sums over renders
  bool fixed_counts_ = true;
};

}  // namespace plumbline::bench
