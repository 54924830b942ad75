#pragma once

#include <plumbline/renderer/math.h>

namespace plumbline::renderer {

enum class Heuristic { balance, power };

/// Balance heuristic for two techniques: w_a = p_a/(p_a + p_b).
///
/// Written with the ratio of the smaller to the larger density, so that neither the sum overflows
/// nor a tiny density is lost. Densities include sample counts or selection probabilities.
///
/// @param pdf_a, pdf_b  same measure, ≥ 0, finite
/// @return              w_a in [0, 1]; 0 where pdf_a is 0
/// @source              Veach 1997, Eq. 9.8
template <class T>
T balance_heuristic(const T& pdf_a, const T& pdf_b) {
  if (!(pdf_a > T(0))) return T(0);
  if (pdf_b > pdf_a) {
    const T ratio = pdf_a / pdf_b;
    return ratio / (T(1) + ratio);
  }
  return T(1) / (T(1) + pdf_b / pdf_a);
}

/// Power heuristic with β = 2 for two techniques: w_a = p_a²/(p_a² + p_b²).
///
/// The ratio is squared, not the densities: in float their squares overflow above 1.8e19 and vanish
/// below 2e-23.
///
/// @param pdf_a, pdf_b  same measure, ≥ 0, finite
/// @return              w_a in [0, 1]; 0 where pdf_a is 0
/// @source              Veach 1997, Eq. 9.9
template <class T>
T power_heuristic(const T& pdf_a, const T& pdf_b) {
  if (!(pdf_a > T(0))) return T(0);
  if (pdf_b > pdf_a) {
    const T ratio = sqr(T(pdf_a / pdf_b));
    return ratio / (T(1) + ratio);
  }
  return T(1) / (T(1) + sqr(T(pdf_b / pdf_a)));
}

/// MIS weight of the technique with density `pdf_a` beside one with `pdf_b`.
template <class T>
T mis_weight(Heuristic heuristic, const T& pdf_a, const T& pdf_b) {
  return heuristic == Heuristic::balance ? balance_heuristic(pdf_a, pdf_b)
                                         : power_heuristic(pdf_a, pdf_b);
}

}  // namespace plumbline::renderer
