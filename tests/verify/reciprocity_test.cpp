#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

#include <plumbline/verify/bsdf.h>

#include "textbook_glass.h"

/// Reciprocity up to what rounding does, and no further.
namespace plumbline::tests {
namespace {

using verify::BsdfOptions;
using verify::CheckResult;
using verify::Verdict;

BsdfOptions with_eta(double eta = 1) {
  BsdfOptions o;
  o.eta = eta;
  o.contract.seed = check_seed("reciprocity");
  return o;
}

template <class B>
CheckResult reciprocity(const B& bsdf, const BsdfOptions& options = with_eta()) {
  return verify::check_reciprocity("bsdf", verify::erase_bsdf(bsdf), options);
}

template <class T>
class ReciprocityIn : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ReciprocityIn, Scalars);

TYPED_TEST(ReciprocityIn, TextbookFormulasPassHoweverNarrow) {
  for (const double alpha : {1.0, 0.1, 0.01, 1e-3, 1e-4}) {
    // 2^-23/α² > 1: the formula is rounding and nothing else.
    if (sizeof(TypeParam) == sizeof(float) && alpha < 1e-2) continue;
    for (const double eta : {0.0, 1.5}) {
      const TextbookGlass<TypeParam> glass{TypeParam(alpha), TypeParam(eta)};
      const CheckResult r = reciprocity(glass, with_eta(eta == 0 ? 1 : eta));
      EXPECT_EQ(r.verdict, Verdict::pass) << alpha << ", η " << eta << ": " << r.reason;
    }
  }
}

/// Off by `error` times the difference of the cosines.
template <class T>
struct SkewedGlass : TextbookGlass<T> {
  double error = 0;
  T eval(Vector<T> wo, Vector<T> wi) const {
    return TextbookGlass<T>::eval(wo, wi) * (1 + T(error) * (wo.z - wi.z));
  }
};

TEST(Reciprocity, FindsAnErrorOfAMillionthWhereFIsSmooth) {
  for (const double alpha : {1.0, 0.3, 0.1}) {
    SkewedGlass<double> mirror;
    mirror.alpha = alpha, mirror.eta = 0;
    EXPECT_EQ(reciprocity(mirror).verdict, Verdict::pass) << alpha;
    mirror.error = 1e-6;
    EXPECT_EQ(reciprocity(mirror).verdict, Verdict::fail) << alpha;
  }
}

TEST(Reciprocity, FindsInFloatWhatFloatShows) {
  SkewedGlass<float> mirror;
  mirror.alpha = 0.3f, mirror.eta = 0;
  EXPECT_EQ(reciprocity(mirror).verdict, Verdict::pass);
  mirror.error = 1e-3;
  EXPECT_EQ(reciprocity(mirror).verdict, Verdict::fail);
}

TEST(Reciprocity, FindsAnErrorOfAPartIn1000OfANarrowLobe) {
  SkewedGlass<double> mirror;
  mirror.alpha = 1e-3, mirror.eta = 0, mirror.error = 1e-3;
  EXPECT_EQ(reciprocity(mirror).verdict, Verdict::fail);
}

/// Beckmann, in float: its tail is denormal, and then 0.
struct DenormalTail {
  using V = Vector<float>;
  struct Record {
    V wi;
  };
  float error = 0;

  std::optional<Record> sample(V wo, float u, float v) const {
    if (wo.z <= 0) return std::nullopt;
    const float r = std::sqrt(u), phi = 2 * std::numbers::pi_v<float> * v;
    return Record{{r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)}};
  }
  float pdf(V, V wi) const { return std::max(0.0f, wi.z / std::numbers::pi_v<float>); }
  float eval(V wo, V wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    constexpr float kAlpha2 = 0.0081f;
    const V h = unit(combined(wo, 1.0f, wi, 1.0f));
    const float tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z);
    return std::exp(-tan2 / kAlpha2) / (std::numbers::pi_v<float> * kAlpha2) / 4 *
           (1 - 0.3f * wo.z) * (1 - (0.3f + error) * wi.z);
  }
};

TEST(Reciprocity, LeavesOutWhatUnderflows) {
  EXPECT_EQ(reciprocity(DenormalTail{}).verdict, Verdict::pass);
  EXPECT_EQ(reciprocity(DenormalTail{0.03f}).verdict, Verdict::fail);
}

/// Diffuse; counts on which side the given direction was.
struct Watched {
  using V = Vector<double>;
  struct Record {
    V wi;
  };
  struct Counts {
    int front = 0, back = 0;
  };
  std::shared_ptr<Counts> given = std::make_shared<Counts>();

  Record sample(V wo, double u, double v) const {
    const double r = std::sqrt(u), phi = 2 * std::numbers::pi * v;
    return {{r * std::cos(phi), r * std::sin(phi), std::copysign(std::sqrt(1 - u), wo.z)}};
  }
  double pdf(V wo, V wi) const { return std::max(0.0, wo.z * wi.z); }
  double eval(V wo, V) const {
    ++(wo.z > 0 ? given->front : given->back);
    return 1;
  }
};

TEST(Reciprocity, AsksOnlyOnTheSidesThatAreLookedAt) {
  BsdfOptions front_only = with_eta(), back_only = with_eta();
  front_only.back = back_only.front = false;
  const Watched from_front, from_back;
  EXPECT_EQ(reciprocity(from_front, front_only).verdict, Verdict::pass);
  EXPECT_GT(from_front.given->front, 1000);
  EXPECT_EQ(from_front.given->back, 0);
  EXPECT_EQ(reciprocity(from_back, back_only).verdict, Verdict::pass);
  EXPECT_EQ(from_back.given->front, 0);
  EXPECT_GT(from_back.given->back, 1000);
}

TEST(Reciprocity, IsInconclusiveWhereNoSideIsLookedAt) {
  BsdfOptions none = with_eta();
  none.front = none.back = false;
  const CheckResult r = reciprocity(Watched{}, none);
  EXPECT_EQ(r.verdict, Verdict::inconclusive);
  EXPECT_FALSE(r.reason.empty());
}

/// A value of its own each time.
struct Restless : Watched {
  std::shared_ptr<std::mt19937> random = std::make_shared<std::mt19937>();
  double eval(V, V) const { return 1 + static_cast<double>((*random)()) * 0x1p-33; }
};

TEST(Reciprocity, IsInconclusiveWhereFIsRandom) {
  const CheckResult r = reciprocity(Restless{});
  EXPECT_EQ(r.verdict, Verdict::inconclusive);
  EXPECT_NE(r.reason.find("random"), std::string::npos) << r.reason;
}

struct NotFinite : Watched {
  double value;
  double eval(V, V wi) const { return wi.z > 0.9 ? value : 1; }
};

TEST(Reciprocity, FailsWhereFIsNotFinite) {
  for (const double value :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(reciprocity(NotFinite{{}, value}).verdict, Verdict::fail) << value;
  }
}

}  // namespace
}  // namespace plumbline::tests
