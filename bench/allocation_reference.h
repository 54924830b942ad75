#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <plumbline/renderer/core/scene/scene.h>

namespace plumbline::bench {

/// Samples of one iteration of the experiment: the shares that a policy can visit are k/50.
inline constexpr std::size_t kIterationSamples = 50;
inline constexpr std::size_t kEqual = kIterationSamples / 2;  ///< as many of each technique

/// The reflected direct light of one pixel, as functions of the share α = k/50 of BSDF samples,
/// with p = αp₁ + (1 − α)p₂. Luminance; the position inside the pixel is part of the domain.
struct PixelIntegrals {
  using ByShare = std::array<float, kIterationSamples + 1>;

  double mean = 0;      ///< μ = ∫ f
  double emission = 0;  ///< seen directly, which no allocation touches
  ByShare moment{};     ///< ∫ f²/p
  ByShare bsdf_mean{};  ///< ∫ p₁ f/p: what BSDF samples of the mixture average to
  ByShare overlap{};    ///< ∫ p₁p₂/p

  /// Of one sample of the random mixture: ∫ f²/p − μ².
  double mixture_variance(std::size_t k) const;

  /// N times the variance of N samples of which exactly αN come from the BSDF: the means of the
  /// techniques, which differ, no longer add to it.
  double count_variance(std::size_t k) const;

  /// N times the variance of N samples with optimal weights: ∫ f²/p − bᵀA⁻¹b.
  /// @source Kondapaneni et al. 2019, Section 4, with A and b over the mixture of unit mass
  double optimal_weights_variance(std::size_t k) const;

  PixelIntegrals& operator+=(const PixelIntegrals& other);
  PixelIntegrals& operator/=(double divisor);
};

/// Share of BSDF samples, as a multiple of 1/50 in [0.1, 0.9], that minimises the mixture variance:
/// by Brent's method on a spline through the shares.
std::size_t best_share(const PixelIntegrals& pixel);

/// Estimates the integrals of every pixel from samples of both techniques, half each, on
/// Owen-scrambled Sobol' points.
///
/// @param samples  per pixel, a power of two
std::vector<PixelIntegrals> measure_integrals(const renderer::Scene& scene, std::uint32_t samples,
                                              std::uint64_t seed);

/// Largest of a quantity over a pixel and those around it.
double largest_around(const std::vector<PixelIntegrals>& pixels, int width, std::size_t pixel,
                      double (*quantity)(const PixelIntegrals&));

/// Variance of one sample at equal counts.
inline double equal_variance(const PixelIntegrals& pixel) { return pixel.count_variance(kEqual); }

}  // namespace plumbline::bench
