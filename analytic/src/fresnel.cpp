#include <plumbline/analytic/fresnel.h>

#include <array>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace plumbline::analytic {
namespace {

/// Cosine of the refracted angle; imaginary beyond the critical angle. Of the two roots the one
/// whose wave decays or travels on, not the one that grows.
Index cosine_in(Index medium, double sine, double outside) {
  const Index s = outside * sine / medium;
  const Index root = std::sqrt(1.0 - s * s);
  return (medium * root).imag() < 0 ? -root : root;
}

struct Amplitudes {
  Index s, p;
};

/// Amplitudes at the step from a medium (index a, cosine ca) to another (b, cb).
Amplitudes amplitudes(Index a, Index ca, Index b, Index cb) {
  return {(a * ca - b * cb) / (a * ca + b * cb), (b * ca - a * cb) / (b * ca + a * cb)};
}

double sine_of(double cosine) { return std::sqrt((1 - cosine) * (1 + cosine)); }

double unpolarised(const Amplitudes& r) { return (std::norm(r.s) + std::norm(r.p)) / 2; }

}  // namespace

double interface_reflectance(double cosine, double outside, Index inside) {
  return unpolarised(
      amplitudes(outside, cosine, inside, cosine_in(inside, sine_of(cosine), outside)));
}

double film_reflectance(double cosine, double outside, double film, Index base, double thickness,
                        double wavelength) {
  const double sine = sine_of(cosine);
  const Index in_film = cosine_in(film, sine, outside), in_base = cosine_in(base, sine, outside);
  const Amplitudes top = amplitudes(outside, cosine, film, in_film);
  const Amplitudes bottom = amplitudes(film, in_film, base, in_base);
  const Index i(0, 1);
  const Index turn = std::exp(4 * std::numbers::pi * i * film * thickness * in_film / wavelength);
  const auto sum = [&](Index r12, Index r23) {
    return (r12 + r23 * turn) / (1.0 + r12 * r23 * turn);
  };
  return unpolarised({sum(top.s, bottom.s), sum(top.p, bottom.p)});
}

double film_band_reflectance(double cosine, double outside, double film, Index base,
                             double thickness, double wavelength_low, double wavelength_high) {
  using boost::math::quadrature::gauss_kronrod;
  const double low = 1 / wavelength_high, high = 1 / wavelength_low;
  const auto reflectance = [&](double wavenumber) {
    return film_reflectance(cosine, outside, film, base, thickness, 1 / wavenumber);
  };
  return gauss_kronrod<double, 31>::integrate(reflectance, low, high, 12, 1e-10) / (high - low);
}

}  // namespace plumbline::analytic
