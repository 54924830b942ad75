#include "images/image_tiles.h"

#include <algorithm>
#include <cmath>

#include "distributions.h"
#include "means/mean_judgement.h"

namespace plumbline::verify {

namespace {

// A tile of this many pixels shows the skewness of its own noise.
constexpr int kPixelsForSkewness = 64;
// Equal samples that make a constant believable, and zeros that make darkness believable.
constexpr double kEnoughEqualSamples = 20'000;
constexpr double kEnoughZeros = 1 << 20;
constexpr double kSamplesPerPixel = 32;

/// Sums over the pixels of one tile.
struct Tile {
  double pixels = 0, samples = 0, reference_samples = 0;
  double residual = 0;     // mean over pixels
  double error2 = 0;       // squared standard error of `residual`
  double degrees = 0;      // of freedom of error2
  double skewness = 0;     // of `residual`
  double image = 0;        // mean over pixels
  double reference = 0;    // the same
  bool dark = true;        // every pixel is 0
  bool all_differ = true;  // every pixel is off by more than rounding
};

struct TileGrid {
  int width = 0, height = 0;
  std::vector<Tile> tiles;

  const Tile& at(int x, int y) const {
    return tiles[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(x)];
  }
};

Tile sum_tile(const Residuals& r, int x0, int y0, int edge, double allowance) {
  Tile tile;
  std::vector<double> inside;
  double variance = 0;
  for (int y = y0; y < std::min(y0 + edge, r.height); ++y) {
    for (int x = x0; x < std::min(x0 + edge, r.width); ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(r.width) +
                            static_cast<std::size_t>(x);
      inside.push_back(r.residual[i]);
      tile.residual += r.residual[i];
      tile.image += r.image[i];
      tile.reference += r.reference[i];
      tile.dark = tile.dark && r.image[i] == 0;
      tile.all_differ =
          tile.all_differ && std::abs(r.residual[i]) > allowance * std::abs(r.reference[i]);
      if (!r.variance.empty()) variance += r.variance[i];
      if (!r.samples.empty()) tile.samples += r.samples[i];
      if (!r.reference_samples.empty()) tile.reference_samples += r.reference_samples[i];
    }
  }
  tile.pixels = static_cast<double>(inside.size());
  tile.residual /= tile.pixels;
  tile.image /= tile.pixels;
  tile.reference /= tile.pixels;
  if (r.variance.empty()) {
    double squares = 0;
    for (const double x : inside) squares += (x - tile.residual) * (x - tile.residual);
    tile.degrees = tile.pixels - 1;
    tile.error2 = tile.degrees > 0 ? squares / tile.degrees / tile.pixels : 0;
  } else {
    tile.error2 = variance / (tile.pixels * tile.pixels);
    tile.degrees = std::max(1.0, tile.samples - tile.pixels);
  }
  if (tile.pixels >= kPixelsForSkewness) tile.skewness = sum_skewness(inside).skewness;
  return tile;
}

TileGrid sum_tiles(const Residuals& r, int edge, double allowance) {
  TileGrid grid;
  grid.width = (r.width + edge - 1) / edge;
  grid.height = (r.height + edge - 1) / edge;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      grid.tiles.push_back(sum_tile(r, x * edge, y * edge, edge, allowance));
    }
  }
  return grid;
}

/// Mean squared error of a tile's residual over the tile and those around it.
double neighbourhood_error2(const TileGrid& grid, int x, int y) {
  double sum = 0, count = 0;
  for (int j = std::max(0, y - 1); j <= std::min(grid.height - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(grid.width - 1, x + 1); ++i) {
      sum += grid.at(i, j).error2;
      ++count;
    }
  }
  return sum / count;
}

double two_sided(double z, double degrees) {
  return degrees > 2000 ? 2 * normal_tail(std::abs(z)) : student_two_sided(z, degrees);
}

