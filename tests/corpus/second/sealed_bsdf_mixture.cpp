#include "bsdf_case.h"
#include "bsdf_diffuse.h"
#include "bsdf_families.h"
#include "bsdf_mixture.h"
#include "bsdf_phong.h"

namespace plumbline::tests::corpus {

namespace {

using F3 = V3<float>;
using D3 = V3<double>;

/// Paint of any kind: diffuse under GGX.
template <class Paint, class T>
Paint paint(T alpha, int fault = 0) {
  Paint p;
  p.ggx = {alpha, alpha};
  p.fault = fault;
  return p;
}

[[maybe_unused]] FiveLobes<double> five(int fault = 0) {
  FiveLobes<double> lobes;
  lobes.fault = fault;
  return lobes;
}

using Velvet = Blend<double, Lambert<double>, Conductor<double>>;
[[maybe_unused]] Velvet blend(int fault = 0) {
  return {{0.8}, {{0.3, 0.3}, Normals::caps}, 0.4, fault};
}

/// A blend of a blend: three kinds of lobe.
using Nested = Blend<double, Velvet, Retroreflector<double>>;

}  // namespace

void add_sealed_mixture_cases(std::vector<Case>& cases) {
  twin<D3>(
      cases, "paint/two numbers/alpha 0.2/double", "weights for probabilities",
      "pdf has the albedo of a lobe for the probability that it is chosen with",
      {CauseKind::lobe_probability},
      [] {
        auto p = paint<PaintOfTwo<double>>(0.2, 1);
        p.kd = 0.6;
        return p;
      }(),
      seen_from({0, 60}));
  twin<D3>(cases, "paint/two numbers/alpha 0.2/double", "lobe without its probability",
           "pdf has the diffuse lobe without the probability of its choice",
           {CauseKind::lobe_probability}, paint<PaintOfTwo<double>>(0.2, 2), seen_from({0, 60}));
  twin<D3>(cases, "paint/generator/alpha 0.2/double", "sum of the lobes' pdfs",
           "pdf adds the lobes without any probability", {CauseKind::lobe_probability},
           paint<PaintOfGenerator<double>>(0.2, 3), seen_from({0, 60}));
  twin<D3>(cases, "paint/lobes exposed/alpha 0.2/double", "the larger pdf",
           "pdf is the larger of the lobes' pdfs", {CauseKind::lobe_probability},
           paint<PaintWithLobes<double>>(0.2, 4), seen_from({0, 60}));
  twin<D3>(cases, "paint/three numbers/alpha 0.2/double", "a lobe missing",
           "pdf is that of the glossy lobe, as if there were no other",
           {CauseKind::lobe_probability, CauseKind::chosen_lobe_only},
           paint<PaintOfThree<double>>(0.2, 5), seen_from({0, 60}));
  twin<D3>(cases, "paint/two numbers/alpha 0.2/double", "record of the chosen lobe",
           "B7: the record has the chosen lobe's pdf", {CauseKind::chosen_lobe_only},
           paint<PaintOfTwo<double>>(0.2, 7), seen_from({0, 60}));
  twin<D3>(cases, "paint/generator/alpha 0.2/double", "weight of the chosen lobe",
           "B8: the weight is the chosen lobe's f over the pdf of both",
           {CauseKind::chosen_lobe_only, CauseKind::weight},
           paint<PaintOfGenerator<double>>(0.2, 8), seen_from({0, 60}));
  twin<D3>(cases, "paint/generator/alpha 0.8/double", "drawn again",
           "a sample below the horizon is drawn again up to three times, pdf does not know",
           {CauseKind::not_rejected}, paint<PaintOfGenerator<double>>(0.8, 12),
           seen_from({60, 85}));
  twin<D3>(cases, "five lobes/double", "thresholds not summed",
           "a lobe is chosen by its own weight where the running sum belongs",
           {CauseKind::lobe_probability, CauseKind::numbers_reused}, five(1), seen_from({0, 60}));
  twin<D3>(cases, "five lobes/double", "number not stretched",
           "L6: the number that chose the lobe is used as it is", {CauseKind::numbers_reused},
           five(2), seen_from({0, 60}));
  twin<D3>(cases, "five lobes/double", "last lobe without its weight",
           "pdf has the last lobe without its weight", {CauseKind::lobe_probability}, five(6),
           seen_from({0, 60}));
  twin<D3>(cases, "blend/lambert, ggx 0.3/double", "weight of the chosen BSDF",
           "B8: the blend returns the weight of the BSDF that was asked",
           {CauseKind::chosen_lobe_only, CauseKind::weight}, blend(2), seen_from({0, 60}));
  twin<D3>(
      cases, "blend/lambert, ggx 0.3/double", "weights exchanged in pdf",
      "pdf has the blend's weights exchanged", {CauseKind::lobe_probability},
      [] {
        auto b = blend(3);
        b.weight = 0.25;
        return b;
      }(),
      seen_from({0, 60}));
}

}  // namespace plumbline::tests::corpus
