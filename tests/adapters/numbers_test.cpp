#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <stdexcept>
#include <vector>

#include "lambert.h"

/// What `sample` takes as random numbers, and what colours, vectors and records are made of.
namespace plumbline::tests {
namespace {

struct ThreeNumbers : Lambert {
  auto sample(const V& wo, double lobe, double u, double v) const {
    // Two lobes that are the same: one more number than the map needs.
    return lobe < 0.5 ? Lambert::sample(wo, u, v) : Lambert::sample(wo, 1 - u, v);
  }
};

struct Pair {
  double x, y;
};

struct VectorOfTwo : Lambert {
  auto sample(const V& wo, const Pair& u) const { return Lambert::sample(wo, u.x, u.y); }
};

struct VectorOfThree : Lambert {
  auto sample(const V& wo, const V& u) const { return Lambert::sample(wo, u.x, u.y); }
};

/// Two components by name and by index, as of glm.
struct NamedAndIndexed {
  double x, y;
  double& operator[](int i) { return at(i), i == 0 ? x : y; }
  double operator[](int i) const { return at(i), i == 0 ? x : y; }
  static void at(int i) {
    if (i > 1) throw std::out_of_range("two components");
  }
};

struct VectorOfTwoByIndex : Lambert {
  auto sample(const V& wo, const NamedAndIndexed& u) const { return Lambert::sample(wo, u.x, u.y); }
};

struct ArrayOfTwo : Lambert {
  auto sample(const V& wo, const std::array<double, 2>& u) const {
    return Lambert::sample(wo, u[0], u[1]);
  }
};

struct ArrayOfThree : Lambert {
  auto sample(const V& wo, const std::array<double, 3>& u) const noexcept {
    return u[2] < 0.5 ? Lambert::sample(wo, u[0], u[1]) : Lambert::sample(wo, 1 - u[0], u[1]);
  }
};

TEST(Numbers, AVectorOfTwoHasNoThird) {
  EXPECT_TRUE(passes(VectorOfTwoByIndex{}));
  EXPECT_TRUE(passes(ArrayOfTwo{}));
  EXPECT_TRUE(passes(ArrayOfThree{}));
  EXPECT_EQ(verify::erase_bsdf(ArrayOfTwo{}).numbers, 2);
  EXPECT_EQ(verify::erase_bsdf(ArrayOfThree{}).numbers, 3);
}

TEST(Numbers, TwoThreeOrAVector) {
  EXPECT_TRUE(passes(ThreeNumbers{}));
  EXPECT_TRUE(passes(VectorOfTwo{}));
  EXPECT_TRUE(passes(VectorOfThree{}));
}

struct ChecksGenerator : Lambert {
  auto sample(const V& wo, verify::Random& random) const {
    const double u = random.uniform();
    return Lambert::sample(wo, u, random.uniform());
  }
};

struct AnyGenerator : Lambert {
  template <class Generator>
  auto sample(const V& wo, Generator& generator) const {
    std::uniform_real_distribution<double> uniform;
    const double u = uniform(generator);
    return Lambert::sample(wo, u, uniform(generator));
  }
};

/// A generator of the renderer's own (PCG-XSH-RR).
class OwnGenerator {
 public:
  using result_type = std::uint32_t;
  explicit OwnGenerator(std::uint32_t seed) : state_(seed) { (*this)(), (*this)(); }
  static constexpr std::uint32_t min() { return 0; }
  static constexpr std::uint32_t max() { return ~std::uint32_t{0}; }
  std::uint32_t operator()() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005u + 1442695040888963407u;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto rotation = static_cast<std::uint32_t>(old >> 59);
    return (shifted >> rotation) | (shifted << ((32 - rotation) % 32));
  }
  double uniform() { return (*this)() * 0x1p-32; }

 private:
  std::uint64_t state_;
};

struct TakesOwnGenerator : Lambert {
  double lost = 0;  ///< share of the samples that the pdf knows nothing of

  auto sample(const V& wo, OwnGenerator& generator) const {
    const double u = generator.uniform();
    if (generator.uniform() < lost) return decltype(Lambert::sample(wo, u, u))();
    return Lambert::sample(wo, u, generator.uniform());
  }
};

TEST(Numbers, OrAGenerator) {
  EXPECT_TRUE(passes(ChecksGenerator{}));
  EXPECT_TRUE(passes(AnyGenerator{}));
  EXPECT_TRUE(passes(TakesOwnGenerator{}));
  EXPECT_FALSE(passes(TakesOwnGenerator{{}, 0.1}));
}

struct Rgb {
  float r, g, b;
};

/// A vector class with operator[] only, in float.
class Indexed {
 public:
  Indexed() = default;
  Indexed(float x, float y, float z) : v_{x, y, z} {}
  float operator[](int i) const { return v_[i]; }

 private:
  float v_[3] = {0, 0, 0};
};

/// In float, with colours, and records that are named and handed over in another way.
template <class Colour>
struct Other {
  struct Sample {
    Indexed direction;
    Colour throughput;
    float pdf_w;
  };
  Colour colour;

  std::unique_ptr<Sample> sample(const Indexed& wo, float u, float v) const {
    if (wo[2] <= 0) return nullptr;
    const float radius = std::sqrt(u), phi = 2 * float(pi) * v, z = std::sqrt(1 - u);
    return std::make_unique<Sample>(
        Sample{{radius * std::cos(phi), radius * std::sin(phi), z}, colour, z / float(pi)});
  }
  float pdf(const Indexed& wo, const Indexed& wi) const {
    return wo[2] > 0 && wi[2] > 0 ? wi[2] / float(pi) : 0;
  }
  Colour eval(const Indexed& wo, const Indexed& wi) const {
    return wo[2] > 0 && wi[2] > 0 ? times(colour, 1 / float(pi)) : times(colour, 0);
  }
  static Rgb times(const Rgb& c, float f) { return {c.r * f, c.g * f, c.b * f}; }
  static std::vector<float> times(std::vector<float> c, float f) {
    for (float& x : c) x *= f;
    return c;
  }
};

/// The weight forgets one band.
struct WrongBand : Other<Rgb> {
  auto sample(const Indexed& wo, float u, float v) const {
    auto record = Other::sample(wo, u, v);
    if (record) record->throughput.b = 0.5f;
    return record;
  }
};

TEST(Colours, OfThreeBandsOrOfMany) {
  EXPECT_TRUE(passes(Other<Rgb>{{0.2f, 0.5f, 0.8f}}));
  EXPECT_TRUE(passes(Other<std::vector<float>>{std::vector<float>(31, 0.4f)}));
  EXPECT_FALSE(passes(WrongBand{{{0.2f, 0.5f, 0.8f}}}));
}

}  // namespace
}  // namespace plumbline::tests
