#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <plumbline/renderer/core/math.h>

namespace plumbline::renderer {

/// Moments of the samples of one pixel, in double: a float sum of 1e8 samples stalls.
///
/// @source Welford 1962; merging: Chan, Golub, LeVeque 1979, Eq. 2.1
struct PixelMoments {
  std::uint32_t count = 0;
  std::uint32_t non_finite = 0;  ///< samples left out of the mean because they were NaN or infinite
  Rgbd mean;
  Rgbd sum_squares;  ///< of the deviations from the mean

  void add(const Rgbf& sample);
  /// The same bits as one by one, in order.
  void add(std::span<const Rgbf> samples);
  void merge(const PixelMoments& other);

  /// Adds the mean of a replicate as one sample: what its samples share says nothing of its error.
  /// A replicate without a finite sample is left out.
  void add_replicate(const PixelMoments& replicate);

  /// Unbiased variance of one sample; 0 for fewer than two.
  Rgbd variance() const;
};

/// Place of a pixel among all: row by row, from the top.
inline std::size_t pixel_index(int width, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(x);
}

/// An image under construction.
class Film {
 public:
  Film(int width, int height);

  /// @param pixels  row by row, from the top
  /// @throws std::invalid_argument unless there are width × height
  Film(int width, int height, std::vector<PixelMoments> pixels);

  int width() const { return width_; }
  int height() const { return height_; }
  std::vector<PixelMoments>& pixels() { return pixels_; }
  const std::vector<PixelMoments>& pixels() const { return pixels_; }

  /// Place of a pixel in pixels().
  std::size_t index(int x, int y) const { return pixel_index(width_, x, y); }

  PixelMoments& at(int x, int y) { return pixels_[index(x, y)]; }
  const PixelMoments& at(int x, int y) const { return pixels_[index(x, y)]; }

  /// Mean over all pixels.
  Rgbd mean() const;

  /// Sum of the samples left out because they were not finite.
  std::uint64_t non_finite() const;

  /// Estimate of the root relative mean squared error of the luminance: √ mean over pixels of
  /// Var/(n (m² + 0.01)), the definition that the comparison with other renderers uses.
  double relative_error() const;

 private:
  int width_, height_;
  std::vector<PixelMoments> pixels_;
};

}  // namespace plumbline::renderer
