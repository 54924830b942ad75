#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_ggx.h"

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

void add_sealed_ggx_cases(std::vector<Case>& cases) {
  twin<D3>(cases, "ggx/alpha 0.01/caps/double", "clamped in sample",
           "B29: sample clamps the roughness to 0.05", {CauseKind::roughness},
           metal(0.01, 0.01, Normals::caps, 1), seen_from({0, 60}));
  twin<D3>(cases, "ggx/alpha 0.25/caps/double", "sample takes the roughness for its square",
           "sample uses the square root of alpha", {CauseKind::roughness},
           metal(0.25, 0.25, Normals::caps, 2), seen_from({0, 60}));
  twin<D3>(cases, "ggx/alpha 0.3/caps/double", "pdf of the other direction",
           "B13: wo and wi exchanged in pdf", {CauseKind::directions_swapped},
           metal(0.3, 0.3, Normals::caps, 8), seen_from({0, 60}));
  twin<F3>(cases, "ggx/alpha 0.3/all normals/float", "pdf of the half vector",
           "B3: pdf is D cos h, without 1/(4 wo.h)", {CauseKind::half_vector_jacobian},
           metal(0.3F, 0.3F, Normals::all, 10), seen_from({0, 60}));
  twin<D3>(cases, "ggx/alpha 0.2/caps/double", "pdf of the half vector",
           "B3: pdf of the visible normals, without 1/(4 wo.h)", {CauseKind::half_vector_jacobian},
           metal(0.2, 0.2, Normals::caps, 10), seen_from({0, 60}));
  twin<D3>(cases, "ggx/alpha 0.4/disk/double", "pdf without G1",
           "B2: pdf of the visible normals without G1", {CauseKind::masking},
           metal(0.4, 0.4, Normals::disk, 11), seen_from({30, 75}));
  twin<F3>(cases, "ggx/alpha 0.1/caps/float", "pdf without G1",
           "B2: pdf of the visible normals without G1; 0.7 % at 60 degrees", {CauseKind::masking},
           metal(0.1F, 0.1F, Normals::caps, 11), seen_from({60, 80}));
  twin<D3>(cases, "ggx/alpha 0.3/disk/double", "n.wo for h.wo",
           "the Jacobian of the half vector has n.wo in place of h.wo",
           {CauseKind::half_vector_jacobian}, metal(0.3, 0.3, Normals::disk, 13),
           seen_from({20, 60}));
  twin<D3>(cases, "ggx/alpha 0.16/caps/double", "G of the roughness",
           "B26: G uses the roughness where D uses its square",
           {CauseKind::roughness, CauseKind::masking}, metal(0.16, 0.16, Normals::caps, 15),
           seen_from({30, 75}));
  twin<F3>(cases, "ggx/alpha 0.3/disk/float", "Fresnel of n.wo",
           "f has the Fresnel term of n.wo in place of h.wo, the weight is right",
           {CauseKind::fresnel, CauseKind::asymmetric},
           Conductor<float>{{0.3F, 0.3F}, Normals::disk, false, 0.1F, 18}, seen_from({40, 80}));
  twin<D3>(cases, "ggx/alpha 0.3/caps/double", "f times pi", "D in f lacks its 1/pi",
           {CauseKind::value_constant}, metal(0.3, 0.3, Normals::caps, 20), seen_from({0, 60}));
  twin<F3>(cases, "ggx/alpha 3e-7/caps/float", "narrower than float",
           "a lobe narrower than directions in float can tell apart", {CauseKind::precision},
           metal(3e-7F, 3e-7F, Normals::caps), seen_from({30, 60}));
  twin<D3, Pcg32>(cases, "beckmann/alpha 0.3/generator/double", "alpha for its square",
                  "sample has alpha where its square belongs", {CauseKind::roughness},
                  Beckmann<double>{0.3, 0.8, 1}, seen_from({0, 60}));
  twin<D3, Pcg32>(cases, "beckmann/alpha 0.3/generator/double", "masking of one direction",
                  "f lacks the shadowing of wi", {CauseKind::masking, CauseKind::asymmetric},
                  Beckmann<double>{0.3, 0.8, 5}, seen_from({30, 75}));
}

}  // namespace plumbline::tests::corpus
