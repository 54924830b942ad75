#include "allocation_reference.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include <plumbline/renderer/assembly/direct.h>

namespace plumbline::bench {
namespace {

constexpr std::size_t kShares = kIterationSamples + 1;

double share_of(std::size_t k) { return static_cast<double>(k) / kIterationSamples; }

/// Sums over the samples of one pixel.
class Sums {
 public:
  /// @param own  technique that drew the sample, of a mixture with equal shares
  void add(std::size_t own, const renderer::DirectSample& sample) {
    emission_ += static_cast<double>(luminance(sample.emission));
    if (is_black(sample.value)) return;
    const double ratio = static_cast<double>(sample.other_pdf) / static_cast<double>(sample.pdf);
    std::array<double, 2> density{};  // p_i over the mixture of halves
    density[own] = 2 / (1 + ratio);
    density[1 - own] = ratio * density[own];
    const double value = static_cast<double>(luminance(sample.value)) * density[own];
    mean_ += value;
    for (std::size_t k = 0; k < kShares; ++k) {
      const double mixture = share_of(k) * density[0] + (1 - share_of(k)) * density[1];
      // A ray may hit the limb of a light a rounding error outside the cone that light samples
      // fill: light samples alone then miss a sliver, which is not variance.
      const double inverse = mixture > 0 ? 1 / mixture : 0;
      moment_[k] += value * value * inverse;
      bsdf_mean_[k] += value * density[0] * inverse;
      overlap_[k] += density[0] * density[1] * inverse;
    }
  }

  PixelIntegrals integrals(double samples) const {
    PixelIntegrals result;
    result.mean = mean_ / samples;
    result.emission = emission_ / samples;
    for (std::size_t k = 0; k < kShares; ++k) {
      result.moment[k] = static_cast<float>(moment_[k] / samples);
      result.bsdf_mean[k] = static_cast<float>(bsdf_mean_[k] / samples);
      result.overlap[k] = static_cast<float>(overlap_[k] / samples);
    }
    return result;
  }

 private:
  double mean_ = 0, emission_ = 0;
  std::array<double, kShares> moment_{}, bsdf_mean_{}, overlap_{};
};

PixelIntegrals measure_pixel(const renderer::Scene& scene, int x, int y, std::uint64_t pixel,
                             std::uint32_t samples, std::uint64_t seed) {
  Sums sums;
  renderer::PathCounters counters;
  for (const std::size_t technique : {renderer::kBsdfTechnique, renderer::kLightTechnique}) {
    for (std::uint32_t s = 0; s < samples / 2; ++s) {
      renderer::Sampler points(renderer::SamplerType::sobol, seed, 2 * pixel + technique, s);
      const renderer::Ray ray = scene.camera().ray(x, y, points.next_2d());
      sums.add(technique, sample_direct_light(scene, ray, technique, points.next_2d(), counters));
    }
  }
  return sums.integrals(samples);
}

}  // namespace

double PixelIntegrals::mixture_variance(std::size_t k) const {
  return std::max(static_cast<double>(moment[k]) - mean * mean, 0.0);
}

double PixelIntegrals::count_variance(std::size_t k) const {
  const double a = share_of(k);
  const double m1 = static_cast<double>(bsdf_mean[k]);
  // a m₁ + (1 − a) m₂ = μ, so that Σ a_i (m_i − μ)² = a/(1 − a) (m₁ − μ)².
  const double of_means = k < kIterationSamples ? a / (1 - a) * (m1 - mean) * (m1 - mean) : 0;
  return std::max(mixture_variance(k) - of_means, 0.0);
}

double PixelIntegrals::optimal_weights_variance(std::size_t k) const {
  const double a = share_of(k), c = 1 - a;
  const auto o = static_cast<double>(overlap[k]);
  // ∫ p_i = 1 gives the diagonal of A from its overlap: a A₁₁ + (1 − a) A₁₂ = 1, and so for p₂;
  // then det A = (1 − A₁₂)/(a (1 − a)).
  const double a11 = (1 - c * o) / a, a22 = (1 - a * o) / c;
  const double determinant = (1 - o) / (a * c);
  if (!(determinant > 1e-9)) return mixture_variance(k);  // equal densities: nothing to correct
  const auto b1 = static_cast<double>(bsdf_mean[k]);
  const double b2 = (mean - a * b1) / c;
  const double explained = (a22 * b1 * b1 - 2 * o * b1 * b2 + a11 * b2 * b2) / determinant;
  return std::max(static_cast<double>(moment[k]) - explained, 0.0);
}

PixelIntegrals& PixelIntegrals::operator+=(const PixelIntegrals& other) {
  mean += other.mean;
  emission += other.emission;
  for (std::size_t k = 0; k < kShares; ++k) {
    moment[k] += other.moment[k];
    bsdf_mean[k] += other.bsdf_mean[k];
    overlap[k] += other.overlap[k];
  }
  return *this;
}

PixelIntegrals& PixelIntegrals::operator/=(double divisor) {
  mean /= divisor;
  emission /= divisor;
  const auto d = static_cast<float>(divisor);
  for (std::size_t k = 0; k < kShares; ++k) {
    moment[k] /= d;
    bsdf_mean[k] /= d;
    overlap[k] /= d;
  }
  return *this;
}

std::size_t best_share(const PixelIntegrals& pixel) {
  if (!(pixel.moment[kEqual] > 0)) return kEqual;
  constexpr std::size_t kFirst = kIterationSamples / 10, kLast = kIterationSamples - kFirst;
  const boost::math::interpolators::cardinal_cubic_b_spline<double> spline(
      pixel.moment.begin() + kFirst, pixel.moment.begin() + kLast + 1, share_of(kFirst),
      share_of(1));
  // Eight digits: the share is rounded to 1/50.
  const double share =
      boost::math::tools::brent_find_minima(spline, share_of(kFirst), share_of(kLast), 26).first;
  return static_cast<std::size_t>(std::lround(share * kIterationSamples));
}

std::vector<PixelIntegrals> measure_integrals(const renderer::Scene& scene, std::uint32_t samples,
                                              std::uint64_t seed) {
  const int width = scene.camera().width(), height = scene.camera().height();
  const auto row_length = static_cast<std::size_t>(width);
  std::vector<PixelIntegrals> pixels(row_length * static_cast<std::size_t>(height));
  oneapi::tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t index =
          static_cast<std::size_t>(y) * row_length + static_cast<std::size_t>(x);
      pixels[index] = measure_pixel(scene, x, y, index, samples, seed);
    }
  });
  return pixels;
}

double largest_around(const std::vector<PixelIntegrals>& pixels, int width, std::size_t pixel,
                      double (*quantity)(const PixelIntegrals&)) {
  const auto row = static_cast<std::size_t>(width);
  const std::size_t x = pixel % row, y = pixel / row, height = pixels.size() / row;
  double largest = 0;
  for (std::size_t v = y - std::min<std::size_t>(y, 1); v <= std::min(y + 1, height - 1); ++v) {
    for (std::size_t u = x - std::min<std::size_t>(x, 1); u <= std::min(x + 1, row - 1); ++u) {
      largest = std::max(largest, quantity(pixels[v * row + u]));
    }
  }
  return largest;
}

}  // namespace plumbline::bench
