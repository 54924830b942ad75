#include <plumbline/analytic/sphere_light.h>

#include <cmath>
#include <numbers>

namespace plumbline::analytic {
namespace {

using std::numbers::pi;

/// x − sin x for x in [0, π], to full relative precision.
double minus_sine(double x) {
  if (x > 1) return x - std::sin(x);
  // x³/3! − x⁵/5! + …: at x = 1 ten terms reach 1/21!, far below rounding.
  const double x2 = x * x;
  double term = x * x2 / 6;
  double sum = term;
  for (int n = 4; n <= 22; n += 2) {
    term *= -x2 / (n * (n + 1.0));
    sum += term;
  }
  return sum;
}

}  // namespace

// Lambert: E/L = ½ ∮ n·(r × dr) along the outline of the visible part on the unit sphere of
// directions. With the centre at distance d, sin σ = R/d, cos β = h/d (β between the normal n and
// the axis):
//
// Fully above the plane the outline is the whole circle, and E/L = π sin²σ cos β = π R² h/d³.
//
// Dipping into it (|h| < R) the outline is an arc of the circle, |φ| < φ₀, and a piece of the
// horizon. On the circle n·(r × dr) = sin σ (sin σ cos β − cos σ sin β cos φ) dφ; it meets the
// horizon where cos φ₀ = −cot σ cot β. The horizon is a great circle about n: it adds half its
// angle, ψ₀, with cos ψ₀ = cos σ/sin β. Together
//   E/L = sin²σ cos β φ₀ − sin σ cos σ sin β sin φ₀ + ψ₀.
// The last two terms are both of the order of σ and leave σ³, so they are rewritten. With
// sin σ sin β sin φ₀ = cos σ tan ψ₀ and cos²ψ₀ − cos²σ = cos²σ cot²β,
//   ψ₀ − cos²σ tan ψ₀ = (ψ₀ − sin ψ₀ cos ψ₀) + cos²σ cot²β tan ψ₀.
// With q² = R² − h² (the circle in which sphere and plane meet) and c² = d² − R² = r² − q²:
//   φ₀ = atan2(q d, −h c),  ψ₀ = atan2(q, c),  cos²σ cot²β tan ψ₀ = c q h²/(d² r²).
double sphere_irradiance(double radius, double height, double lateral) {
  const double d = std::hypot(height, lateral);
  if (d < radius || height <= -radius) return 0;
  const double full = (radius / d) * (radius / d) * (height / d);
  if (height >= radius) return pi * full;
  const double q = std::sqrt((radius - height) * (radius + height));
  const double c = std::sqrt(std::fmax(0, (lateral - q) * (lateral + q)));  // < 0 by rounding only
  const double phi = std::atan2(q * d, -height * c);
  const double psi = std::atan2(q, c);
  const double h_over_r = height / lateral;
  return full * phi + 0.5 * minus_sine(2 * psi) + c / d * (q / d) * h_over_r * h_over_r;
}

double sphere_irradiance_mean_above(double radius, double height, double x0, double x1, double y0,
                                    double y1) {
  const double a = std::hypot(x0, y0, height);
  const double b = std::hypot(x1, y0, height);
  const double c = std::hypot(x1, y1, height);
  const double e = std::hypot(x0, y1, height);
  const double h2 = height * height;
  const double ab = x0 * x1 + y0 * y0 + h2;
  const double ac = x0 * x1 + y0 * y1 + h2;
  const double bc = x1 * x1 + y0 * y1 + h2;
  const double ae = x0 * x0 + y0 * y1 + h2;
  const double ce = x0 * x1 + y1 * y1 + h2;
  // Two triangles a b c and a c e (Van Oosterom and Strackee 1983, Eq. 8): tan(Ω/2) = triple
  // product over abc + (a·b)c + …; the triple product is h·Δx·Δy, so nothing cancels however small
  // the rectangle.
  const double triple = height * (x1 - x0) * (y1 - y0);
  const double solid_angle = 2 * std::atan2(triple, a * b * c + ab * c + ac * b + bc * a) +
                             2 * std::atan2(triple, a * c * e + ac * e + ae * c + ce * a);
  return pi * radius * radius * solid_angle / ((x1 - x0) * (y1 - y0));
}

}  // namespace plumbline::analytic
