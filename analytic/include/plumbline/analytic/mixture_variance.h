#pragma once

#include <cstddef>

#include <plumbline/analytic/integral1d.h>

/// The variance of a mixture of two densities as a function of the share of the first: what the
/// allocation of samples minimises, by quadrature.
namespace plumbline::analytic {

/// With p = αp₁ + (1 − α)p₂, and its derivatives in α from ∂(1/p)/∂α = (p₂ − p₁)/p².
struct MixtureVariance {
  double variance = 0;   ///< V = ∫ f²/p − μ²
  double slope = 0;      ///< V′ = ∫ f² (p₂ − p₁)/p²
  double curvature = 0;  ///< V″ = 2 ∫ f² (p₂ − p₁)²/p³
};

/// @param integral  with exactly two densities
/// @param alpha     in (0, 1)
MixtureVariance mixture_variance(const Integral1d& integral, double alpha);

/// α in [low, high] of least V: the root of V′, or the end that V falls towards.
double best_share(const Integral1d& integral, double low, double high);

/// ∫ f²/p_i: infinite where density i misses a part of the integrand or falls off too fast.
double second_moment(const Integral1d& integral, std::size_t i);

}  // namespace plumbline::analytic
