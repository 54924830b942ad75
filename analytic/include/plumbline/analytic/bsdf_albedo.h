#pragma once

#include <functional>

#include <plumbline/analytic/camera.h>

/// Directional albedos of BSDFs by quadrature: what a white sky sends back to the eye.
namespace plumbline::analytic {

/// GGX roughness along x and y of the local frame.
struct Roughness {
  double x, y;
};

/// A share of the power as a function of the cosine on the side of wo.
using Share = std::function<double(double)>;

/// Power that single scattering from a GGX surface reflects.
///
/// Integrates over normals, in the slopes in which their distribution is uniform (never over
/// visible normals, which is how renderers sample them):
/// albedo = E_D[share(wo·h) G1(wo) G1(wi) (wo·h) / (cosθo cosθh)].
///
/// @param wo           unit, z > 0
/// @param reflectance  Fresnel's or any other
/// @return             in [0, 1], to about 1e-6
/// @source             Walter et al. 2007, Eqs. 20, 14, 34 (Smith's G1 for GGX)
double ggx_reflection_albedo(const Roughness& roughness, const Vec3& wo, const Share& reflectance);

/// Power that it refracts to the other side, in units of the power that falls on it (radiance is
/// (η_o/η_i)² times that).
///
/// @param eta            index of the other side over that of wo's
/// @param transmittance  0 beyond the critical angle
/// @source               Walter et al. 2007, Eqs. 21, 17, 40
double ggx_refraction_albedo(const Roughness& roughness, const Vec3& wo, double eta,
                             const Share& transmittance);

/// Albedo of the modified Phong lobe of reflectance 1: (n + 2)/(2π) ∫ cosⁿα cosθi dω above the
/// horizon; 1 at normal incidence.
///
/// @param cosine  of wo, in [0, 1]
double phong_albedo(double exponent, double cosine);

/// Share of the density (n + 1)/(2π) cosⁿα about the mirror direction that lies above the horizon.
double phong_mass_above_horizon(double exponent, double cosine);

/// E + albedo (1 − E), where E is what the coat alone reflects: a coat that takes nothing, over a
/// diffuse base that gets and gives back the rest.
///
/// @param eta  index of the coat over the outside
double clear_coat_albedo(double eta, double alpha, double base_albedo, double cosine);

}  // namespace plumbline::analytic
