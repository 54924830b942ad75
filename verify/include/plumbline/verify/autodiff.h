#pragma once

// Needs the headers of Boost.Math (1.73 or later), which the library itself keeps to its sources:
// for tests of samplers that are templates over their scalar.

#include <boost/math/differentiation/autodiff.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>

#include <plumbline/verify/detail/domain.h>
#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/detail/report.h>
#include <plumbline/verify/detail/settings.h>
#include <plumbline/verify/detail/stopwatch.h>
#include <plumbline/verify/detail/vector_access.h>

namespace plumbline::verify {

/// What the autodiff Jacobian check is asked.
struct AutodiffOptions : CheckSettings {
  int points = 10'000;
  double tolerance = 1e-9;  ///< relative error of pdf·|∂x/∂u|, in double
  /// How close u comes to 0 and 1; half of all points are spread towards them.
  double nearest = 1e-12;
};

namespace detail {

namespace autodiff = boost::math::differentiation;

/// A point's coordinates with their derivatives along both uniform numbers.
template <class S>
struct Differential {
  std::array<S, 3> x{}, du{}, dv{};
};

template <class P>
auto coordinate(const P& p, std::size_t i) {
  if constexpr (requires { p.x; }) {
    if constexpr (requires { p.z; }) {
      return i == 0 ? p.x : i == 1 ? p.y : p.z;
    } else {
      return i == 0 ? p.x : p.y;
    }
  } else {
    return p[i];
  }
}

template <class P>
constexpr std::size_t coordinates() {
  if constexpr (
      requires(const P& p) { p.x; } && !requires(const P& p) { p.z; }) {
    return 2;
  } else {
    return 3;
  }
}

template <class S, class Sample>
std::optional<Differential<S>> differentiate(const Sample& sample, double u, double v) {
  using F = autodiff::autodiff_fvar<S, 1, 1>;
  const auto variables = autodiff::make_ftuple<S, 1, 1>(S(u), S(v));
  const auto point = sample(F(std::get<0>(variables)), F(std::get<1>(variables)));
  if (!point) return std::nullopt;
  Differential<S> d;
  for (std::size_t i = 0; i < coordinates<std::remove_cvref_t<decltype(*point)>>(); ++i) {
    const F c = coordinate(*point, i);
    d.x[i] = static_cast<S>(c);
    d.du[i] = c.derivative(1, 0);
    d.dv[i] = c.derivative(0, 1);
  }
  return d;
}

inline std::string in_words(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// |∂x/∂u × ∂x/∂v|: the area that a square of uniform numbers is spread over.
template <class S>
S area_element(const Differential<S>& d) {
  using std::sqrt;
  const auto& [a, b] = std::tie(d.du, d.dv);
  const S x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2],
          z = a[0] * b[1] - a[1] * b[0];
  if constexpr (std::is_same_v<S, double>) {
    return std::hypot(x, y, z);
  } else {
    return sqrt(x * x + y * y + z * z);
  }
}

/// One point of the check: how far pdf·|∂x/∂u| is from 1, and how far rounding may put it.
struct JacobianPoint {
  double error = 0, rounding = 0;
};

/// How much pdf·|∂x/∂u| changes when u moves by a few ulps, or its x does. The product is 1 all
/// around, or off by what is wrong with a formula, which a few ulps do not change: what scatters
/// between neighbours is rounding.
template <class Sample, class Pdf>
double scatter(const Domain& domain, const Sample& sample, const Pdf& pdf, double u, double v,
               const Differential<double>& here, double product) {
  double largest = 0;
  const double area = area_element(here);
  for (const double angle : {0.0, 1.6, 3.1, 4.7}) {
    const double beside = pdf(domain.chart().near(here.x, 0x1p-51, angle));
    largest = std::max(largest, std::abs(beside * area - product));
  }
  for (const double side : {-1.0, 1.0}) {
    for (const bool first : {true, false}) {
      const double step = 1 + side * 0x1p-50;
      const auto there = differentiate<double>(sample, first ? std::min(u * step, 1 - 0x1p-53) : u,
                                               first ? v : std::min(v * step, 1 - 0x1p-53));
      if (!there) continue;
      const double beside = pdf(there->x) * area_element(*there);
      if (beside > 0) largest = std::max(largest, std::abs(beside - product));
    }
  }
  return largest;
}

/// The same where a wider scalar decides: rounding is all of the error that it does not have.
template <class Wider, class Sample, class Pdf>
std::optional<JacobianPoint> jacobian_error_decided(const Sample& sample, const Pdf& pdf, double u,
                                                    double v, double tolerance) {
  const auto d = differentiate<double>(sample, u, v);
  if (!d) return std::nullopt;
  JacobianPoint point;
  point.error = std::abs(pdf(d->x) * area_element(*d) - 1);
  if (point.error <= tolerance) return point;
  const auto exact = differentiate<Wider>(sample, u, v);
  if (!exact) return point;
  const double error =
      std::abs(static_cast<double>(pdf(exact->x) * area_element(*exact) - Wider(1)));
  if (error <= tolerance) {
    point.rounding = point.error;
  } else {
    point.error = error;
  }
  return point;
}

/// Where rounding put the point outside the support, one a hair further inside stands for it.
template <class Sample, class Pdf>
std::optional<JacobianPoint> jacobian_error(const Domain& domain, const Sample& sample,
                                            const Pdf& pdf, double u, double v, double tolerance) {
  JacobianPoint point;
  for (const double inwards : {0.0, 0x1p-44, 0x1p-36}) {
    const double at_u = u + inwards * (0.5 - u), at_v = v + inwards * (0.5 - v);
    const auto d = differentiate<double>(sample, at_u, at_v);
    if (!d) return std::nullopt;
    const double density = pdf(d->x), product = density * area_element(*d);
    point.error = std::abs(product - 1);
    if (density == 0) continue;
    if (!(point.error <= tolerance)) {
      point.rounding = scatter(domain, sample, pdf, at_u, at_v, *d, product);
    }
    break;
  }
  return point;
}

inline double number_towards_ends(Random& random, double nearest) {
  if (random.uniform() < 0.5) return std::clamp(random.uniform(), nearest, 1 - nearest);
  const double small = std::pow(nearest, random.uniform());
  return std::clamp(random.uniform() < 0.5 ? small : 1 - small, nearest, 1 - nearest);
}

}  // namespace detail

/// pdf · |∂x/∂u| = 1 to machine precision, by automatic differentiation; and at the corners of the
/// unit square (u = 0, u = 1 − ulp) the point is finite and in the domain.
///
/// Where the product itself changes by more than the tolerance when its point is rounded (the
/// silhouette of a sphere, a fold), that change is allowed for, and the point counted in the
/// figures; more than a tenth of such points is inconclusive. With a wider scalar nothing is
/// estimated: the same formulas run in it at the same u, and what is wrong there is a wrong
/// formula.
///
/// @tparam Wider  a scalar of more digits than double, such as Boost's cpp_bin_float_quad without
///                expression templates; may be left out
/// @param sample  template over its scalar: (T u, T v) to an optional point, with x, y (, z) or
///                operator[]
/// @param pdf     of a point in double, as a Vec3; with a wider scalar also of three of those in a
///                std::array
template <class Wider = double, class Sample, class Pdf>
CheckResult check_jacobian_autodiff(const std::string& subject, const Domain& domain,
                                    const Sample& sample, const Pdf& pdf,
                                    const AutodiffOptions& options = {}) {
  const Stopwatch watch;
  CheckResult r;
  r.kind = CheckKind::jacobian_autodiff;
  r.subject = subject;
  r.reference = 0;
  r.tolerance = options.tolerance;
  r.seed = options.seed;
  constexpr bool decided = !std::is_same_v<Wider, double>;
  r.leaned_on = decided ? "automatic differentiation, in more digits where rounding decides"
                        : "automatic differentiation";
  r.verdict = Verdict::pass;
  const auto fail = [&r](const std::string& reason) {
    if (r.verdict != Verdict::fail) r.reason = reason;
    r.verdict = Verdict::fail;
  };
  Random random(options.seed);
  double worst = 0;
  std::uint64_t ill_conditioned = 0;
  for (int i = 0; i < options.points; ++i) {
    const double u = detail::number_towards_ends(random, options.nearest);
    const double v = detail::number_towards_ends(random, options.nearest);
    std::optional<detail::JacobianPoint> point;
    if constexpr (decided) {
      point = detail::jacobian_error_decided<Wider>(sample, pdf, u, v, options.tolerance);
    } else {
      point = detail::jacobian_error(domain, sample, pdf, u, v, options.tolerance);
    }
    if (!point) continue;
    ++r.samples;
    if (!(point->error <= options.tolerance + point->rounding)) {
      fail("pdf · |dx/du| is off by " + detail::in_words(point->error) + " at u = (" +
           detail::in_words(u) + ", " + detail::in_words(v) + ")");
    } else if (point->error > options.tolerance) {
      ++ill_conditioned;
      continue;
    }
    if (!(point->error <= worst)) worst = point->error;
  }
  for (const double u : {0.0, 0.5, 1 - 0x1p-53}) {
    for (const double v : {0.0, 0.5, 1 - 0x1p-53}) {
      const auto point = sample(u, v);
      if (!point) continue;
      Vec3 x{};
      for (std::size_t i = 0; i < detail::coordinates<std::remove_cvref_t<decltype(*point)>>();
           ++i) {
        x[i] = static_cast<double>(detail::coordinate(*point, i));
      }
      if (!(domain.chart().distance(x) <= 1e-12)) {
        fail("at a corner of the unit square the point is not in the domain");
      }
    }
  }
  r.estimate = r.bound = worst;
  r.figures = {{Figure::ill_conditioned, static_cast<double>(ill_conditioned)}};
  if (r.samples == 0) {
    r.verdict = Verdict::inconclusive;
    r.reason = "the map gave no point";
  } else if (r.verdict == Verdict::pass && 10 * ill_conditioned > r.samples) {
    r.verdict = Verdict::inconclusive;
    r.reason = "rounding of the point changes the density by more than the tolerance too often";
    r.advice = "raise the tolerance, or keep `nearest` farther from the ends of the square";
  }
  r.seconds = watch.seconds();
  return r;
}

}  // namespace plumbline::verify
