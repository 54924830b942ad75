#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <random>

#include "lambert.h"

/// Lobes are found in every form that `sample` may have, and what is wrong with them too.
namespace plumbline::tests {
namespace {

struct Two {
  double x, y;
};

/// Two diffuse lobes of different exponents, cosθ and 2 cos³θ, chosen by reusing the first number.
/// @param stated  of the first lobe, beside what it is: 0.3
struct Mixture : Lambert {
  static constexpr double kFirst = 0.3;
  double stated = kFirst;

  static V power(double exponent, double u, double v) {
    const double z = std::pow(1 - u, 1 / (exponent + 1)), phi = 2 * pi * v;
    const double radius = std::sqrt(std::max(0.0, 1 - z * z));
    return {radius * std::cos(phi), radius * std::sin(phi), z};
  }
  static double density(int i, double z) { return i == 0 ? z / pi : 2 * z * z * z / pi; }
  std::optional<Record> record(const V& wo, const V& wi) const {
    if (wo.z <= 0 || wi.z <= 0) return std::nullopt;
    const double p = pdf(wo, wi);
    return Record{wi, p, eval(wo, wi) * wi.z / p};
  }
  std::optional<Record> lobe(const V& wo, int i, double u, double v) const {
    return record(wo, power(i == 0 ? 1 : 3, u, v));
  }

  std::optional<Record> sample(const V& wo, double u, double v) const {
    return u < kFirst ? lobe(wo, 0, u / kFirst, v) : lobe(wo, 1, (u - kFirst) / (1 - kFirst), v);
  }
  double pdf(const V& wo, const V& wi) const {
    if (wo.z <= 0 || wi.z <= 0) return 0;
    return kFirst * density(0, wi.z) + (1 - kFirst) * density(1, wi.z);
  }
  int lobe_count() const { return 2; }
  double lobe_probability(const V&, int i) const { return i == 0 ? stated : 1 - stated; }
  double pdf_lobe(const V& wo, const V& wi, int i) const {
    return wo.z > 0 && wi.z > 0 ? density(i, wi.z) : 0;
  }
};

struct ByTwoNumbers : Mixture {
  auto sample_lobe(const V& wo, int i, double u, double v) const { return lobe(wo, i, u, v); }
};

struct ByThreeNumbersOfWhichOneIsIdle : Mixture {
  auto sample_lobe(const V& wo, int i, double u, double v, double) const {
    return lobe(wo, i, u, v);
  }
};

struct ByThreeNumbers : Mixture {
  auto sample_lobe(const V& wo, int i, double u, double v, double side) const {
    return lobe(wo, i, side < 0.5 ? u : 1 - u, v);
  }
};

struct ByAVectorOfTwo : Mixture {
  auto sample_lobe(const V& wo, int i, const Two& u) const { return lobe(wo, i, u.x, u.y); }
};

struct ByAnArray : Mixture {
  auto sample_lobe(const V& wo, int i, std::array<double, 2> u) const noexcept {
    return lobe(wo, i, u[0], u[1]);
  }
};

struct ByTheChecksGenerator : Mixture {
  auto sample_lobe(const V& wo, int i, verify::Random& random) const {
    const double u = random.uniform();
    return lobe(wo, i, u, random.uniform());
  }
};

struct ByAStandardGenerator : Mixture {
  auto sample_lobe(const V& wo, int i, std::minstd_rand& random) const {
    std::uniform_real_distribution<double> uniform;
    const double u = uniform(random);
    return lobe(wo, i, u, uniform(random));
  }
};

/// The whole by a generator, the lobes by numbers.
struct WholeByAGenerator : ByTwoNumbers {
  auto sample(const V& wo, verify::Random& random) const {
    const int i = random.uniform() < kFirst ? 0 : 1;
    const double u = random.uniform();
    return lobe(wo, i, u, random.uniform());
  }
};

template <class B>
class Lobes : public testing::Test {};
using Forms =
    testing::Types<ByTwoNumbers, ByThreeNumbersOfWhichOneIsIdle, ByThreeNumbers, ByAVectorOfTwo,
                   ByAnArray, ByTheChecksGenerator, ByAStandardGenerator, WholeByAGenerator>;
TYPED_TEST_SUITE(Lobes, Forms);

TYPED_TEST(Lobes, AreFoundAndHeldToTheWhole) {
  EXPECT_EQ(verify::erase_bsdf(TypeParam{}).lobes.size(), 2u);
  EXPECT_TRUE(passes(TypeParam{}));
  TypeParam wrong;
  wrong.stated = 0.35;
  EXPECT_FALSE(passes(wrong)) << "the probability of the lobes is not that of the whole";
}

/// The density of a lobe that is not what it samples.
struct WrongLobe : ByTwoNumbers {
  double pdf_lobe(const V& wo, const V& wi, int i) const {
    return ByTwoNumbers::pdf_lobe(wo, wi, i == 0 ? i : 0);
  }
};

TEST(LobesWith, AWrongDensityFail) { EXPECT_FALSE(passes(WrongLobe{})); }

TEST(LobesWith, ANamedTypeOfNumbersMayTakeScalars) {
  EXPECT_TRUE((passes<V, Two>(ByTwoNumbers{})));
  EXPECT_TRUE((passes<V, Two>(ByAVectorOfTwo{})));
}

/// lobe_count() without a sample_lobe that is understood does not compile; what says so:
struct ByText : Mixture {
  auto sample_lobe(const V& wo, int i, const char*) const { return lobe(wo, i, 0.5, 0.5); }
};
static_assert(verify::detail::numbers_style<verify::detail::SampleLobeOf<ByText>, V, Two>() ==
              verify::detail::NumbersStyle::unknown);
static_assert(
    verify::detail::numbers_style<verify::detail::SampleLobeOf<ByText>, V, const char*>() ==
    verify::detail::NumbersStyle::unknown);
static_assert(
    verify::detail::numbers_style<verify::detail::SampleLobeOf<ByAVectorOfTwo>, V, Two>() ==
    verify::detail::NumbersStyle::vector);

/// Counts how often it is copied.
struct Large : ByTwoNumbers {
  std::shared_ptr<int> copies = std::make_shared<int>(0);
  Large() = default;
  Large(const Large& other) : ByTwoNumbers(other), copies(other.copies) { ++*copies; }
  Large& operator=(const Large&) = delete;
};

TEST(Held, OnceHoweverManyLobes) {
  const Large large;
  EXPECT_TRUE(passes(large));
  EXPECT_EQ(*large.copies, 1);
}

TEST(Held, WithoutACopyWhereItIsShared) {
  const auto large = std::make_shared<Large>();
  const verify::ErasedBsdf erased = verify::erase_bsdf(large);
  EXPECT_EQ(*large->copies, 0);
  EXPECT_EQ(erased.lobes.size(), 2u);
  EXPECT_EQ(erased.pdf({0, 0, 1}, {0, 0, 1}), large->pdf({0, 0, 1}, {0, 0, 1}));
}

}  // namespace
}  // namespace plumbline::tests
