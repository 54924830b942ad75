#include <gtest/gtest.h>

#include "lambert.h"

namespace plumbline::tests {
namespace {

using verify::BsdfConventions;

V negated(const V& w) { return {-w.x, -w.y, -w.z}; }

/// Understood with its option, and an error without: an option that nothing needs would pass both.
template <class B>
void expect_needed(const B& bsdf, const BsdfConventions& conventions) {
  EXPECT_TRUE(passes(bsdf, conventions));
  EXPECT_FALSE(passes(bsdf));
}

TEST(Convention, PlumblinesOwnNeedsNoOption) { EXPECT_TRUE(passes(Lambert{})); }

struct CosineInEval : Lambert {
  double eval(const V& wo, const V& wi) const { return Lambert::eval(wo, wi) * std::abs(wi.z); }
};

TEST(Convention, CosineInEval) {
  BsdfConventions c;
  c.cosine_in_eval = true;
  expect_needed(CosineInEval{}, c);
}

struct SampledFirst : Lambert {
  double pdf(const V& wi, const V& wo) const { return Lambert::pdf(wo, wi); }
  double eval(const V& wi, const V& wo) const { return Lambert::eval(wo, wi); }
};

TEST(Convention, SampledDirectionFirst) {
  BsdfConventions c;
  c.sampled_direction_first = true;
  expect_needed(SampledFirst{}, c);
}

struct GivenPointsIn : Lambert {
  auto sample(const V& ray, double u, double v) const {
    return Lambert::sample(negated(ray), u, v);
  }
  double pdf(const V& ray, const V& wi) const { return Lambert::pdf(negated(ray), wi); }
  double eval(const V& ray, const V& wi) const { return Lambert::eval(negated(ray), wi); }
};

TEST(Convention, GivenDirectionPointsIn) {
  BsdfConventions c;
  c.given_points_in = true;
  expect_needed(GivenPointsIn{}, c);
}

/// In a frame of its own, given by where the local axes point.
struct InFrame : Lambert {
  V x, y, z;

  V local(const V& w) const {
    return {w.x * x.x + w.y * x.y + w.z * x.z, w.x * y.x + w.y * y.y + w.z * y.z,
            w.x * z.x + w.y * z.y + w.z * z.z};
  }
  V own(const V& w) const {
    return {w.x * x.x + w.y * y.x + w.z * z.x, w.x * x.y + w.y * y.y + w.z * z.y,
            w.x * x.z + w.y * y.z + w.z * z.z};
  }
  std::optional<Record> sample(const V& wo, double u, double v) const {
    auto record = Lambert::sample(local(wo), u, v);
    if (record) record->wi = own(record->wi);
    return record;
  }
  double pdf(const V& wo, const V& wi) const { return Lambert::pdf(local(wo), local(wi)); }
  double eval(const V& wo, const V& wi) const { return Lambert::eval(local(wo), local(wi)); }
};

TEST(Convention, YUp) {
  BsdfConventions c;
  c.frame = BsdfConventions::Frame::local_y_up;
  expect_needed(InFrame{{}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, c);
}

TEST(Convention, WorldFrameAroundANormal) {
  BsdfConventions c;
  c.frame = BsdfConventions::Frame::world;
  c.normal = {0.6, 0, 0.8};
  expect_needed(InFrame{{}, {0.8, 0, -0.6}, {0, 1, 0}, {0.6, 0, 0.8}}, c);
}

TEST(Convention, BlackFromEveryDirectionIsNoPass) {
  // Below the horizon of a frame that nobody stated: every check of black is right.
  EXPECT_FALSE(passes(InFrame{{}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}}));
}

/// A tenth of the samples fails, and says so by a pdf of 0.
struct ZeroPdf : Lambert {
  Record sample(const V& wo, double u, double v) const {
    const auto record = v < 0.1 ? std::nullopt : Lambert::sample(wo, u, (v - 0.1) / 0.9);
    if (!record) return {{0, 0, 1}, 0, 0};
    return {record->wi, 0.9 * record->pdf, record->weight / 0.9};
  }
  double pdf(const V& wo, const V& wi) const { return 0.9 * Lambert::pdf(wo, wi); }
};

TEST(Convention, ZeroPdfIsFailure) {
  BsdfConventions c;
  c.zero_pdf_is_failure = true;
  expect_needed(ZeroPdf{}, c);
}

/// Records of a direction only, from all around: below the surface, pdf() is 0.
struct Direction {
  V wi;
};
struct PdfAskedForAfterwards : Lambert {
  Direction sample(const V&, double u, double v) const {
    const double z = 1 - 2 * u, radius = std::sqrt(1 - z * z), phi = 2 * pi * v;
    return {{radius * std::cos(phi), radius * std::sin(phi), z}};
  }
  double pdf(const V& wo, const V& wi) const { return wo.z > 0 && wi.z > 0 ? 1 / (4 * pi) : 0; }
};

TEST(Convention, ZeroPdfIsFailureAlsoWherePdfHasToBeAsked) {
  BsdfConventions c;
  c.zero_pdf_is_failure = true;
  expect_needed(PdfAskedForAfterwards{}, c);
}

/// The same, with a weight and the pdf in the record.
struct BelowWithPdfZero : PdfAskedForAfterwards {
  Record sample(const V& wo, double u, double v) const {
    const V wi = PdfAskedForAfterwards::sample(wo, u, v).wi;
    const double p = pdf(wo, wi);
    return {wi, p, p > 0 ? eval(wo, wi) * wi.z / p : 0};
  }
};

TEST(Convention, SamplesBelowTheSurfaceWithPdfZero) {
  BsdfConventions c;
  c.zero_pdf_is_failure = true;
  expect_needed(BelowWithPdfZero{}, c);
}

/// f·|cosθ| in a record that does not say its pdf.
struct ValueWithoutPdf : Lambert {
  struct Value {
    V wi;
    double value;
  };
  double factor = 1;

