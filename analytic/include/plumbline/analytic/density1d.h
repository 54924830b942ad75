#pragma once

#include <functional>
#include <string>
#include <vector>

namespace plumbline::analytic {

/// A probability density on the line with its inverse distribution function.
struct Density1d {
  std::string name;  ///< for figures and messages: "uniform on [0.9, 1]"
  double low = 0;    ///< the density is 0 outside [low, high]; either may be infinite
  double high = 1;
  std::function<double(double)> pdf_x;     ///< [1/unit]
  std::function<double(double)> quantile;  ///< x with P(X ≤ x) = u, for u in (0, 1); in [low, high]
};

/// 1/(high − low) on [low, high].
Density1d uniform_density(double low, double high);

/// (k + 1) x^k on [0, 1], k > −1.
Density1d rising_density(double k);

/// (k + 1) (1 − x)^k on [0, 1], k > −1.
Density1d falling_density(double k);

/// Proportional to e^(rate·x) on [low, high]; rate ≠ 0.
Density1d exponential_density(double rate, double low, double high);

/// Normal density on the whole line.
Density1d gaussian_density(double mean, double sd);

/// Normal density cut to [low, high] and normalised there.
Density1d truncated_gaussian_density(double mean, double sd, double low, double high);

/// share·a + (1 − share)·b, for densities on disjoint or overlapping supports, share in (0, 1).
///
/// Its quantile draws from `a` for u below `share` and from `b` above: not monotonic, but a map of
/// the uniform density onto the mixture, which is all that sampling needs.
Density1d mixture_density(double share, const Density1d& a, const Density1d& b);

/// ∫ of exp(−(x − mean)²/(2 sd²)) from low to high, without cancellation in the tails.
double gaussian_integral(double mean, double sd, double low, double high);

}  // namespace plumbline::analytic
