#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_phong.h"

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

void add_sealed_phong_cases(std::vector<Case>& cases) {
  twin<D3>(cases, "phong/exponent 30/double", "number not stretched",
           "L6: the number that chose the lobe is used as it is", {CauseKind::numbers_reused},
           phong(1), phong_options({0, 60}));
  twin<D3>(cases, "phong/exponent 8/double", "pdf normalised like f",
           "the lobe's pdf has n + 2 where n + 1 belongs", {CauseKind::lobe_probability},
           Phong<double>{0.4, 0.5, 8, 3}, phong_options({0, 60}));
  twin<D3>(cases, "phong/exponent 30/double", "pdf of even lobes",
           "pdf weighs both lobes a half, sample by their colours", {CauseKind::lobe_probability},
           Phong<double>{0.2, 0.7, 30, 4}, phong_options({0, 60}));
  twin<D3>(cases, "blinn/exponent 100/double", "pdf of h over 4",
           "B3: pdf of h over 4, without wo.h", {CauseKind::half_vector_jacobian}, blinn(2),
           seen_from({20, 60}));
  twin<D3>(cases, "blinn/exponent 100/double", "n.h for wo.h",
           "the Jacobian of the half vector has n.h in place of wo.h",
           {CauseKind::half_vector_jacobian}, blinn(3), seen_from({20, 60}));
  twin<D3>(cases, "ashikhmin shirley/10, 100/double", "exponents exchanged in pdf",
           "pdf has nu and nv exchanged", {CauseKind::mirrored}, brushed(2), seen_from({0, 50}));
  twin<D3>(cases, "ashikhmin shirley/10, 100/double", "sum of the lobes' pdfs",
           "pdf adds the lobes without the half that each is chosen with",
           {CauseKind::constant, CauseKind::lobe_probability}, brushed(3), seen_from({0, 50}));
  twin<D3>(cases, "ashikhmin shirley/10, 100/double", "maximum of one cosine",
           "f divides by the cosine of wi where the larger of both belongs",
           {CauseKind::asymmetric, CauseKind::energy}, brushed(5), seen_from({20, 50}));
}

}  // namespace plumbline::tests::corpus
