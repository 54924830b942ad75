#include <plumbline/analytic/integral1d.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace plumbline::analytic {
namespace {

using std::numbers::pi;

double hump(double x, double mean, double sd) {
  const double z = (x - mean) / sd;
  return std::exp(-0.5 * z * z);
}

struct Hump {
  double height, mean, sd;
};

/// The product of two Gaussian humps with means m, n and variances s², t² is one of variance
/// s²t²/(s² + t²) about the mean weighted with the other's variance, exp(−(m − n)²/(2 (s² + t²)))
/// high.
Hump product_of_humps(double m, double s, double n, double t) {
  const double sum = s * s + t * t;
  return {hump(m, n, std::sqrt(sum)), (m * t * t + n * s * s) / sum, s * t / std::sqrt(sum)};
}

bool inside(double x) { return x >= 0 && x <= 1; }

}  // namespace

Integral1d two_steps() {
  Integral1d integral;
  integral.name = "two_steps";
  integral.formula = "8 on [0, 0.9), 80 on [0.9, 1]";
  integral.f = [](double x) { return inside(x) ? (x < 0.9 ? 8.0 : 80.0) : 0.0; };
  integral.breaks = {0.9};
  integral.value = 15.2;  // 8 · 0.9 + 80 · 0.1
  integral.densities = {uniform_density(0, 1), uniform_density(0.9, 1)};
  integral.infinite_variance = {false, false};
  return integral;
}

// The narrow density: a = 1/1 − 1/(2 · 0.36) < 0, f²/p grows without bound. The wide one: a = 1 −
// 1/8. Beyond |x| = 40 the integrand underflows to 0 in double, so the line ends there.
Integral1d bad_gaussian_line() {
  Integral1d integral;
  integral.name = "bad_gaussian_line";
  integral.formula = "normal density, sd 1, on the whole line";
  integral.low = -40;
  integral.high = 40;
  integral.f = [](double x) { return hump(x, 0, 1) / std::sqrt(2 * pi); };
  integral.breaks = {-12, -8, -6, -4, -3, -2, -1, 0, 1, 2, 3, 4, 6, 8, 12};
  integral.value = 1;
  integral.densities = {gaussian_density(0, 0.6), gaussian_density(0, 2)};
  integral.infinite_variance = {true, false};
  return integral;
}

Integral1d bad_gaussian_interval() {
  Integral1d integral;
  integral.name = "bad_gaussian_interval";
  integral.formula = "Gaussian hump at 0.5, sd 0.15, on [0, 1]";
  integral.f = [](double x) { return inside(x) ? hump(x, 0.5, 0.15) : 0; };
  integral.breaks = {0.1, 0.3, 0.5, 0.7, 0.9};
  integral.value = gaussian_integral(0.5, 0.15, 0, 1);
  integral.densities = {truncated_gaussian_density(0.5, 0.06, 0, 1), uniform_density(0, 1)};
  integral.infinite_variance = {false, false};
  return integral;
}

// f = lobe · (floor + peak).
Integral1d broad_times_peaked() {
  constexpr double kLobeMean = 0.4;
  constexpr double kLobeSd = 0.25;
  constexpr double kPeakMean = 0.6;
  constexpr double kPeakSd = 0.01;
  constexpr double kFloor = 0.02;
  const Hump product = product_of_humps(kLobeMean, kLobeSd, kPeakMean, kPeakSd);

  Integral1d integral;
  integral.name = "broad_times_peaked";
  integral.formula =
      "Gaussian lobe (0.4, sd 0.25) times (0.02 + Gaussian peak (0.6, sd 0.01)) on [0, 1]";
  integral.f = [=](double x) {
    return inside(x) ? hump(x, kLobeMean, kLobeSd) * (kFloor + hump(x, kPeakMean, kPeakSd)) : 0;
  };
  integral.breaks = {0.2, 0.4, 0.5, 0.54, 0.57, 0.58, 0.6, 0.62, 0.63, 0.66, 0.7, 0.8};
  integral.value = kFloor * gaussian_integral(kLobeMean, kLobeSd, 0, 1) +
                   product.height * gaussian_integral(product.mean, product.sd, 0, 1);
  const double peak_area = gaussian_integral(kPeakMean, kPeakSd, 0, 1);
  integral.densities = {truncated_gaussian_density(kLobeMean, kLobeSd, 0, 1),
                        mixture_density(kFloor / (kFloor + peak_area), uniform_density(0, 1),
                                        truncated_gaussian_density(kPeakMean, kPeakSd, 0, 1))};
  integral.infinite_variance = {false, false};
  return integral;
}

