#include <plumbline/renderer/core/render/film.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace plumbline::renderer {
namespace {

bool is_finite(const Rgbf& c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

Rgbd minus(const Rgbd& a, const Rgbd& b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }

void add_finite(const Rgbd& x, PixelMoments& to) {
  ++to.count;
  const Rgbd before = minus(x, to.mean);
  to.mean += before * (1.0 / to.count);
  to.sum_squares += before * minus(x, to.mean);
}

void add_sample(const Rgbf& sample, PixelMoments& to) {
  if (!is_finite(sample)) {
    ++to.non_finite;
    return;
  }
  add_finite(rgb_cast<double>(sample), to);
}

}  // namespace

void PixelMoments::add(const Rgbf& sample) { add({&sample, 1}); }

// Of a copy: each sample waits for the one before, and in memory longer than in registers.
void PixelMoments::add(std::span<const Rgbf> samples) {
  PixelMoments moments = *this;
  for (const Rgbf& sample : samples) add_sample(sample, moments);
  *this = moments;
}

void PixelMoments::add_replicate(const PixelMoments& replicate) {
  non_finite += replicate.non_finite;
  if (replicate.count > 0) add_finite(replicate.mean, *this);
}

void PixelMoments::merge(const PixelMoments& other) {
  non_finite += other.non_finite;
  if (other.count == 0) return;
  const double n_a = count, n_b = other.count, n = n_a + n_b;
  const Rgbd delta = minus(other.mean, mean);
  mean += delta * (n_b / n);
  sum_squares += other.sum_squares + delta * delta * (n_a * n_b / n);
  count += other.count;
}

Rgbd PixelMoments::variance() const {
  return count < 2 ? Rgbd{} : sum_squares / static_cast<double>(count - 1);
}

Film::Film(int width, int height)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

Film::Film(int width, int height, std::vector<PixelMoments> pixels)
    : width_(width), height_(height), pixels_(std::move(pixels)) {
  if (pixels_.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    throw std::invalid_argument("a film needs the moments of all its pixels");
  }
}

Rgbd Film::mean() const {
  Rgbd sum;
  for (const PixelMoments& pixel : pixels_) sum += pixel.mean;
  return sum / static_cast<double>(pixels_.size());
}

std::uint64_t Film::non_finite() const {
  std::uint64_t sum = 0;
  for (const PixelMoments& pixel : pixels_) sum += pixel.non_finite;
  return sum;
}

double Film::relative_error() const {
  double sum = 0;
  for (const PixelMoments& pixel : pixels_) {
    // The variance of a weighted sum of fully correlated channels is at most the square of the
    // weighted standard deviations; the channels of a path are close to that.
    const Rgbd v = pixel.variance();
    const double deviation = luminance(Rgbd{std::sqrt(v.r), std::sqrt(v.g), std::sqrt(v.b)});
    sum += sqr(deviation) / (pixel.count * (sqr(luminance(pixel.mean)) + 0.01));
  }
  return std::sqrt(sum / static_cast<double>(pixels_.size()));
}

}  // namespace plumbline::renderer
