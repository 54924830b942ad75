#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include <plumbline/renderer/core/math.h>

/// MIS weights for any number of techniques: one implementation for the renderer's light and BSDF
/// samples and for the estimators of estimators.h.
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

/// How densely one technique samples a point.
template <class T>
struct TechniqueDensity {
  T pdf{};     ///< ≥ 0, finite, in the measure that all techniques share; the mass of an atom
  T count{1};  ///< samples n_i, or selection probability c_i; > 0
  bool atom{false};  ///< the technique has probability mass at this very point
};

/// As many techniques as the numerics are proven for.
inline constexpr std::size_t kMaxTechniques = 8;

namespace mis_detail {

/// count·pdf of every technique that takes part, relative to the largest: in [0, 1], the largest
/// exactly 1, all 0 if none takes part.
///
/// Only ratios are formed. In float the products overflow above 3.4e38/count, their squares above
/// 1.8e19, and squares vanish below 2e-23: none of these numbers ever exists here. A density next
/// to an atom takes no part: it is infinitely smaller.
template <class T>
std::array<T, kMaxTechniques> relative_densities(std::span<const TechniqueDensity<T>> techniques) {
  bool any_atom = false;
  for (const auto& t : techniques) any_atom = any_atom || (t.atom && t.pdf > T(0));
  T largest_pdf(0), largest_count(0);
  for (const auto& t : techniques) {
    if (t.atom != any_atom) continue;
    if (t.pdf > largest_pdf) largest_pdf = t.pdf;
    if (t.count > largest_count) largest_count = t.count;
  }
  std::array<T, kMaxTechniques> relative{};
  if (!(largest_pdf > T(0))) return relative;
  T largest(0);
  for (std::size_t k = 0; k < techniques.size(); ++k) {
    const auto& t = techniques[k];
    if (t.atom != any_atom) continue;
    relative[k] = (t.pdf / largest_pdf) * (t.count / largest_count);
    if (relative[k] > largest) largest = relative[k];
  }
  for (std::size_t k = 0; k < techniques.size(); ++k) relative[k] = relative[k] / largest;
  return relative;
}

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

/// MIS weight of technique `i` at a point that all of them are asked about.
///
/// With q_k = count·pdf: balance q_i/Σq; power q_i^β/Σq^β; cutoff q_i/Σ{q ≥ α q_max}, 0 below;
/// maximum 1 for the largest, shared by
/// those that differ from it by rounding only. Where atoms meet the point, they alone share the
/// weight, by their masses.
///
/// @param techniques  up to kMaxTechniques
/// @return            in [0, 1]; 0 where the density is 0; sums to 1 over `i` within M ulp wherever
/// any
///                    density is positive, for densities anywhere in the range of T
template <class T>
T mis_weight(const Weighting& weighting, std::span<const TechniqueDensity<T>> techniques,
             std::size_t i) {
  const auto relative = mis_detail::relative_densities(techniques);
  T sum(0), own(0);
  for (std::size_t k = 0; k < techniques.size(); ++k) {
    const T share = mis_detail::emphasise(weighting, relative[k]);
    sum = sum + share;
    if (k == i) own = share;
  }
  return own > T(0) ? T(own / sum) : T(0);
}

/// MIS weight of the technique with density `pdf_a` beside one with `pdf_b`, both with their counts
/// or selection probabilities multiplied in.
///
/// @param pdf_a, pdf_b  same measure, ≥ 0, finite
/// @return              w_a in [0, 1]; 0 where pdf_a is 0
template <class T>
T mis_weight(const Weighting& weighting, const T& pdf_a, const T& pdf_b) {
  // The general form for two, without its loops and branches: a renderer asks at every vertex.
  const T largest = pdf_a > pdf_b ? pdf_a : pdf_b;
  const T a = mis_detail::emphasise(weighting, T(pdf_a / largest));
  const T b = mis_detail::emphasise(weighting, T(pdf_b / largest));
  return pdf_a > T(0) ? T(a / (a + b)) : T(0);
}

}  // namespace plumbline::renderer
