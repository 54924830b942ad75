#include "bsdf_phong.h"
#include "bsdf_case.h"
#include "bsdf_families.h"

namespace plumbline::tests::corpus {

namespace {

using F3 = V3<float>;
using D3 = V3<double>;

[[maybe_unused]] BsdfOptions phong_options(std::vector<double> angles) {
  BsdfOptions options = seen_from(std::move(angles));
  options.conventions.zero_pdf_is_failure = true;
  return options;
}

[[maybe_unused]] Phong<double> phong(int fault) { return {0.4, 0.5, 30, fault}; }
[[maybe_unused]] Blinn<double> blinn(int fault) { return {100, 0.9, fault}; }
[[maybe_unused]] AshikhminShirley<double> brushed(int fault) { return {10, 100, 0.5, 0.2, fault}; }

}  // namespace

void add_phong_cases(std::vector<Case>& cases) {
  correct<D3>(cases, "phong/exponent 30/double", phong(0), phong_options({0, 60, 85}));
  correct<F3>(cases, "phong/exponent 150/float", Phong<float>{0.2F, 0.7F, 150},
              phong_options({20, 70}));
  correct<F3>(cases, "blinn/exponent 20/float", Blinn<float>{20}, seen_from({0, 45}));
  correct<D3>(cases, "blinn/exponent 100/double", blinn(0), seen_from({0, 60, 80}));
  correct<D3>(cases, "blinn/exponent 10000/double", Blinn<double>{10000}, seen_from({30, 70}));
  correct<D3>(cases, "ashikhmin shirley/10, 100/double", brushed(0), seen_from({0, 50, 80}));
  correct<F3>(cases, "ashikhmin shirley/1000, 5/float", AshikhminShirley<float>{1000, 5},
              seen_from({30, 60}));

  twin<D3>(cases, "phong/exponent 30/double", "record of the chosen lobe",
           "B7: the record states the chosen lobe's pdf, the weight divides by it",
           {CauseKind::chosen_lobe_only}, phong(2), phong_options({0, 60}));
  twin<D3>(cases, "phong/exponent 30/double", "lobe without its probability",
           "pdf has the glossy lobe without the probability of its choice",
           {CauseKind::lobe_probability}, phong(5), phong_options({0, 60}));
  twin<D3>(cases, "phong/exponent 30/double", "diffuse without 1/pi",
           "f has kd where kd/pi belongs", {CauseKind::energy, CauseKind::value_constant}, phong(6),
           phong_options({0, 60}));
  twin<D3>(cases, "blinn/exponent 100/double", "pdf of the half vector",
           "B3: pdf is that of h, without 1/(4 wo.h)", {CauseKind::half_vector_jacobian}, blinn(1),
           seen_from({0, 60}));
  twin<D3>(cases, "blinn/exponent 10/double", "drawn again",
           "a sample below the horizon is drawn again nearer to the normal, pdf does not know",
           {CauseKind::not_rejected}, Blinn<double>{10, 0.9, 4}, seen_from({60, 80}));
  twin<D3>(cases, "ashikhmin shirley/10, 100/double", "quadrant not stretched",
           "L6: in the first quadrant the number is used without being stretched by 4",
           {CauseKind::numbers_reused}, brushed(1), seen_from({0, 50}));
  twin<D3>(cases, "ashikhmin shirley/10, 100/rs 0.6/double", "diffuse under the coat not dimmed",
           "1 - Rs is forgotten in the diffuse part", {CauseKind::energy, CauseKind::fresnel},
           AshikhminShirley<double>{10, 100, 0.95, 0.6, 4}, seen_from({0, 50}));
}

}  // namespace plumbline::tests::corpus
