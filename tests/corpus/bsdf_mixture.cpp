#include "bsdf_mixture.h"
#include "bsdf_case.h"
#include "bsdf_diffuse.h"
#include "bsdf_families.h"
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

void add_mixture_cases(std::vector<Case>& cases) {
  correct<D3>(cases, "paint/two numbers/alpha 0.1/double", paint<PaintOfTwo<double>>(0.1),
              seen_from({0, 60, 85}));
  correct<F3>(cases, "paint/two numbers/alpha 0.3/float", paint<PaintOfTwo<float>>(0.3F),
              seen_from({0, 60}));
  correct<D3>(cases, "paint/lobes exposed/alpha 0.2/double", paint<PaintWithLobes<double>>(0.2),
              seen_from({0, 60}));
  correct<D3, P2<double>>(cases, "paint/lobes exposed, scalars/alpha 0.2/double",
                          paint<PaintWithLobesOfScalars<double>>(0.2), seen_from({0, 60}));
  correct<D3>(cases, "paint/three numbers/alpha 0.1/double", paint<PaintOfThree<double>>(0.1),
              seen_from({0, 60}));
  correct<F3>(cases, "paint/three numbers/alpha 0.5/float", paint<PaintOfThree<float>>(0.5F),
              seen_from({30, 80}));
  correct<F3>(cases, "paint/generator/alpha 0.05/float", paint<PaintOfGenerator<float>>(0.05F),
              seen_from({0, 60}));
  correct<D3>(cases, "five lobes/double", five(), seen_from({0, 60}));
  correct<D3>(cases, "blend/lambert, ggx 0.3/double", blend(), seen_from({0, 70}));
  correct<D3>(cases, "blend/lambert, ggx 0.3, retroreflector/double", Nested{blend(), {}, 0.3, 0},
              seen_from({30, 60}));

  twin<F3>(cases, "paint/three numbers/alpha 0.3/float", "sum of the lobes' pdfs",
           "pdf adds the lobes without any probability", {CauseKind::lobe_probability},
           paint<PaintOfThree<float>>(0.3F, 3), seen_from({0, 60}));
  twin<D3>(cases, "paint/two numbers/alpha 0.4/double", "glossy pdf of the other direction",
           "B13: pdf of the glossy lobe has wo and wi exchanged", {CauseKind::directions_swapped},
           paint<PaintOfTwo<double>>(0.4, 6), seen_from({30, 75}));
  twin<F3>(cases, "paint/three numbers/alpha 0.2/float", "record of the chosen lobe",
           "B7: the record has the chosen lobe's pdf", {CauseKind::chosen_lobe_only},
           paint<PaintOfThree<float>>(0.2F, 7), seen_from({0, 60}));
  twin<D3>(cases, "paint/lobes exposed/alpha 0.3/double", "weight of the chosen lobe",
           "B8: the weight is the chosen lobe's f over the pdf of both",
           {CauseKind::chosen_lobe_only, CauseKind::weight}, paint<PaintWithLobes<double>>(0.3, 8),
           seen_from({0, 60}));
  twin<D3>(cases, "paint/two numbers/alpha 0.2/double", "number not stretched",
           "L6: the number that chose the lobe is used as it is", {CauseKind::numbers_reused},
           paint<PaintOfTwo<double>>(0.2, 10), seen_from({0, 60}));
  twin<D3>(cases, "paint/three numbers/alpha 0.2/double", "choice used again",
           "the number that chose the lobe serves as its first number too, another is left unused",
           {CauseKind::numbers_reused}, paint<PaintOfThree<double>>(0.2, 10), seen_from({0, 60}));
  twin<D3>(cases, "paint/two numbers/alpha 0.2/double", "stretched by the wrong share",
           "the number left over by the second lobe is divided by the first one's probability",
           {CauseKind::numbers_reused}, paint<PaintOfTwo<double>>(0.2, 11), seen_from({0, 60}));
  twin<D3>(cases, "five lobes/double", "record of the chosen lobe",
           "B7: the record has the chosen lobe's pdf", {CauseKind::chosen_lobe_only}, five(3),
           seen_from({0, 60}));
  twin<D3>(cases, "five lobes/double", "weights one further",
           "pdf has the weight of the next lobe for each",
           {CauseKind::lobe_probability, CauseKind::shifted}, five(4), seen_from({0, 60}));
  twin<D3>(cases, "five lobes/double", "even weights",
           "pdf weighs all lobes alike, sample by their weights", {CauseKind::lobe_probability},
           five(5), seen_from({0, 60}));
  twin<D3>(cases, "blend/lambert, ggx 0.3/double", "record of the chosen BSDF",
           "T2: the blend's record has the pdf of the BSDF that was asked",
           {CauseKind::chosen_lobe_only}, blend(1), seen_from({0, 60}));
  twin<D3>(cases, "blend/lambert, ggx 0.3/double", "first pdf for both",
           "T2: pdf asks the first BSDF for both, as if they were the same",
           {CauseKind::lobe_probability, CauseKind::chosen_lobe_only}, blend(4),
           seen_from({0, 60}));
}

}  // namespace plumbline::tests::corpus
