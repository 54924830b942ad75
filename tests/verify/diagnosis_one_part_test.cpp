#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "diagnosis/apart.h"
#include "diagnosis_cases.h"

/// Faults in one part of a mixture whose lobes do not show, and of samples that crowd.
namespace plumbline::verify {
namespace {

using std::numbers::pi;

FaultyCase of_part(std::string name, CauseKind right, ErasedBsdf b,
                   BsdfOptions options = from({20, 50, 70})) {
  return of(std::move(name), right, std::move(b), std::move(options));
}

/// What the sample states follows pdf(), and no weight is stated.
ErasedBsdf with_pdf(ErasedBsdf b, const std::function<double(const Vec3&, const Vec3&)>& pdf) {
  b.pdf = pdf;
  b.sample = [pdf, sample = b.sample](const Vec3& wo, const Uniforms& u) {
    auto record = sample(wo, u);
    if (record) record->pdf = pdf(wo, record->x), record->weight = {};
    return record;
  };
  return b;
}

/// Diffuse beside two rough mirrors; a number of its own chooses. Lobes do not show.
ErasedBsdf three_lobes() {
  ErasedBsdf b;
  b.numbers = 3;
  b.sample = [](const Vec3& wo, const Uniforms& u) {
    if (u[0] < 0.5) return Diffuse::sample(wo, u[1], u[2]);
    return RoughMirror{u[0] < 0.8 ? 0.25 : 0.6}.sample(wo, u[1], u[2]);
  };
  b.eval = [](const Vec3& wo, const Vec3& wi) { return gray(Diffuse::eval(wo, wi)); };
  return b;
}

double three_pdf(const Vec3& wo, const Vec3& wi, double diffuse, double narrow, double wide) {
  return 0.5 * diffuse * Diffuse::pdf(wo, wi) + 0.3 * narrow * RoughMirror{0.25}.pdf(wo, wi) +
         0.2 * wide * RoughMirror{0.6}.pdf(wo, wi);
}

/// A normal is drawn, and goes up or down with a probability that follows no law of optics.
double upwards(const Vec3& h) { return 0.25 + 0.5 * h[0] * h[0]; }

ErasedBsdf two_ways() {
  ErasedBsdf b;
  b.numbers = 3;
  b.sample = [](const Vec3& wo, const Uniforms& u) -> std::optional<SampleRecord> {
    const RoughMirror m{0.5};
    auto record = m.sample(wo, u[0], u[1]);
    if (!record) return record;
    if (!(u[2] < upwards(m.visible_normal(wo, u[0], u[1])))) record->x[2] = -record->x[2];
    return record;
  };
  b.eval = [](const Vec3&, const Vec3&) { return gray(1 / pi); };
  return b;
}

/// @param first, second  of the two ways
ErasedBsdf two_ways_with(const std::function<double(const Vec3& wo, const Vec3& h)>& first,
                         const std::function<double(const Vec3& wo, const Vec3& h)>& second) {
  return with_pdf(two_ways(), [=](const Vec3& wo, const Vec3& wi) {
    const Vec3 up{wi[0], wi[1], std::abs(wi[2])};
    const Vec3 h = half_vector(wo, up);
    return (wi[2] > 0 ? first : second)(wo, h) * RoughMirror{0.5}.pdf(wo, up);
  });
}

std::vector<FaultyCase> parts() {
  using K = CauseKind;
  const auto of_three = [](double narrow_by_woh, double without_masking, double diffuse) {
    return with_pdf(three_lobes(), [=](const Vec3& wo, const Vec3& wi) {
      const double woh = dot_of(wo, half_vector(wo, wi));
      return three_pdf(wo, wi, diffuse, std::pow(4 * woh, narrow_by_woh),
                       std::pow(RoughMirror{0.6}.masking(wo), -without_masking));
    });
  };
  ErasedBsdf no_root = three_lobes();
  no_root.sample = [sample = no_root.sample](const Vec3& wo, const Uniforms& u) {
    return sample(wo, {u[0], u[0] < 0.5 ? u[1] * u[1] : u[1], u[2]});
  };
  const auto all = [](const Vec3& wo, const Vec3& wi) { return three_pdf(wo, wi, 1, 1, 1); };
  const auto other_roughness = [](const Vec3& wo, const Vec3& wi) {
    return three_pdf(wo, wi, 1, 1, 0) + 0.2 * RoughMirror{0.36}.pdf(wo, wi);
  };
  return {of_part("no Jacobian in one of three", K::half_vector_jacobian, of_three(1, 0, 1)),
          of_part("no G1 in one of three", K::masking, of_three(0, 1, 1)),
          of_part("1/π missing in one of three", K::constant, of_three(0, 0, pi)),
          of_part("root missing in one of three", K::radius, with_pdf(no_root, all)),
          of_part("alpha squared in one of three", K::roughness,
                  with_pdf(three_lobes(), other_roughness))};
}

std::vector<FaultyCase> ways() {
  using K = CauseKind;
  const auto one = [](const Vec3&, const Vec3&) { return 1.0; };
  const auto up = [](const Vec3&, const Vec3& h) { return upwards(h); };
  const auto by_cosine = [](const Vec3& wo, const Vec3& h) {
    return (2 * dot_of(wo, h) * h[2] - wo[2]) * (1 - upwards(h));  // of wi
  };
  const BsdfOptions options = from({20, 50});
  return {of_part("two ways without their probabilities", K::lobe_probability,
                  two_ways_with(one, one), options),
          of_part("two ways, a cosine in one", K::cosine, two_ways_with(up, by_cosine), options)};
}

std::vector<FaultyCase> crowds() {
  using K = CauseKind;
  ErasedBsdf lifted = erased(RoughMirror{0.7});
  lifted.sample = [](const Vec3& wo, const Uniforms& u) -> std::optional<SampleRecord> {
    const Vec3 h = RoughMirror{0.7}.visible_normal(wo, u[0], u[1]);
    const double d = 2 * dot_of(wo, h);
    Vec3 wi{d * h[0] - wo[0], d * h[1] - wo[1], d * h[2] - wo[2]};
    if (!(wi[2] > 0)) wi = unit({wi[0], wi[1], 1e-3});
    return SampleRecord{wi, {}, RoughMirror{0.7}.pdf(wo, wi)};
  };
  return {of_part("lifted to the horizon", K::not_rejected, lifted, from({60, 75})),
          of("negative beside the middle", K::not_finite,
             sampling_pair<double>(
                 "", Domain::interval(-1, 1), [](double u) { return std::cbrt(2 * u - 1); },
                 [](double x) { return 1.6 * x * x - 0.1; }))};
}

TEST(Parts, AreKnownWithTheirProbabilities) {
  const Vec3 wo = tests::direction_at(40, 0.3);
  const SamplingPair pair = bsdf_pair("",
                                      two_ways_with([](auto&, auto& h) { return upwards(h); },
                                                    [](auto&, auto& h) { return 1 - upwards(h); }),
                                      wo, from({40}));
  ViewEvidence view;
  view.pair = &pair;
  view.wo = wo;
  const Apart apart(view);
  ASSERT_TRUE(apart.known());
  EXPECT_FALSE(apart.fixed());
  int off = 0;
  for (const Equation& e : apart.equations()) off += std::abs(e.sum() - 1) < 1e-4 ? 0 : 1;
  EXPECT_LE(off, 2) << "of " << apart.equations().size() << " points";
}

TEST(Diagnosis, NamesFaultsInOnePart) { expect_named(parts()); }
TEST(Diagnosis, NamesFaultsOfTwoWays) { expect_named(ways()); }
TEST(Diagnosis, NamesSamplesThatCrowd) { expect_named(crowds()); }

}  // namespace
}  // namespace plumbline::verify