// f = (0.1 + a) (0.1 + b): the four products integrate to 0.01 + 0.1 ∫a + 0.1 ∫b + ∫ab, the last as
// above.
Integral1d peaked_times_peaked() {
  constexpr double kMeanA = 0.3;
  constexpr double kSdA = 0.02;
  constexpr double kMeanB = 0.7;
  constexpr double kSdB = 0.03;
  constexpr double kFloor = 0.1;
  const double area_a = gaussian_integral(kMeanA, kSdA, 0, 1);
  const double area_b = gaussian_integral(kMeanB, kSdB, 0, 1);
  const Hump product = product_of_humps(kMeanA, kSdA, kMeanB, kSdB);

  Integral1d integral;
  integral.name = "peaked_times_peaked";
  integral.formula =
      "(0.1 + Gaussian at 0.3, sd 0.02) times (0.1 + Gaussian at 0.7, sd 0.03) on [0, 1]";
  integral.f = [=](double x) {
    return inside(x) ? (kFloor + hump(x, kMeanA, kSdA)) * (kFloor + hump(x, kMeanB, kSdB)) : 0;
  };
  integral.breaks = {0.2,  0.24, 0.27, 0.3, 0.33, 0.36, 0.4, 0.5,
                     0.56, 0.62, 0.66, 0.7, 0.74, 0.78, 0.84};
  integral.value = kFloor * kFloor + kFloor * (area_a + area_b) +
                   product.height * gaussian_integral(product.mean, product.sd, 0, 1);
  integral.densities = {mixture_density(kFloor / (kFloor + area_a), uniform_density(0, 1),
                                        truncated_gaussian_density(kMeanA, kSdA, 0, 1)),
                        mixture_density(kFloor / (kFloor + area_b), uniform_density(0, 1),
                                        truncated_gaussian_density(kMeanB, kSdB, 0, 1))};
  integral.infinite_variance = {false, false};
  return integral;
}

// Radiance reflected by a Lambertian of albedo ½ under the zenith sun:
//   (albedo/π) ∫ L cosθ dω = 2 albedo ∫ L(v) (1 − v) dv,  v = 1 − cosθ in [0, 1],
// with L = 10⁶ for v < q = 1 − cos(0.2665°) and 1 beyond. Uniform directions are uniform in v.
Integral1d sun_and_sidewalk() {
  constexpr double kSun = 1e6;
  const double q = cone_fraction(sun_half_angle());
  Integral1d integral;
  integral.name = "sun_and_sidewalk";
  integral.formula =
      "(1 - v) L(v), v = 1 - cos(theta): L = 1e6 within the sun's 0.2665 degrees, 1 beyond";
  integral.f = [=](double v) { return inside(v) ? (1 - v) * (v < q ? kSun : 1) : 0; };
  integral.breaks = {q};
  integral.value = 0.5 + (kSun - 1) * (q - 0.5 * q * q);
  integral.densities = {uniform_density(0, 1), uniform_density(0, q)};
  integral.infinite_variance = {false, false};
  return integral;
}

Integral1d three_peaks() {
  Integral1d integral;
  integral.name = "three_peaks";
  integral.formula = "three Gaussian humps at 0.2, 0.5 and 0.8 on [0, 1]";
  integral.f = [](double x) {
    return inside(x) ? hump(x, 0.2, 0.06) + 0.6 * hump(x, 0.5, 0.05) + 0.8 * hump(x, 0.8, 0.04) : 0;
  };
  integral.breaks = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  integral.value = gaussian_integral(0.2, 0.06, 0, 1) + 0.6 * gaussian_integral(0.5, 0.05, 0, 1) +
                   0.8 * gaussian_integral(0.8, 0.04, 0, 1);
  integral.densities = {truncated_gaussian_density(0.2, 0.3, 0, 1),
                        truncated_gaussian_density(0.5, 0.2, 0, 1),
                        truncated_gaussian_density(0.8, 0.2, 0, 1)};
  integral.infinite_variance = {false, false, false};
  return integral;
}

const std::vector<Integral1d>& known_integrals() {
  static const std::vector<Integral1d> integrals = {
      two_steps(),          bad_gaussian_line(),   bad_gaussian_interval(),
      broad_times_peaked(), peaked_times_peaked(), sun_and_sidewalk(),
      three_peaks()};
  return integrals;
}

double gaussian_ratio_second_moment(double sd_f, double sd_p) {
  const double a = 1 / (sd_f * sd_f) - 1 / (2 * sd_p * sd_p);
  if (!(a > 0)) return std::numeric_limits<double>::infinity();
  return sd_p / (sd_f * sd_f * std::sqrt(2 * pi)) * std::sqrt(pi / a);
}

double cone_fraction(double half_angle) {
  const double s = std::sin(0.5 * half_angle);
  return 2 * s * s;
}

double samples_for_relative_error(double probability, double relative_error) {
  return (1 - probability) / probability / (relative_error * relative_error);
}

double sun_half_angle() { return 0.2665 * pi / 180; }

}  // namespace plumbline::analytic
