#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>

#include <plumbline/verify/budget.h>
#include <plumbline/verify/random.h>
#include <plumbline/verify/result.h>
#include <plumbline/verify/vector_access.h>

namespace plumbline::verify {

/// What a chi-square check is asked.
struct ChiSquareOptions {
  std::string subject;
  std::uint64_t first_look = 100'000;
  std::uint64_t samples = 1'000'000;  ///< at the last look
  int finest_bins = 4096;  ///< of about equal expected mass; coarser levels are merged from it

  /// A pass proves that the relative deviation of the samples' density from the pdf, root mean
  /// square over the bins of the coarsest level (64), is at most this.
  double tolerance = 0.0125;

  /// |Σ expected mass + rejected share − 1| beyond this, and beyond the error of both, fails.
  double mass_tolerance = 5e-5;

  Verdict expected = Verdict::pass;
  std::uint64_t seed = 1;
  ErrorBudget budget;
};

/// A pair on the sphere with types erased: the direction sampled from the generator, and its
/// density.
struct SpherePair {
  std::function<std::optional<Vec3>(Random&)> sample;
  std::function<double(const Vec3&)> pdf_w;  ///< [1/sr]
};

/// Chi-square test of directions against the integral of their density over bins that follow it.
///
/// The sphere is cut into rectangles of (cosθ, φ), split where pilot samples fall until each holds
/// about the same mass. The pdf is integrated over each by adaptive cubature with an error
/// estimate; if the sum of these errors exceeds the mass tolerance the check is `inconclusive`.
/// Bins are tested coarse to fine under one level, at growing sample counts. A bin where the pdf is
/// 0 fails on its first sample; rejected samples are a category of their own.
///
/// `fail` at the level of the error budget; `pass` if the deviation is proven below the tolerance.
CheckResult check_chi_square(const ChiSquareOptions& options, const SpherePair& pair);

/// The same for a user's own types.
///
/// @param density  pdf_w [1/sr] of a unit direction
/// @param sampler  given two numbers uniform in [0, 1) (as scalars of the direction's type) an
/// optional
///                 direction: `sampler(u1, u2) -> std::optional<V>`
template <class Direction, class Density, class Sampler>
CheckResult check_chi_square(const ChiSquareOptions& options, Density&& density,
                             Sampler&& sampler) {
  using T = ScalarOf<Direction>;
  SpherePair pair;
  pair.pdf_w = [&](const Vec3& w) { return static_cast<double>(density(from_vec3<Direction>(w))); };
  pair.sample = [&](Random& random) -> std::optional<Vec3> {
    const T u1 = uniform<T>(random);
    const T u2 = uniform<T>(random);
    const std::optional<Direction> w = sampler(u1, u2);
    if (!w) return std::nullopt;
    return to_vec3(*w);
  };
  return check_chi_square(options, pair);
}

}  // namespace plumbline::verify
