#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <plumbline/analytic/density1d.h>

/// Integrals on the line with known values, and densities to sample them with.
namespace plumbline::analytic {

struct Integral1d {
  std::string name;     ///< "two_steps"
  std::string formula;  ///< for people: "8 on [0, 0.9), 80 on [0.9, 1]"
  double low = 0, high = 1;
  std::function<double(double)> f;  ///< ≥ 0, and 0 outside [low, high]
  std::vector<double> breaks;  ///< inside (low, high): where f or a density jumps, kinks or peaks
  double value = 0;            ///< ∫ f, in closed form
  std::vector<Density1d> densities;
  std::vector<bool>
      infinite_variance;  ///< of f/p_i alone, for each density; proven beside the integral
};

/// Seed example: f = 8 on [0, 0.9), 80 on [0.9, 1]; uniform on [0, 1] and on [0.9, 1], of which the
/// second alone sees 8 of the 15.2.
Integral1d two_steps();

/// A normal density as integrand on the whole line, sampled from a narrower one (sd 0.6) and a
/// wider one (sd 2). The narrower has infinite variance, see `gaussian_ratio_second_moment`.
Integral1d bad_gaussian_line();

/// A Gaussian hump (sd 0.15) on [0, 1], sampled from a narrower Gaussian (sd 0.06) and a constant.
/// The narrower alone has a finite variance too large to be of any use.
Integral1d bad_gaussian_interval();

/// A broad lobe times a narrow peak over a floor, sampled in proportion to each factor.
Integral1d broad_times_peaked();

/// The product of two peaks over floors: neither factor's density sees the other's peak.
Integral1d peaked_times_peaked();

/// Light that a sidewalk reflects from the sun in its zenith and a uniform sky, as an integral over
/// v = 1 − cosθ: sampled uniformly over the hemisphere, and uniformly over the sun.
Integral1d sun_and_sidewalk();

/// Three humps, each with a density around it; the third density alone is terrible.
Integral1d three_peaks();

/// The seven above.
const std::vector<Integral1d>& known_integrals();

/// Integrands (polynomials, exponentials, a jump) × sets of two to eight densities that together
/// cover them, for tables of combinations.
const std::vector<Integral1d>& combination_integrals();

/// ∫ f²/p over the line for f and p normal densities of equal mean: infinite unless σp² > σf²/2.
///
/// f²/p = σp/(σf² √2π) e^(−a x²) with a = 1/σf² − 1/(2σp²), and ∫ e^(−a x²) = √(π/a) if a > 0.
double gaussian_ratio_second_moment(double sd_f, double sd_p);

/// Fraction of the hemisphere's directions within `half_angle` [rad] of one above the horizon:
/// 1 − cos = 2 sin²(half_angle/2), the solid angle over 2π.
double cone_fraction(double half_angle);

/// Number of samples after which the mean of a 0-or-1 variable with probability `probability` has
/// the given relative standard deviation: (1 − q)/q/ε².
double samples_for_relative_error(double probability, double relative_error);

/// Half angle under which the sun is seen [rad]: 0.2665°.
double sun_half_angle();

}  // namespace plumbline::analytic
