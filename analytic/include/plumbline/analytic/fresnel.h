#pragma once

#include <complex>

namespace plumbline::analytic {

/// Refractive index n + ik, k ≥ 0 absorbing.
using Index = std::complex<double>;

/// Reflectance of a plane interface for unpolarised light, textbook form in complex amplitudes.
///
/// @param cosine   of the angle of incidence, in [0, 1]
/// @param outside  index of the side that the light comes from, > 0
/// @param inside   of the other side
/// @return         in [0, 1]; 1 beyond the critical angle
/// @source         Born, Wolf, Principles of Optics, Section 1.5.2, Eqs. 21–21a
double interface_reflectance(double cosine, double outside, Index inside);

/// Reflectance of a plane film at one wavelength: Airy's sum of all bounces.
///
/// @param film        index of the film, > 0
/// @param thickness   ≥ 0, in the unit of `wavelength`
/// @param wavelength  in vacuum, > 0
/// @return            unpolarised, in [0, 1]
/// @source            Born, Wolf, Section 1.6.4, Eq. 57
double film_reflectance(double cosine, double outside, double film, Index base, double thickness,
                        double wavelength);

/// Mean of `film_reflectance` over wavenumbers 1/λ between those of two wavelengths, by adaptive
/// quadrature to 1e-10.
double film_band_reflectance(double cosine, double outside, double film, Index base,
                             double thickness, double wavelength_low, double wavelength_high);

}  // namespace plumbline::analytic