  std::optional<Value> sample(const V& wo, double u, double v) const {
    const auto record = Lambert::sample(wo, u, v);
    if (!record) return std::nullopt;
    return Value{record->wi, factor * kAlbedo / pi * record->wi.z};
  }
};

TEST(Convention, ValueInARecordThatStatesNoPdf) {
  BsdfConventions c;
  c.weight = BsdfConventions::Weight::f_cosine;
  expect_needed(ValueWithoutPdf{}, c);
  EXPECT_FALSE(passes(ValueWithoutPdf{{}, 1.01}, c));
}

/// A pdf that is stated as NaN is stated, and wrong.
struct StatesNan : Lambert {
  std::optional<Record> sample(const V& wo, double u, double v) const {
    auto record = Lambert::sample(wo, u, v);
    if (record && v < 0.01) record->pdf = std::nan("");
    return record;
  }
};

TEST(Convention, ANanInTheRecordIsNotSilence) { EXPECT_FALSE(passes(StatesNan{})); }

/// Leaves it to its caller to see that wo is above the surface.
struct OneSided : Lambert {
  std::optional<Record> sample(const V&, double u, double v) const {
    return Lambert::sample({0, 0, 1}, u, v);
  }
  double pdf(const V&, const V& wi) const { return Lambert::pdf({0, 0, 1}, wi); }
  double eval(const V&, const V& wi) const { return Lambert::eval({0, 0, 1}, wi); }
};

TEST(Convention, OnlyTheFrontIsMeant) {
  const auto all_pass = [](bool back) {
    verify::BsdfOptions o = quick();
    o.back = back;
    for (const verify::CheckResult& r : verify::check_bsdf("one-sided", OneSided{}, o)) {
      if (!r.as_expected()) return false;
    }
    return true;
  };
  EXPECT_TRUE(all_pass(false));
  EXPECT_FALSE(all_pass(true));
}

struct ProjectedPdf : Lambert {
  std::optional<Record> sample(const V& wo, double u, double v) const {
    auto record = Lambert::sample(wo, u, v);
    if (record) record->pdf = 1 / pi;
    return record;
  }
  double pdf(const V& wo, const V& wi) const { return wo.z > 0 && wi.z > 0 ? 1 / pi : 0; }
};

TEST(Convention, PdfInProjectedSolidAngle) {
  BsdfConventions c;
  c.projected_pdf = true;
  expect_needed(ProjectedPdf{}, c);
}

/// The record holds something else than f·|cosθ|/pdf.
struct OtherWeight : Lambert {
  double (*weight)(const Record&);

  std::optional<Record> sample(const V& wo, double u, double v) const {
    auto record = Lambert::sample(wo, u, v);
    if (record) record->weight = weight(*record);
    return record;
  }
};

TEST(Convention, RecordHoldsTheValueInsteadOfTheThroughput) {
  BsdfConventions c;
  c.weight = BsdfConventions::Weight::f;
  expect_needed(OtherWeight{{}, [](const Record&) { return Lambert::kAlbedo / pi; }}, c);
  c.weight = BsdfConventions::Weight::f_cosine;
  expect_needed(OtherWeight{{}, [](const Record& r) { return Lambert::kAlbedo / pi * r.wi.z; }}, c);
}

TEST(Convention, RecordHoldsAWeightThatIsNotMeant) {
  BsdfConventions c;
  c.weight = BsdfConventions::Weight::unused;
  expect_needed(OtherWeight{{}, [](const Record&) { return 17.0; }}, c);
}

/// Several at once, as renderers have them: order of application matters.
struct AllAtOnce : InFrame {
  std::optional<Record> sample(const V& ray, double u, double v) const {
    auto record = InFrame::sample(negated(ray), u, v);
    if (record) record->pdf = 1 / pi, record->weight = Lambert::kAlbedo / pi * local(record->wi).z;
    return record;
  }
  double pdf(const V& wi, const V& ray) const {
    return InFrame::pdf(negated(ray), wi) > 0 ? 1 / pi : 0;
  }
  double eval(const V& wi, const V& ray) const {
    return InFrame::eval(negated(ray), wi) * std::abs(local(wi).z);
  }
};

TEST(Convention, AllAtOnce) {
  BsdfConventions c;
  c.frame = BsdfConventions::Frame::local_y_up;
  c.cosine_in_eval = c.sampled_direction_first = c.given_points_in = c.projected_pdf = true;
  c.weight = BsdfConventions::Weight::f_cosine;
  expect_needed(AllAtOnce{{{}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}, c);
}

}  // namespace
}  // namespace plumbline::tests