/// Tiles without noise: equal samples are believed when there are enough of them.
TileTest test_noiseless(const Tile& tile, double excess) {
  if (excess == 0) return {1, 1, 0};
  const bool believable =
      tile.all_differ && tile.samples >= (tile.dark ? kEnoughZeros : kEnoughEqualSamples);
  if (!believable) return {};
  return {0, 0, std::numeric_limits<double>::infinity()};
}

/// One of the renders shows less than half of what the other side does, from few samples: what
/// carries the rest may be light that none, or too few of them, have hit, and that its variance
/// does not know of.
bool misses_most(const Residuals& r, const Tile& tile) {
  const double image = std::abs(tile.image), reference = std::abs(tile.reference);
  const bool image_is_lower = image < reference;
  if (!(std::min(image, reference) < std::max(image, reference) / 2)) return false;
  if (image_is_lower) {
    // Of an image without variance only darkness is doubted: its noise is seen in the residuals.
    return r.samples.empty() ? tile.dark : tile.samples < kEnoughZeros;
  }
  return !r.reference_samples.empty() && tile.reference_samples < kEnoughZeros;
}

TileTest test_tile(const Residuals& r, const Tile& tile, double around2, double allowance) {
  const double excess =
      std::max(0.0, std::abs(tile.residual) - allowance * std::abs(tile.reference));
  if (misses_most(r, tile)) return {};
  if (!(around2 > 0)) return test_noiseless(tile, excess);
  TileTest test;
  const double own = std::sqrt(tile.error2);
  if (own > 0 && tile.degrees >= 8) test.p_plain = two_sided(tile.residual / own, tile.degrees);

  const bool single_pixels_unknown = r.variance.empty() && tile.pixels < kPixelsForSkewness;
  const bool too_few = !r.samples.empty() && tile.samples < kSamplesPerPixel;
  if (single_pixels_unknown || too_few || !(std::abs(tile.skewness) <= kSkewnessLimit)) return test;
  Evidence e;
  e.estimate = std::copysign(excess, tile.residual);
  e.standard_error = std::sqrt(std::max(tile.error2, around2));
  e.skewness = tile.skewness;
  test.z = excess / e.standard_error;
  test.p_safe = std::max(mean_p_value(e, 0), two_sided(test.z, tile.degrees));
  return test;
}

}  // namespace

Residuals make_residuals(const Image& image, const Image& reference) {
  Residuals r;
  r.width = image.width;
  r.height = image.height;
  r.image = image.mean;
  r.reference = reference.mean;
  r.samples = image.count;
  r.reference_samples = reference.count;
  const std::size_t n = image.mean.size();
  for (std::size_t i = 0; i < n; ++i) {
    r.residual.push_back(image.mean[i] - reference.mean[i]);
    if (image.variance.empty()) continue;
    double variance = image.variance[i] / image.count[i];
    if (!reference.variance.empty()) variance += reference.variance[i] / reference.count[i];
    r.variance.push_back(variance);
  }
  return r;
}

SumSkewness sum_skewness(const std::vector<double>& residuals) {
  const double n = static_cast<double>(residuals.size());
  double mean = 0;
  for (const double x : residuals) mean += x / n;
  double m2 = 0, m3 = 0, largest = 0;
  for (const double x : residuals) {
    const double d = x - mean;
    m2 += d * d;
    m3 += d * d * d;
    largest = std::max(largest, d * d);
  }
  if (!(m2 > 0)) return {};
  const double seen = m3 / (m2 * std::sqrt(m2));
  const double noise = 2 * std::sqrt(6.0) / n;
  return {std::copysign(std::max(0.0, std::abs(seen) - noise), seen), largest / m2};
}

TileScale test_tiles(const Residuals& residuals, int edge, double rounding_allowance) {
  const TileGrid grid = sum_tiles(residuals, edge, rounding_allowance);
  TileScale scale;
  scale.edge = edge;
  scale.width = grid.width;
  scale.height = grid.height;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      scale.tests.push_back(test_tile(residuals, grid.at(x, y), neighbourhood_error2(grid, x, y),
                                      rounding_allowance));
    }
  }
  return scale;
}

}  // namespace plumbline::verify
