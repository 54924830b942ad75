#include <plumbline/verify/detail/cause.h>

namespace plumbline::verify {

std::string_view to_string(CauseKind kind) {
  switch (kind) {
    case CauseKind::none:
      return "none";
    case CauseKind::constant:
      return "constant factor";
    case CauseKind::constant_per_hemisphere:
      return "constant per hemisphere";
    case CauseKind::lobe_probability:
      return "lobe probability";
    case CauseKind::choice_probability:
      return "choice probability";
    case CauseKind::cosine:
      return "cosθ in the pdf";
    case CauseKind::sine:
      return "sinθ in the pdf";
    case CauseKind::radius:
      return "r or √u";
    case CauseKind::half_vector_jacobian:
      return "half-vector Jacobian";
    case CauseKind::refraction_jacobian:
      return "refraction Jacobian";
    case CauseKind::masking:
      return "masking G1";
    case CauseKind::roughness:
      return "roughness";
    case CauseKind::fresnel:
      return "Fresnel term";
    case CauseKind::eta_squared:
      return "η²";
    case CauseKind::distance_or_area:
      return "distance or area";
    case CauseKind::directions_swapped:
      return "wo and wi swapped";
    case CauseKind::mirrored:
      return "mirrored";
    case CauseKind::chosen_lobe_only:
      return "chosen lobe only";
    case CauseKind::shifted:
      return "shifted";
    case CauseKind::tangent_frame:
      return "tangent frame";
    case CauseKind::not_rejected:
      return "not rejected";
    case CauseKind::numbers_reused:
      return "numbers reused";
    case CauseKind::support:
      return "support";
    case CauseKind::on_a_line:
      return "on a line";
    case CauseKind::atom_as_density:
      return "atom as density";
    case CauseKind::record_pdf:
      return "pdf of the record";
    case CauseKind::value_cosine:
      return "cosθ in f";
    case CauseKind::value_constant:
      return "constant in f";
    case CauseKind::weight:
      return "weight";
    case CauseKind::asymmetric:
      return "not reciprocal";
    case CauseKind::energy:
      return "energy";
    case CauseKind::not_finite:
      return "not finite";
    case CauseKind::precision:
      return "precision";
    case CauseKind::stale_state:
      return "stale state";
  }
  return "?";
}

}  // namespace plumbline::verify
