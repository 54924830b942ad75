#include <plumbline/analytic/polygon_light.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace plumbline::analytic {
namespace {

using std::numbers::pi;

double length(const Vec3& a) { return std::hypot(a.x, a.y, a.z); }

/// The part with n·r ≥ 0 of a polygon around the origin (Sutherland, Hodgman 1974).
Polygon clip(const Polygon& polygon, const Vec3& n) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& a = polygon[i];
    const Vec3& b = polygon[(i + 1) % polygon.size()];
    const double above_a = dot(a, n);
    const double above_b = dot(b, n);
    if (above_a >= 0) kept.push_back(a);
    if ((above_a > 0 && above_b < 0) || (above_a < 0 && above_b > 0)) {
      kept.push_back(a + (b - a) * (above_a / (above_a - above_b)));
    }
  }
  return kept;
}

Polygon seen_from(const Polygon& polygon, const Vec3& point, const Vec3& normal) {
  Polygon moved;
  for (const Vec3& corner : polygon) moved.push_back(corner - point);
  return clip(moved, normal);
}

/// Positive where the corners run counter-clockwise as seen from the origin's far side.
double signed_solid_angle(const Polygon& p) {
  double sum = 0;
  for (std::size_t i = 2; i < p.size(); ++i) {
    const double a = length(p[0]), b = length(p[i - 1]), c = length(p[i]);
    sum += 2 * std::atan2(dot(p[0], cross(p[i - 1], p[i])), a * b * c + dot(p[0], p[i - 1]) * c +
                                                                dot(p[0], p[i]) * b +
                                                                dot(p[i - 1], p[i]) * a);
  }
  return sum;
}

/// ∮ (w·u)ᵏ a·ν ds along the boundary of a region of directions, for a = v and a = w.
struct Boundary {
  double along_v = 0, along_w = 0;
};

// Moments by Stokes' theorem. On the unit sphere let P = I − u uᵀ, g = (w·u)ⁿ, and take the
// tangential field g·Pv. div Pv = −2 v·u, and ∇g·Pv = n (w·u)ⁿ⁻¹ (w·v − (w·u)(v·u)), so
//   div(g Pv) = n (w·v)(w·u)ⁿ⁻¹ − (n + 2)(w·u)ⁿ (v·u),
// and with ν the outward normal of the boundary within the sphere
//   (n + 2) τⁿ·¹ = n (w·v) τⁿ⁻¹ − ∮ (w·u)ⁿ v·ν ds.
// With v = w: (k + 1) τᵏ = (k − 1) τᵏ⁻² − ∮ (w·u)ᵏ⁻¹ w·ν ds. τ⁰ is the solid angle.
//
// `next()` gives the boundary integrals for the exponents n mod 2, n mod 2 + 2, …, n, one a call.
template <class NextBoundary>
double double_axis_moment(int n, double w_dot_v, double solid_angle, const NextBoundary& next) {
  double single = n % 2 == 1 ? solid_angle : 0;  // τᵏ, k of the parity of n − 1
  for (int k = n % 2 == 1 ? 2 : 1; k <= n - 1; k += 2) {
    single = ((k - 1) * single - next().along_w) / (k + 1);
  }
  return (n * w_dot_v * single - next().along_v) / (n + 2);
}

/// An edge as an arc of a great circle, on which w·u = c cos t, and ∫ (w·u)ᵏ ds along it for k = n
/// mod 2 and then two more at each step.
class Arc {
 public:
  Arc(const Vec3& from, const Vec3& to, const Vec3& w, int n) : k_(n % 2) {
    const Vec3 a = normalize(from);
    const Vec3 inward = normalize(cross(from, to));
    const Vec3 b = cross(inward, a);  // a turned towards `to` by a quarter
    const double angle = std::atan2(length(cross(from, to)), dot(from, to));
    const double c = std::hypot(dot(w, a), dot(w, b));
    const double t0 = -std::atan2(dot(w, b), dot(w, a));
    outward_ = inward * -1;
    square_ = c * c;
    from_ = {c * std::cos(t0), c * std::sin(t0)};
    to_ = {c * std::cos(t0 + angle), c * std::sin(t0 + angle)};
    integral_ = k_ == 0 ? angle : to_.sine - from_.sine;
    from_.power = k_ == 0 ? from_.cosine : from_.cosine * from_.cosine;
    to_.power = k_ == 0 ? to_.cosine : to_.cosine * to_.cosine;
  }

  const Vec3& outward() const { return outward_; }  // ν, the same all along
  double integral() const { return integral_; }

