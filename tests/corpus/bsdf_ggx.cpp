#include "bsdf_ggx.h"
#include "bsdf_case.h"
#include "bsdf_families.h"

namespace plumbline::tests::corpus {

namespace {

using F3 = V3<float>;
using D3 = V3<double>;

template <class T>
Conductor<T> metal(T ax, T ay, Normals normals, int fault = 0, bool two_sided = false) {
  return {{ax, ay}, normals, two_sided, T(0.9), fault};
}

template <class T>
Conductor<T> textbook(T alpha) {
  return {{alpha, alpha, true}, Normals::disk, false, T(0.9), 0};
}

/// Albedo by the midpoint rule in cos² and azimuth: an oracle that shares no sampling with the
/// subject.
[[maybe_unused]] double albedo_of(const Beckmann<double>& metal, const verify::Vec3& wo) {
  constexpr int kRows = 400, kColumns = 400;
  double sum = 0;
  for (int i = 0; i < kRows; ++i) {
    const double z = std::sqrt((i + 0.5) / kRows);
    for (int j = 0; j < kColumns; ++j) {
      sum +=
          metal.eval({wo[0], wo[1], wo[2]}, spherical(z, 2 * pi_v<double> * (j + 0.5) / kColumns));
    }
  }
  return sum * pi_v<double> / (kRows * kColumns);
}

[[maybe_unused]] BsdfOptions known_beckmann(double alpha) {
  BsdfOptions options = seen_from({30, 75});
  const Beckmann<double> right{alpha};
  options.albedo = [right](const verify::Vec3& wo) { return albedo_of(right, wo); };
  return options;
}

}  // namespace

void add_ggx_cases(std::vector<Case>& cases) {
  correct<F3>(cases, "ggx/alpha 0.2/caps/float", metal(0.2F, 0.2F, Normals::caps),
              seen_from({0, 60, 85}));
  correct<D3>(cases, "ggx/alpha 0.5/disk/double", metal(0.5, 0.5, Normals::disk),
              seen_from({0, 50, 89.9}));
  correct<D3>(cases, "ggx/alpha 0.001/caps/double", metal(0.001, 0.001, Normals::caps),
              seen_from({0, 60}));
  correct<F3>(cases, "ggx/alpha 0.01/disk/float", metal(0.01F, 0.01F, Normals::disk),
              seen_from({10, 70}));
  correct<D3>(cases, "ggx/alpha 0.3/all normals/double", metal(0.3, 0.3, Normals::all),
              seen_from({0, 60}));
  correct<D3>(cases, "ggx/alpha 0.1, 0.4/caps/double", metal(0.1, 0.4, Normals::caps),
              seen_from({0, 60, 80}));
  correct<F3>(cases, "ggx/alpha 0.6, 0.15/all normals/float", metal(0.6F, 0.15F, Normals::all),
              seen_from({0, 60}));
  correct<D3>(cases, "ggx/alpha 0.2/two-sided/double", metal(0.2, 0.2, Normals::disk, 0, true),
              from_both_faces({30, 75}));
  correct<D3>(cases, "ggx/alpha 0.01/textbook D/double", textbook(0.01), seen_from({0, 60}));
  correct<D3>(cases, "ggx/alpha 0.001/textbook D/double", textbook(0.001), seen_from({45}));
  correct<F3>(cases, "ggx/alpha 0.1/textbook D/float", textbook(0.1F), seen_from({0, 60}));
  correct<F3, Pcg32>(cases, "beckmann/alpha 0.3/generator/float", Beckmann<float>{},
                     seen_from({0, 60}));
  correct<D3, Pcg32>(cases, "beckmann/alpha 0.05/generator/double", Beckmann<double>{0.05},
                     seen_from({20, 80}));
  correct<D3, Pcg32>(cases, "beckmann/alpha 0.5/albedo known/double", Beckmann<double>{0.5},
                     known_beckmann(0.5));

  twin<D3>(cases, "ggx/alpha 0.1, 0.4/caps/double", "x and y exchanged in sample",
           "sample has alpha x and alpha y exchanged", {CauseKind::mirrored},
           metal(0.1, 0.4, Normals::caps, 3), seen_from({0, 60}));
  twin<D3>(cases, "ggx/alpha 0.2/two-sided/double", "back face negates the whole of wo",
           "B21: sample turns -wo to the front in place of wo mirrored at the surface",
           {CauseKind::mirrored}, metal(0.2, 0.2, Normals::disk, 4, true),
           from_both_faces({30, 60}));
  twin<D3>(cases, "ggx/alpha 0.6/caps/double", "folded up",
           "reflections below the horizon are mirrored at it",
           {CauseKind::not_rejected, CauseKind::mirrored}, metal(0.6, 0.6, Normals::caps, 5),
           seen_from({60, 80}));
  twin<D3>(
      cases, "ggx/alpha 0.6/disk/double", "below the horizon kept",
      "reflections below the horizon come back with the density of their half vector and no weight",
      {CauseKind::not_rejected}, metal(0.6, 0.6, Normals::disk, 6), seen_from({60, 80}));
  twin<F3>(cases, "ggx/alpha 0.4/caps/float", "weight with G1",
           "the weight is F G1(wo), not F G2/G1(wo)", {CauseKind::weight, CauseKind::masking},
           metal(0.4F, 0.4F, Normals::caps, 7), seen_from({30, 75}));
  twin<D3>(cases, "ggx/alpha 0.4/all normals/double", "pdf without cos h",
           "pdf is D/(4 wo.h), the cosine of h is missing", {CauseKind::cosine},
           metal(0.4, 0.4, Normals::all, 9), seen_from({0, 60}));
  twin<D3>(cases, "ggx/alpha 0.2/caps/double", "pdf half", "pdf has a factor of 1/2 too many",
           {CauseKind::constant}, metal(0.2, 0.2, Normals::caps, 12), seen_from({0, 60}));
  twin<D3>(cases, "ggx/alpha 0.2/disk/double", "tangents negated in pdf",
           "pdf takes wo with x and y negated", {CauseKind::mirrored},
           metal(0.2, 0.2, Normals::disk, 14), seen_from({20, 60}));
  twin<D3>(cases, "ggx/alpha 0.4/disk/double", "G1 for G2 in f",
           "f has G1(wo) only, the masking of wi is missing",
           {CauseKind::masking, CauseKind::asymmetric}, metal(0.4, 0.4, Normals::disk, 16),
           seen_from({30, 75}));
  twin<D3>(cases, "ggx/alpha 0.4/caps/double", "f without G", "f has neither masking nor shadowing",
           {CauseKind::masking, CauseKind::energy}, metal(0.4, 0.4, Normals::caps, 17),
           seen_from({30, 75}));
  twin<D3>(cases, "ggx/alpha 0.3/caps/double", "cosine in f",
           "B28: f holds the cosine of wi once more", {CauseKind::value_cosine},
           metal(0.3, 0.3, Normals::caps, 19), seen_from({0, 60}));
  twin<D3>(cases, "ggx/alpha 0.5/disk/double", "frame from any tangent",
           "the frame of the visible normals is not the one with a horizontal tangent",
           {CauseKind::tangent_frame}, metal(0.5, 0.5, Normals::disk, 30), seen_from({30, 70}));
  twin<F3>(cases, "ggx/alpha 0.2/disk/float", "no frame at the pole",
           "the tangent is 0/0 at normal incidence", {CauseKind::not_finite},
           metal(0.2F, 0.2F, Normals::disk, 31), seen_from({0, 60}));
  twin<F3>(cases, "ggx/alpha 0.0005/textbook D/float", "cancelling D",
           "D with (a2 - 1)cos2 + 1 in float, at a roughness that it cannot resolve",
           {CauseKind::precision, CauseKind::not_finite}, textbook(0.0005F), seen_from({0, 45}));
  twin<D3, Pcg32>(cases, "beckmann/alpha 0.6/generator/double", "drawn again",
                  "samples below the horizon are drawn again, pdf does not know",
                  {CauseKind::not_rejected}, Beckmann<double>{0.6, 0.8, 2}, seen_from({60, 80}));
  twin<D3, Pcg32>(cases, "beckmann/alpha 0.5/generator/double", "pdf without cos h",
                  "pdf is D/(4 wo.h), the cosine of h is missing", {CauseKind::cosine},
                  Beckmann<double>{0.5, 0.8, 3}, seen_from({0, 60}));
  twin<D3, Pcg32>(cases, "beckmann/alpha 0.5/albedo known/double", "G of the squared roughness",
                  "B26: G uses the square of what D uses; only the known albedo tells",
                  {CauseKind::energy, CauseKind::roughness, CauseKind::masking},
                  Beckmann<double>{0.5, 0.8, 4}, known_beckmann(0.5));
}

}  // namespace plumbline::tests::corpus
