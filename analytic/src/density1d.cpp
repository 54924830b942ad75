#include <plumbline/analytic/density1d.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numbers>
#include <sstream>

#include <boost/math/special_functions/erf.hpp>

namespace plumbline::analytic {
namespace {

template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream stream;
  stream << std::setprecision(3);
  (stream << ... << parts);
  return stream.str();
}

/// P(Z > z) of the standard normal, precise in both tails.
double upper_tail(double z) { return 0.5 * std::erfc(z / std::numbers::sqrt2); }

/// z with P(Z > z) = u.
double upper_quantile(double u) { return std::numbers::sqrt2 * boost::math::erfc_inv(2 * u); }

/// P(a < Z < b): the difference of the two smaller tails, so that it does not cancel on one side.
double normal_mass(double a, double b) {
  return a > 0 ? upper_tail(a) - upper_tail(b) : upper_tail(-b) - upper_tail(-a);
}

}  // namespace

Density1d uniform_density(double low, double high) {
  return {text("uniform on [", low, ", ", high, "]"), low, high,
          [=](double x) { return x >= low && x <= high ? 1 / (high - low) : 0; },
          [=](double u) { return low + u * (high - low); }};
}

Density1d rising_density(double k) {
  return {text("rising like x^", k), 0, 1,
          [=](double x) { return x >= 0 && x <= 1 ? (k + 1) * std::pow(x, k) : 0; },
          [=](double u) { return std::pow(u, 1 / (k + 1)); }};
}

Density1d falling_density(double k) {
  return {text("falling like (1 - x)^", k), 0, 1,
          [=](double x) { return x >= 0 && x <= 1 ? (k + 1) * std::pow(1 - x, k) : 0; },
          [=](double u) { return -std::expm1(std::log1p(-u) / (k + 1)); }};
}

Density1d exponential_density(double rate, double low, double high) {
  // F(x) = expm1(rate (x − low))/expm1(rate (high − low)).
  const double whole = std::expm1(rate * (high - low));
  return {text("exponential, rate ", rate), low, high,
          [=](double x) {
            return x >= low && x <= high ? rate * std::exp(rate * (x - low)) / whole : 0;
          },
          [=](double u) { return std::min(high, low + std::log1p(u * whole) / rate); }};
}

Density1d gaussian_density(double mean, double sd) {
  const double scale = 1 / (sd * std::sqrt(2 * std::numbers::pi));
  const double infinity = std::numeric_limits<double>::infinity();
  return {text("Gaussian, mean ", mean, ", sd ", sd), -infinity, infinity,
          [=](double x) {
            const double z = (x - mean) / sd;
            return scale * std::exp(-0.5 * z * z);
          },
          [=](double u) { return mean - sd * upper_quantile(u); }};
}

Density1d truncated_gaussian_density(double mean, double sd, double low, double high) {
  const double scale = 1 / gaussian_integral(mean, sd, low, high);
  const double below = upper_tail((mean - low) / sd);  // P(X < low) of the uncut density
  const double inside = normal_mass((low - mean) / sd, (high - mean) / sd);
  return {text("Gaussian, mean ", mean, ", sd ", sd, ", on [", low, ", ", high, "]"), low, high,
          [=](double x) {
            if (!(x >= low && x <= high)) return 0.0;
            const double z = (x - mean) / sd;
            return scale * std::exp(-0.5 * z * z);
          },
          [=](double u) {
            return std::clamp(mean - sd * upper_quantile(below + u * inside), low, high);
          }};
}

Density1d mixture_density(double share, const Density1d& a, const Density1d& b) {
  return {text(share, " of (", a.name, ") + ", 1 - share, " of (", b.name, ")"),
          std::min(a.low, b.low), std::max(a.high, b.high),
          [=](double x) { return share * a.pdf_x(x) + (1 - share) * b.pdf_x(x); },
          [=](double u) {
            return u < share ? a.quantile(u / share) : b.quantile((u - share) / (1 - share));
          }};
}

double gaussian_integral(double mean, double sd, double low, double high) {
  return sd * std::sqrt(2 * std::numbers::pi) * normal_mass((low - mean) / sd, (high - mean) / sd);
}

}  // namespace plumbline::analytic
