#include "bsdf_case.h"
#include "bsdf_conventions.h"
#include "bsdf_families.h"

namespace plumbline::tests::corpus {

namespace {

using D3 = V3<double>;
using Conventions = verify::BsdfConventions;

[[maybe_unused]] BsdfOptions array_options() {
  BsdfOptions options = seen_from({0, 60});
  options.conventions.cosine_in_eval = true;
  return options;
}

[[maybe_unused]] BsdfOptions ray_options() {
  BsdfOptions options = seen_from({10, 70});
  options.conventions.given_points_in = true;
  options.conventions.sampled_direction_first = true;
  options.conventions.weight = Conventions::Weight::f;
  return options;
}

[[maybe_unused]] BsdfOptions y_up_options() {
  BsdfOptions options = seen_from({30, 60});
  options.conventions.frame = Conventions::Frame::local_y_up;
  options.conventions.weight = Conventions::Weight::f_cosine;
  return options;
}

[[maybe_unused]] BsdfOptions world_options() {
  BsdfOptions options = seen_from({0, 60});
  options.conventions.frame = Conventions::Frame::world;
  options.conventions.normal = {0.48, 0.6, 0.64};
  return options;
}

[[maybe_unused]] BsdfOptions projected_options() {
  BsdfOptions options = seen_from({0, 60});
  options.conventions.projected_pdf = true;
  options.conventions.zero_pdf_is_failure = true;
  return options;
}

template <class Style>
Style with(int fault) {
  Style style;
  style.fault = fault;
  return style;
}

}  // namespace

void add_sealed_conventions_cases(std::vector<Case>& cases) {
  twin<ArrayStyle::Vec>(cases, "arrays, cosine in eval/float", "weight without the cosine",
                        "the weight of the record is divided by the cosine",
                        {CauseKind::weight, CauseKind::value_cosine}, with<ArrayStyle>(2),
                        array_options());
  twin<D3>(cases, "rays, wi first/double", "ray not turned in pdf",
           "pdf turns only the height of the ray, not the whole direction", {CauseKind::mirrored},
           with<RayStyle>(1), ray_options());
  twin<Indexed>(cases, "world space/double", "frame transposed in sample",
                "sample brings wi to world space by the inverse of the frame",
                {CauseKind::tangent_frame, CauseKind::mirrored, CauseKind::support},
                with<WorldStyle>(1), world_options());
  twin<V3<float>>(cases, "projected pdf/float", "cosine of the other direction",
                  "pdf() is projected by the cosine of wo",
                  {CauseKind::cosine, CauseKind::directions_swapped}, with<ProjectedStyle>(2),
                  projected_options());
}

}  // namespace plumbline::tests::corpus
