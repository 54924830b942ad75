#include "bsdf_case.h"
#include "bsdf_diffuse.h"
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

void add_sealed_diffuse_cases(std::vector<Case>& cases) {
  twin<F3>(cases, "lambert/float", "square root missing",
           "the radius on the disk is u, not sqrt(u)", {CauseKind::radius}, Lambert<float>{0.7F, 1},
           seen_from({0, 60}));
  twin<D3>(cases, "lambert/double", "uniform pdf",
           "cosine-weighted samples, pdf of uniform ones, 1/(2 pi)", {CauseKind::cosine},
           Lambert<double>{0.7, 2}, seen_from({0, 60}));
  twin<D3>(cases, "lambert/double", "cosine in f",
           "B28: f holds the cosine that is applied once more outside", {CauseKind::value_cosine},
           Lambert<double>{0.7, 4}, seen_from({0, 60}));
  twin<F3>(cases, "lambert/float", "1/pi twice", "f is divided by pi twice",
           {CauseKind::value_constant}, Lambert<float>{0.7F, 5}, seen_from({0, 60}));
  twin<F3>(cases, "lambert/float", "weight divided by pi", "the weight of the record is albedo/pi",
           {CauseKind::value_constant, CauseKind::weight}, Lambert<float>{0.7F, 6},
           seen_from({0, 60}));
  twin<D3>(cases, "lambert/double", "record without 1/pi",
           "the record states the cosine, pdf() is right", {CauseKind::record_pdf},
           Lambert<double>{0.7, 7}, seen_from({0, 60}));
  twin<D3>(cases, "oren nayar/sigma 0.5/double", "cosine twice",
           "B28: eval multiplies by the cosine twice", {CauseKind::value_cosine},
           OrenNayar<double>{0.8, 0.5, 3}, oren_nayar_options());
  twin<D3>(cases, "oren nayar/sigma 0.5/double", "cosine missing",
           "eval lacks the cosine that its convention asks for", {CauseKind::value_cosine},
           OrenNayar<double>{0.8, 0.5, 4}, oren_nayar_options());
  twin<F3>(cases, "sheen/roughness 0.5/float", "polar angle uniform",
           "theta is uniform, the sine of the polar angle is missing from the map",
           {CauseKind::sine}, Sheen<float>{0.5F, 1}, sheen_options());
  twin<D3>(cases, "retroreflector/exponent 50/double", "around the mirror direction",
           "sample turns the lobe by half a turn about the normal", {CauseKind::mirrored},
           Retroreflector<double>{50, 0.9, 4}, seen_from({20, 60}));
  twin<D3>(cases, "regolith/generator/double", "one number for both",
           "the same random number serves for the radius and the angle",
           {CauseKind::numbers_reused, CauseKind::on_a_line}, Regolith{0.6, 1}, seen_from({0, 80}));
  twin<D3>(cases, "regolith/generator/double", "cosine clamped",
           "the cosine of a sample is clamped to 0.1", {CauseKind::on_a_line}, Regolith{0.6, 2},
           seen_from({0, 80}));
}

}  // namespace plumbline::tests::corpus
