#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <string>

#include <plumbline/verify/gtest.h>

#include "bsdf_case.h"
#include "bsdf_glass.h"
#include "bsdf_mixture.h"

/// BSDFs that an earlier version failed though they are right, or named another cause for. Mixtures
/// of two numbers are among the correct code of corpus_test, formulas that are reciprocal up to
/// rounding in reciprocity_test.
namespace plumbline::tests::corpus {
namespace {

using D3 = V3<double>;
using F3 = V3<float>;
using verify::Report;
using verify::Verdict;

template <class Direction = D3, class B>
Report checked(const std::string& name, const B& bsdf, BsdfOptions options) {
  options.contract.seed = check_seed(name);
  return verify::check_bsdf<Direction>(name, bsdf, options);
}

template <class T>
struct Paint : PaintOfThree<T> {
  explicit Paint(T alpha) { this->ggx = {alpha, alpha}; }
};

/// The share that is rejected is known by counting only, not to 5e-5: that is not asked for unless
/// it is stated.
TEST(OnceMisjudged, RejectionByThreeNumbersPassesWithDefaults) {
  const BsdfOptions options = seen_from({0, 80});
  PLUMBLINE_EXPECT_PASS(repeatable(checked("three numbers/double", Paint<double>(0.1), options)));
  PLUMBLINE_EXPECT_PASS(
      repeatable(checked<F3>("three numbers/float", Paint<float>(0.01F), options)));
}

TEST(OnceMisjudged, SmoothCoatPassesUpToGrazing) {
  BsdfOptions options = seen_from({80, 88, 89.9});
  options.conventions.zero_pdf_is_failure = true;
  PLUMBLINE_EXPECT_PASS(repeatable(checked("coat", SmoothCoat<double>{}, options)));
}

/// A fault is found, one cause explains the whole report, and the summary begins with it.
void expect_named(const Report& report, CauseKind kind, const std::string& words) {
  EXPECT_EQ(report.verdict(), Verdict::fail);
  EXPECT_EQ(to_string(report.cause_kind), to_string(kind)) << report.summary();
  EXPECT_NE(report.cause.find(words), std::string::npos) << report.cause;
  const std::string summary = report.summary(), headline = "\nlikely cause: " + report.cause + "\n";
  EXPECT_EQ(summary.find(headline), summary.find('\n')) << summary;
}

/// lajolla: pdf() is 0 below the surface, samples fall there.
struct KeptBelow : Paint<double> {
  struct Record {
    D3 wi;
  };
  using Paint::Paint;
  std::optional<Record> sample(const D3& wo, const P3<double>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    if (u.x < diffuse_probability) return Record{cosine_hemisphere(u.y, u.z)};
    return Record{mirrored_at(wo, ggx.sample_caps(wo, u.y, u.z))};
  }
};

TEST(OnceMisjudged, SamplesBelowTheHorizonAreNotAFactor) {
  for (const double alpha : {0.1, 0.5}) {
    expect_named(checked("kept below", KeptBelow(alpha), seen_from({0, 60, 80})),
                 CauseKind::not_rejected, "samples below the horizon are not rejected");
  }
}

/// pbrt-v4, issue 215; sample() is right.
struct Exchanged : Paint<double> {
  using Paint::Paint;
  double pdf(const D3& wo, const D3& wi) const { return Paint::pdf(wi, wo); }
  double eval(const D3& wo, const D3& wi) const { return Paint::eval(wi, wo); }
};

/// From straight above, where looking starts, the exchange is a ratio of cosines and of maskings.
TEST(OnceMisjudged, ExchangedDirectionsAreNotACosine) {
  expect_named(checked("exchanged", Exchanged(0.3), seen_from({0, 60})),
               CauseKind::directions_swapped, "wo and wi are exchanged in pdf()");
}

/// Half of the density; the record states all of it.
struct Half : Paint<double> {
  using Paint::Paint;
  double pdf(const D3& wo, const D3& wi) const { return Paint::pdf(wo, wi) / 2; }
};

/// Half of the density, and no record to hold it against.
struct HalfUnstated : Half {
  struct Record {
    D3 wi;
    double weight;
  };
  using Half::Half;
  std::optional<Record> sample(const D3& wo, const P3<double>& u) const {
    const auto s = Paint::sample(wo, u);
    if (!s) return std::nullopt;
    return Record{s->wi, s->weight};
  }
};

TEST(OnceMisjudged, HalfThePdfIsNotTheValuesFault) {
  const std::string words = "constant factor 2 missing from pdf()";
  const BsdfOptions options = seen_from({60});
  expect_named(checked("half", Half(0.1), options), CauseKind::constant, words);
  expect_named(checked("half, unstated", HalfUnstated(0.5), options), CauseKind::constant, words);
}

/// lajolla: the disk of the visible normals lies in any frame around wo, so that its cut is not at
/// the horizon.
struct AnyTangent : Paint<double> {
  using Paint::Paint;
  std::optional<Sampled<double>> sample(const D3& wo, const P3<double>& u) const {
    if (u.x < diffuse_probability) return Paint::sample(wo, u);
    if (!(wo.z > 0)) return std::nullopt;
    const D3 wi = mirrored_at(wo, ggx.sample_disk(wo, u.y, u.z, 30));
    return wi.z > 0 ? finish(wo, wi, false) : std::nullopt;
  }
};

/// At 88° few samples of the glossy lobe are left, and no jump of the number that chooses shows.
TEST(OnceMisjudged, AFrameWithoutAHorizontalTangentIsNamed) {
  expect_named(checked("any tangent", AnyTangent(0.5), seen_from({60, 88})),
               CauseKind::tangent_frame, "another tangent frame");
}

}  // namespace
}  // namespace plumbline::tests::corpus
