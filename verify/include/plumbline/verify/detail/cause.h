#pragma once

#include <string_view>

namespace plumbline::verify {

/// What is likely wrong with code under test, as far as a diagnosis can name it. `none`: no
/// hypothesis explains all that was seen, so nothing is named.
enum class CauseKind {
  none,

  // A factor of a density.
  constant,                 ///< the same number everywhere: 2, π, 1/(4π), an area
  constant_per_hemisphere,  ///< a number above the horizon, another below
  lobe_probability,         ///< probability of a lobe missing from, or wrong in, the mixture's pdf
  choice_probability,       ///< probability of choosing a light (row, technique) missing or wrong
  cosine,                   ///< cosθ missing or too many in a pdf
  sine,                     ///< sinθ missing or too many: of a latitude map, a polar warp
  radius,                   ///< r, or a square root of a random number: disk, triangle, cone
  half_vector_jacobian,     ///< 1/(4 wo·h), or the wo·h in it
  refraction_jacobian,      ///< dω_h/dω_i of a refraction, η in it upside down
  masking,                  ///< G1 of the visible normals missing or of other roughness
  roughness,                ///< α against α², clamped or different in one function
  fresnel,                  ///< F or 1 − F missing, or another F in one function
  eta_squared,              ///< η² of radiance missing, twice, upside down
  distance_or_area,         ///< r², cosθ at the light, area for 1/area: area against solid angle

  // A density of something else.
  directions_swapped,  ///< wo and wi exchanged
  mirrored,            ///< sign of x and y, hemisphere, negated, x and y exchanged
  chosen_lobe_only,    ///< pdf or weight of the chosen lobe in place of the mixture's
  shifted,             ///< by half a cell, a row, an index
  tangent_frame,       ///< sampled in a frame that is not the one that the pdf is for
  not_rejected,        ///< samples below the horizon kept, or retried without it being in the pdf
  numbers_reused,      ///< a random number used again without being stretched
  support,             ///< the pdf is 0 where samples fall, for none of the reasons above
  on_a_line,           ///< samples on a line or point: a clamp, or an atom not said to be one
  atom_as_density,     ///< an atom with a made-up density, or its mass wrong

  // Not the density.
  record_pdf,      ///< the pdf stated in the record is wrong, `pdf()` is right
  value_cosine,    ///< cosθ applied twice in f, or missing
  value_constant,  ///< f, or the weight, off by a constant: 1/π twice
  weight,          ///< the weight is wrong, f and the densities are right
  asymmetric,      ///< f(wo, wi) ≠ f(wi, wo) for a reason not named above
  energy,          ///< f gives off more than arrives
  not_finite,      ///< NaN, infinity, a negative density
  precision,       ///< rounding: a lobe narrower than the arithmetic resolves, a cancellation
  stale_state,     ///< the answer depends on what was asked before
};

/// "half-vector Jacobian": the kind as a table's heading shows it.
std::string_view to_string(CauseKind kind);

}  // namespace plumbline::verify
