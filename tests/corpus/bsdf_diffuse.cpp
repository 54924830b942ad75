#include "bsdf_diffuse.h"
#include "bsdf_case.h"
#include "bsdf_families.h"

namespace plumbline::tests::corpus {

namespace {

using F3 = V3<float>;
using D3 = V3<double>;

[[maybe_unused]] BsdfOptions oren_nayar_options() {
  BsdfOptions options = seen_from({0, 60, 85});
  options.conventions.cosine_in_eval = true;
  options.conventions.sampled_direction_first = true;
  options.conventions.weight = verify::BsdfConventions::Weight::f_cosine;
  return options;
}

[[maybe_unused]] BsdfOptions sheen_options() {
  BsdfOptions options = seen_from({10, 70});
  options.conserves_energy = false;  // the model does not at grazing angles
  return options;
}

}  // namespace

void add_diffuse_cases(std::vector<Case>& cases) {
  correct<F3>(cases, "lambert/float", Lambert<float>{}, seen_from({0, 60, 89.9}));
  correct<D3>(cases, "lambert/double", Lambert<double>{}, seen_from({0, 75}));
  correct<D3>(cases, "leaf/double", DiffuseTransmitter<double>{}, from_both_faces({30, 85}));
  correct<F3>(cases, "leaf/float", DiffuseTransmitter<float>{}, from_both_faces({0, 60}));
  correct<D3>(cases, "oren nayar/sigma 0.5/double", OrenNayar<double>{}, oren_nayar_options());
  correct<F3>(cases, "oren nayar/sigma 1/float", OrenNayar<float>{0.5F, 1.0F},
              oren_nayar_options());
  correct<F3>(cases, "sheen/roughness 0.5/float", Sheen<float>{}, sheen_options());
  correct<D3>(cases, "sheen/roughness 0.2/double", Sheen<double>{0.2}, sheen_options());
  correct<D3>(cases, "retroreflector/exponent 50/double", Retroreflector<double>{},
              seen_from({0, 60, 88}));
  correct<F3>(cases, "retroreflector/exponent 200/float", Retroreflector<float>{200},
              seen_from({40, 80}));
  correct<D3>(cases, "regolith/generator/double", Regolith{}, seen_from({0, 80}));

  twin<D3>(cases, "lambert/double", "pdf without 1/pi",
           "pdf is the cosine, without 1/pi, weight and record alike", {CauseKind::constant},
           Lambert<double>{0.7, 3}, seen_from({0, 60}));
  twin<D3>(cases, "leaf/double", "number not stretched",
           "L6: the number that chose the side is used as it is", {CauseKind::numbers_reused},
           DiffuseTransmitter<double>{.fault = 1}, from_both_faces({30, 70}));
  twin<D3>(cases, "leaf/double", "pdf without the choice",
           "pdf is |cos|/pi on both sides, without the probability of the side",
           {CauseKind::constant_per_hemisphere, CauseKind::lobe_probability},
           DiffuseTransmitter<double>{.fault = 2}, from_both_faces({30, 70}));
  twin<F3>(cases, "leaf/float", "pdf of even sides",
           "pdf has a half for either side, whatever the colours",
           {CauseKind::constant_per_hemisphere, CauseKind::lobe_probability},
           DiffuseTransmitter<float>{.fault = 3}, from_both_faces({30, 70}));
  twin<D3>(cases, "leaf/double", "sides exchanged in pdf",
           "pdf has the probability of transmission where it reflects and the other way round",
           {CauseKind::constant_per_hemisphere, CauseKind::lobe_probability},
           DiffuseTransmitter<double>{.fault = 4}, from_both_faces({30, 70}));
  twin<D3>(cases, "oren nayar/sigma 0.5/double", "angles not sorted",
           "alpha and beta are always the angles of wo and wi", {CauseKind::asymmetric},
           OrenNayar<double>{0.8, 0.5, 1}, oren_nayar_options());
  twin<D3>(cases, "oren nayar/sigma 0.5/double", "angles sorted the wrong way",
           "alpha is the smaller and beta the larger angle", {CauseKind::energy},
           OrenNayar<double>{0.8, 0.5, 2}, oren_nayar_options());
  twin<D3>(cases, "sheen/roughness 0.2/double", "cosine-weighted samples",
           "samples by the cosine, pdf of uniform ones", {CauseKind::cosine}, Sheen<double>{0.2, 2},
           sheen_options());
  twin<D3>(cases, "sheen/roughness 0.2/double", "pdf of the whole sphere",
           "pdf is 1/(4 pi) where samples fill the hemisphere", {CauseKind::constant},
           Sheen<double>{0.2, 3}, sheen_options());
  twin<D3>(cases, "retroreflector/exponent 50/double", "below the horizon kept",
           "samples below the horizon come back with the lobe's pdf, where pdf() is 0",
           {CauseKind::not_rejected}, Retroreflector<double>{50, 0.9, 1}, seen_from({60, 85}));
  twin<D3>(cases, "retroreflector/exponent 50/double", "folded up",
           "samples below the horizon are mirrored at it, pdf does not know",
           {CauseKind::not_rejected, CauseKind::mirrored}, Retroreflector<double>{50, 0.9, 2},
           seen_from({75, 85}));
  twin<D3>(cases, "retroreflector/exponent 10/double", "exponent of sample n + 2",
           "sample uses the exponent with one added once more", {CauseKind::roughness},
           Retroreflector<double>{10, 0.9, 3}, seen_from({20, 60}));
  twin<D3>(cases, "regolith/generator/double", "cosine of wo twice",
           "f has the cosine of wo where that of wi belongs",
           {CauseKind::asymmetric, CauseKind::value_cosine}, Regolith{0.6, 3}, seen_from({20, 60}));
}

}  // namespace plumbline::tests::corpus
