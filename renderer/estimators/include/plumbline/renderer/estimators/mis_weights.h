#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <plumbline/renderer/core/mis/heuristics.h>

/// MIS weights for any number of techniques, by the heuristics that the renderer weighs its two
/// with.
namespace plumbline::renderer {

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

}  // namespace mis_detail

/// MIS weight of technique `i` at a point that all of them are asked about.
///
/// With q_k = count·pdf: balance q_i/Σq; power q_i^β/Σq^β; cutoff q_i/Σ{q ≥ α q_max}, 0 below;
/// maximum 1 for the largest, shared by those that differ from it by rounding only. Where atoms
/// meet the point, they alone share the weight, by their masses.
///
/// @param techniques  up to kMaxTechniques
/// @return            in [0, 1]; 0 where the density is 0; sums to 1 over `i` within M ulp wherever
///                    any density is positive, for densities anywhere in the range of T
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

}  // namespace plumbline::renderer