  /// k Jₖ = [(c cos t)ᵏ⁻¹ c sin t] + (k − 1) c² Jₖ₋₂.
  void step() {
    k_ += 2;
    const double ends = to_.power * to_.sine - from_.power * from_.sine;
    integral_ = (ends + (k_ - 1) * square_ * integral_) / k_;
    from_.power *= from_.cosine * from_.cosine;
    to_.power *= to_.cosine * to_.cosine;
  }

 private:
  struct End {
    double cosine = 0, sine = 0;  // times c
    double power = 0;             // cosineᵏ⁺¹
  };

  Vec3 outward_;
  int k_;
  double square_ = 0, integral_ = 0;
  End from_, to_;
};

std::vector<Arc> arcs_of(const Polygon& p, const Vec3& w, int n) {
  std::vector<Arc> arcs;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3& next = p[(i + 1) % p.size()];
    if (length(cross(p[i], next)) > 0) arcs.emplace_back(p[i], next, w, n);
  }
  return arcs;
}

/// One point of the circle around a cone of light.
struct RimPoint {
  double along_v, along_w;  // ν on the two axes, times the arc's length and (w·u)ᵏ
  double w_dot_u;
};

}  // namespace

double polygon_solid_angle(const Polygon& polygon, const Vec3& point, const Vec3& normal) {
  return std::abs(signed_solid_angle(seen_from(polygon, point, normal)));
}

double polygon_irradiance(const Polygon& polygon, const Vec3& point, const Vec3& normal) {
  const Polygon p = seen_from(polygon, point, normal);
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3& next = p[(i + 1) % p.size()];
    const Vec3 c = cross(p[i], next);
    const double sine = length(c);
    if (sine > 0) sum += 0.5 * std::atan2(sine, dot(p[i], next)) * dot(normal, c) / sine;
  }
  return std::abs(sum);
}

double polygon_moment(const Polygon& polygon, const Vec3& point, const Vec3& normal,
                      const Vec3& axis, int exponent) {
  Polygon p = clip(seen_from(polygon, point, normal), axis);
  double solid_angle = signed_solid_angle(p);
  if (solid_angle < 0) {
    std::reverse(p.begin(), p.end());
    solid_angle = -solid_angle;
  }
  std::vector<Arc> arcs = arcs_of(p, axis, exponent);
  return double_axis_moment(exponent, dot(axis, normal), solid_angle, [&] {
    Boundary sum;
    for (Arc& arc : arcs) {
      sum.along_v += dot(normal, arc.outward()) * arc.integral();
      sum.along_w += dot(axis, arc.outward()) * arc.integral();
      arc.step();
    }
    return sum;
  });
}

double cone_moment(const Vec3& center, double half_angle, const Vec3& normal, const Vec3& axis,
                   int exponent) {
  const double sine = std::sin(half_angle), cosine = std::cos(half_angle);
  // The cone's lowest direction is at the angle between its axis and `a` plus θ.
  const auto above = [&](const Vec3& a) { return dot(center, a) >= sine; };
  if (!(half_angle > 0 && half_angle < pi / 2 && above(normal) && above(axis))) {
    throw std::invalid_argument("the cone of light is not wholly above the horizons of both axes");
  }
  const Vec3 helper = std::abs(center.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 e1 = normalize(cross(center, helper));
  const Vec3 e2 = cross(center, e1);
  // The integrand is a trigonometric polynomial of degree n + 1 in the azimuth: the midpoint rule
  // with more points than that is exact.
  const int points = exponent + 3;
  std::vector<RimPoint> rim;
  for (int i = 0; i < points; ++i) {
    const double phi = 2 * pi * i / points;
    const Vec3 side = e1 * std::cos(phi) + e2 * std::sin(phi);
    const Vec3 outward = (side * cosine - center * sine) * (sine * 2 * pi / points);
    const double g = dot(axis, center * cosine + side * sine);
    const double first = exponent % 2 == 0 ? 1 : g;
    rim.push_back({dot(normal, outward) * first, dot(axis, outward) * first, g});
  }
  const double solid_angle = 2 * pi * sine * sine / (1 + cosine);
  return double_axis_moment(exponent, dot(axis, normal), solid_angle, [&] {
    Boundary sum;
    for (RimPoint& point : rim) {
      sum.along_v += point.along_v;
      sum.along_w += point.along_w;
      point.along_v *= point.w_dot_u * point.w_dot_u;
      point.along_w *= point.w_dot_u * point.w_dot_u;
    }
    return sum;
  });
}

}  // namespace plumbline::analytic
