#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "diagnosis_cases.h"

/// Each fault is named for what it is, and one that no hypothesis explains is not named at all.
namespace plumbline::verify {
namespace {

using std::numbers::pi;
using Of2 = std::function<double(const Vec3&, const Vec3&)>;

/// pdf() and the record's pdf times a factor, the weight left as it is.
ErasedBsdf with_pdf_times(ErasedBsdf b, const Of2& factor) {
  b.pdf = [pdf = b.pdf, factor](const Vec3& wo, const Vec3& wi) {
    const double p = pdf(wo, wi);
    return p > 0 ? p * factor(wo, wi) : 0;
  };
  b.sample = [sample = b.sample, factor](const Vec3& wo, const Uniforms& u) {
    auto record = sample(wo, u);
    if (record) {
      const double f = factor(wo, record->x);
      *record->pdf *= f;
      record->weight.value[0] /= f;
    }
    return record;
  };
  return b;
}

ErasedBsdf with_value_times(ErasedBsdf b, const Of2& factor) {
  b.eval = [eval = b.eval, factor](const Vec3& wo, const Vec3& wi) {
    return gray(eval(wo, wi)[0] * factor(wo, wi));
  };
  return b;
}

ErasedBsdf mirror() { return erased(RoughMirror{0.3}); }
ErasedBsdf diffuse() { return erased(Diffuse{}); }
ErasedBsdf coated() {
  return mixture(diffuse(), mirror(), 0.4, [](const Vec3&) { return 0.4; });
}
/// Lobes that do not show. Of three numbers, so that there is no Jacobian of the choice.
ErasedBsdf hidden(ErasedBsdf b) {
  b.lobes.clear();
  b.numbers = 3;
  return b;
}

double woh(const Vec3& wo, const Vec3& wi) { return dot_of(wo, half_vector(wo, wi)); }
double g1(const Vec3& w, double a) { return RoughMirror{a}.masking(w); }

/// f and densities of a mixture whose lobes do not show, with the specular part of the pdf wrong.
ErasedBsdf coated_with_specular_times(const Of2& factor) {
  ErasedBsdf b = hidden(coated());
  const Of2 pdf = [factor](const Vec3& wo, const Vec3& wi) {
    const double s = RoughMirror{0.3}.pdf(wo, wi);
    return 0.4 * Diffuse::pdf(wo, wi) + 0.6 * (s > 0 ? s * factor(wo, wi) : 0);
  };
  b.pdf = pdf;
  b.sample = [sample = b.sample, pdf](const Vec3& wo, const Uniforms& u) {
    auto record = sample(wo, u);
    if (record) record->pdf = pdf(wo, record->x);
    return record;
  };
  return b;
}

std::vector<FaultyCase> factors() {
  const ErasedBsdf m = mirror(), d = diffuse();
  using K = CauseKind;
  return {
      of("twice", K::constant, with_pdf_times(m, [](auto&, auto&) { return 2.0; })),
      of("1/π missing", K::constant, with_pdf_times(d, [](auto&, auto&) { return pi; })),
      of("odd constant", K::constant, with_pdf_times(m, [](auto&, auto&) { return 1.237; })),
      of("cosθi too many", K::cosine, with_pdf_times(m, [](auto&, auto& i) { return i[2]; })),
      of("cosθo missing", K::cosine, with_pdf_times(m, [](auto& o, auto&) { return o[2]; })),
      of("sinθ", K::sine, with_pdf_times(d, [](auto&, auto& i) { return std::hypot(i[0], i[1]); })),
      of("no half-vector Jacobian", K::half_vector_jacobian,
         with_pdf_times(m, [](auto& o, auto& i) { return 4 * woh(o, i); })),
      of("wo·h in it missing", K::half_vector_jacobian,
         with_pdf_times(m, [](auto& o, auto& i) { return woh(o, i); })),
      of("cosθh missing", K::cosine,
         with_pdf_times(m, [](auto& o, auto& i) { return 1 / half_vector(o, i)[2]; })),
      of("no G1", K::masking, with_pdf_times(m, [](auto& o, auto&) { return 1 / g1(o, 0.3); })),
      of("G1 of wi", K::masking, with_pdf_times(m, [](auto&, auto& i) { return g1(i, 0.3); })),
      of("G1 of other roughness", K::masking,
         with_pdf_times(m, [](auto& o, auto&) { return g1(o, 0.09) / g1(o, 0.3); })),
      of("roughness squared once more", K::roughness,
         [] {
           ErasedBsdf b = mirror();
           b.pdf = [](const Vec3& wo, const Vec3& wi) { return RoughMirror{0.09}.pdf(wo, wi); };
           return b;
         }()),
      of("other roughness in sample", K::roughness,
         [] {
           ErasedBsdf b = erased(RoughMirror{0.2});
           b.sample = mirror().sample;
           return b;
         }()),
      of("1 − F", K::fresnel,
         with_pdf_times(m,
                        [](auto& o, auto& i) {
                          return 1 / (1 - (0.04 + 0.96 * std::pow(1 - woh(o, i), 5)));
                        })),
      of("ripples", K::none,
         with_pdf_times(
             m, [](auto&, auto& i) { return 1 + 0.3 * std::sin(9 * i[0]) * std::cos(7 * i[1]); })),
      of("exponent of masking", K::none,
         with_pdf_times(m, [](auto& o, auto&) { return std::pow(g1(o, 0.3), 1.3); })),
      of("record lacks 1/4", K::record_pdf, [] {
        ErasedBsdf b = mirror();
        b.sample = with_pdf_times(b, [](auto&, auto&) { return 4.0; }).sample;
        return b;
      }())};
}

std::vector<FaultyCase> mixtures() {
  using K = CauseKind;
  const auto schlick = [](const Vec3& wo) { return 0.04 + 0.96 * std::pow(1 - wo[2], 5); };
  const auto without = [](ErasedBsdf b) {
    b.pdf = [lobes = b.lobes](const Vec3& wo, const Vec3& wi) {
      return lobes[0].pdf(wo, wi) + lobes[1].pdf(wo, wi);
    };
    return b;
  };
  const ErasedBsdf translucent = mixture(diffuse(), transmitted(diffuse()), 0.5, schlick);
  ErasedBsdf chosen = coated();
  chosen.sample = [lobes = chosen.lobes, sample = chosen.sample](const Vec3& wo,
                                                                 const Uniforms& u) {
    auto record = sample(wo, u);
    if (record) record->pdf = lobes[u[0] < 0.4 ? 0 : 1].pdf(wo, record->x);
    return record;
  };
  ErasedBsdf kept = mirror();
  kept.sample = [](const Vec3& wo, const Uniforms& u) -> std::optional<SampleRecord> {
    const Vec3 h = RoughMirror{0.3}.visible_normal(wo, u[0], u[1]);
    const double d = 2 * dot_of(wo, h);
    return SampleRecord{
        {d * h[0] - wo[0], d * h[1] - wo[1], d * h[2] - wo[2]}, {}, kNotApplicable, 0};
  };
  ErasedBsdf again = mirror();
  again.sample = nullptr;
  again.draw = [](const Vec3& wo, Random& random) -> std::optional<SampleRecord> {
    for (;;) {
      const double u = random.uniform(), v = random.uniform();
      if (auto r = RoughMirror{0.3}.sample(wo, u, v)) {
        r->weight = {};
        return r;
      }
    }
  };
  return {of("probabilities missing, lobes shown", K::lobe_probability, without(translucent)),
          of("probabilities missing by side", K::lobe_probability, hidden(without(translucent))),
          of("probabilities missing, hidden", K::lobe_probability, hidden(without(coated()))),
          of("chosen lobe's pdf, lobes shown", K::chosen_lobe_only, chosen),
          of("chosen lobe's pdf, hidden", K::chosen_lobe_only, hidden(chosen)),
          of("Jacobian missing in one lobe", K::half_vector_jacobian,
             coated_with_specular_times([](auto& o, auto& i) { return 4 * woh(o, i); })),
          of("G1 missing in one lobe", K::masking,
             coated_with_specular_times([](auto& o, auto&) { return 1 / g1(o, 0.3); })),
          of("samples below the horizon", K::not_rejected, kept, from({30, 60, 80})),
          of("drawn again", K::not_rejected, again, from({30, 60, 80}))};
}

std::vector<FaultyCase> arguments() {
  using K = CauseKind;
  const auto asked = [](const std::function<Of2(Of2)>& change) {
    ErasedBsdf b = mirror();
    b.pdf = change(b.pdf);
    b.sample = [pdf = b.pdf, sample = b.sample](const Vec3& wo, const Uniforms& u) {
      auto r = sample(wo, u);
      if (r) r->pdf = pdf(wo, r->x), r->weight = {};
      return r;
    };
    return b;
  };
  return {of("exchanged", K::directions_swapped, asked([](Of2 p) -> Of2 {
               return [p](const Vec3& o, const Vec3& i) { return p(i, o); };
             })),
          of("negated", K::mirrored, asked([](Of2 p) -> Of2 {
               return [p](const Vec3& o, const Vec3& i) { return p(o, {-i[0], -i[1], i[2]}); };
             })),
          of("turned", K::tangent_frame, asked([](Of2 p) -> Of2 {
               return [p](const Vec3& o, const Vec3& i) {
                 const double c = std::cos(0.4), s = std::sin(0.4);
                 return p(o, {c * i[0] - s * i[1], s * i[0] + c * i[1], i[2]});
               };
             }))};
}

std::vector<FaultyCase> values() {
  using K = CauseKind;
  BsdfOptions o = from({30, 60});
  o.reciprocal = o.conserves_energy = true;
  const auto both = [](ErasedBsdf b, const Of2& f) {
    b = with_value_times(b, f);
    b.sample = [sample = b.sample, f](const Vec3& wo, const Uniforms& u) {
      auto r = sample(wo, u);
      if (r) r->weight.value[0] *= f(wo, r->x);
      return r;
    };
    return b;
  };
  return {of("cosine twice in f", K::value_cosine,
             with_value_times(mirror(), [](auto&, auto& i) { return i[2]; }), o),
          of("cosine twice in f and weight", K::value_cosine,
             both(mirror(), [](auto&, auto& i) { return i[2]; }), o),
          of("1/π missing in f", K::value_constant,
             with_value_times(diffuse(), [](auto&, auto&) { return pi; }), o),
          of("1/π missing in f and weight", K::value_constant,
             both(diffuse(), [](auto&, auto&) { return pi; }), o),
          of("G1 of wi missing in f", K::masking,
             both(mirror(), [](auto&, auto& i) { return 1 / g1(i, 0.3); }), o)};
}

TEST(Diagnosis, NamesFactorsOfDensities) { expect_named(factors()); }
TEST(Diagnosis, NamesFaultsOfMixtures) { expect_named(mixtures()); }
TEST(Diagnosis, NamesArgumentsThatAreMistaken) { expect_named(arguments()); }
TEST(Diagnosis, NamesFaultsOfValues) { expect_named(values()); }

}  // namespace
}  // namespace plumbline::verify
