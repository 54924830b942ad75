#include "bsdf_conventions.h"
#include "bsdf_case.h"
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

void add_conventions_cases(std::vector<Case>& cases) {
  correct<ArrayStyle::Vec>(cases, "arrays, cosine in eval/float", ArrayStyle{}, array_options());
  correct<D3>(cases, "rays, wi first/double", RayStyle{}, ray_options());
  correct<D3>(cases, "y up/anisotropic/double", YUpStyle{}, y_up_options());
  correct<Indexed>(cases, "world space/double", WorldStyle{}, world_options());
  correct<V3<float>>(cases, "projected pdf/float", ProjectedStyle{}, projected_options());

  twin<ArrayStyle::Vec>(cases, "arrays, cosine in eval/float", "cosine twice",
                        "B28: eval has the cosine twice", {CauseKind::value_cosine},
                        with<ArrayStyle>(1), array_options());
  twin<D3>(cases, "y up/anisotropic/double", "wi of the other hand in pdf",
           "pdf brings wi to z up without the change of sign", {CauseKind::mirrored},
           with<YUpStyle>(1), y_up_options());
  twin<V3<float>>(cases, "projected pdf/float", "pdf not projected",
                  "pdf() is per solid angle where the record is per projected solid angle",
                  {CauseKind::cosine}, with<ProjectedStyle>(1), projected_options());
}

}  // namespace plumbline::tests::corpus
