#include "bsdf_hair.h"
#include "bsdf_case.h"
#include "bsdf_families.h"

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

void add_hair_cases(std::vector<Case>& cases) {
  correct<D3>(cases, "hair/double", hair<double>(), hair_options({30}));
  correct<F3>(cases, "hair/float", hair<float>(), hair_options({70}));
  correct<D3>(cases, "hair/wet/double", wet_hair<double>(), hair_options({50}));

  twin<D3>(cases, "hair/double", "azimuthal lobe not normalised",
           "pdf has the logistic without what is cut off at half a turn",
           {CauseKind::lobe_probability, CauseKind::constant}, hair<double>(1), hair_options({30}));
  twin<D3>(cases, "hair/double", "azimuth aside", "sample is 0.3 rad off the exit azimuth",
           {CauseKind::shifted}, hair<double>(2), hair_options({30}));
  twin<D3>(cases, "hair/double", "number not stretched",
           "L6: the azimuth is drawn with the number that chose the lobe",
           {CauseKind::numbers_reused}, hair<double>(3), hair_options({30}));
  twin<D3>(cases, "hair/double", "even lobes in pdf",
           "pdf weighs the four lobes alike, sample by their strength",
           {CauseKind::lobe_probability}, hair<double>(7), hair_options({30}));
  twin<D3>(cases, "hair/double", "residual missing in pdf", "pdf lacks the last lobe",
           {CauseKind::lobe_probability}, hair<double>(8), hair_options({30}));
}

}  // namespace plumbline::tests::corpus
