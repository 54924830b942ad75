#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_hair.h"

namespace plumbline::tests::corpus {

namespace {

using F3 = V3<float>;
using D3 = V3<double>;

/// Off the fibre's axis f is not symmetric: the lobes' widths and exits are those of wo.
[[maybe_unused]] BsdfOptions hair_options(std::vector<double> angles) {
  BsdfOptions options = from_both_faces(std::move(angles));
  options.reciprocal = false;
  options.conventions.weight = verify::BsdfConventions::Weight::f;
  return options;
}

template <class T>
Hair<T> hair(int fault = 0) {
  Hair<T> h;
  h.fault = fault;
  return h;
}

/// Narrow cones, wide about the fibre.
template <class T>
Hair<T> wet_hair() {
  Hair<T> h;
  h.longitudinal = T(0.06);
  h.azimuthal = T(0.2);
  h.offset = T(-0.7);
  return h;
}

}  // namespace

void add_sealed_hair_cases(std::vector<Case>& cases) {
  twin<D3>(cases, "hair/double", "one width in pdf",
           "pdf has the roughness for the variance, and the same for all lobes",
           {CauseKind::roughness}, hair<double>(4), hair_options({30}));
  twin<F3>(cases, "hair/float", "cosine of the cone",
           "pdf divides by the cosine of the longitudinal angle, as if per angle",
           {CauseKind::sine, CauseKind::cosine}, hair<float>(5), hair_options({30}));
  twin<D3>(cases, "hair/double", "azimuth negated in pdf", "pdf has the azimuth negated",
           {CauseKind::mirrored}, hair<double>(6), hair_options({30}));
}

}  // namespace plumbline::tests::corpus
