#pragma once

#include <cmath>
#include <limits>

#include <plumbline/renderer/core/math.h>

/// MIS heuristics, and the weight of one of two techniques. That of one of many is built on them in
/// estimators/mis_weights.h.
namespace plumbline::renderer {

/// @source Veach 1997: balance Eq. 9.8; cutoff, power and maximum Section 9.2.3
enum class Heuristic { balance, power, cutoff, maximum };

/// A heuristic with its parameter. Converts from a heuristic, with the parameter that is usual for
/// it.
struct Weighting {
  constexpr Weighting(Heuristic h) : heuristic(h), parameter(h == Heuristic::cutoff ? 0.1 : 2) {}
  constexpr Weighting(Heuristic h, double p) : heuristic(h), parameter(p) {}

  Heuristic heuristic;
  /// β > 0 of `power` (may be infinite); α in [0, 1] of `cutoff`: techniques below α times the
  /// largest get no weight. The others have none.
  double parameter;
};

namespace mis_detail {

/// Relative difference below which two densities are held for equal: 5e-4 in float, 9e-13 in
/// double.
inline constexpr int kTieUlps = 4096;

/// What the heuristic makes of a relative density before the shares are taken.
template <class T>
T emphasise(const Weighting& weighting, const T& relative) {
  using std::pow;
  switch (weighting.heuristic) {
    case Heuristic::balance:
      return relative;
    case Heuristic::power:
      if (weighting.parameter == 1) return relative;
      if (weighting.parameter == 2) return sqr(relative);
      return relative > T(0) ? T(pow(relative, T(weighting.parameter))) : T(0);
    case Heuristic::cutoff:
      return relative >= T(weighting.parameter) ? relative : T(0);
    case Heuristic::maximum:
      // Equal maxima share, and what rounding may have made of equal ones: the weights at the two
      // ends of a ray come from different arithmetic, and must not both say that they lost.
      return relative >= T(1) - T(kTieUlps) * std::numeric_limits<T>::epsilon() ? T(1) : T(0);
  }
  return T(0);
}

}  // namespace mis_detail

/// MIS weight of the technique with density `pdf_a` beside one with `pdf_b`, both with their counts
/// or selection probabilities multiplied in.
///
/// @param pdf_a, pdf_b  same measure, ≥ 0, finite
/// @return              w_a in [0, 1]; 0 where pdf_a is 0
template <class T>
T mis_weight(const Weighting& weighting, const T& pdf_a, const T& pdf_b) {
  // Only ratios are formed: in float a square overflows above 1.8e19, and vanishes below 2e-23.
  const T largest = pdf_a > pdf_b ? pdf_a : pdf_b;
  const T a = mis_detail::emphasise(weighting, T(pdf_a / largest));
  const T b = mis_detail::emphasise(weighting, T(pdf_b / largest));
  return pdf_a > T(0) ? T(a / (a + b)) : T(0);
}

}  // namespace plumbline::renderer
