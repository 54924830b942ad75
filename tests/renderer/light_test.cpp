#include <plumbline/renderer/core/light/light.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/light/spherical_rectangle.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/core/sampling/sobol.h>

namespace plumbline::renderer {
namespace {

using Vec2d = Vec2<double>;

std::vector<Light> one_of_each() {
  const Rgbf white{1, 1, 1};
  return {SphereLight{{0, 0, 3}, 0.5f, false, white},
          SphereLight{{0, 0, 0}, 5.0f, true, white},
          RectangleLight{{-1, -1, 2}, {2, 0, 0}, {0, 3, 0}, {0, 0, -1}, white},
          DiskLight{{0.3f, 0, 2.5f}, {0, 0, -1}, 0.8f, white},
          TriangleLight{
              {-1, 0, 2}, {2, 0.5f, 0}, {0.25f, 2, 1}, normalize(Vec3f{-0.5f, 2, -3.875f}), white},
          ConstantEnvironment{white},
          SunAndSky::make({0, 0, 1}, 0.1, white, white)};
}

TEST(LightSet, RecordedDensityIsTheOneThatAHitAsksFor) {
  // What makes the MIS weights of the two call sites sum to 1: selection included, seen from the
  // shading point. In double, where the two formulas differ by rounding alone; the margin is for
  // directions near the edge of a light, where the point found again has lost digits.
  const LightSet lights(one_of_each());
  Pcg32 random(1, 0, 0);
  std::vector<int> compared(lights.size());
  for (int i = 0; i < 20'000; ++i) {
    const Vec3<double> ref = vec_cast<double>(square_to_uniform_sphere(random.next_2d()));
    const Vec2<double> u{static_cast<double>(random.next_1d()),
                         static_cast<double>(random.next_1d())};
    const std::uint32_t light = lights.choose(u).light;
    const auto sample = lights.sample(ref, u);
    if (!sample) continue;
    ASSERT_GT(sample->pdf_w, 0);
    const double pdf_w = lights.pdf_at_hit(light, ref, sample->wi);
    ASSERT_NEAR(pdf_w / sample->pdf_w, 1, 1e-9) << "light " << light << ", u " << u.x << ' ' << u.y;
    ++compared[light];
  }
  // Of the 20,000 / 7 that fall to each light.
  for (std::size_t i = 0; i < compared.size(); ++i) EXPECT_GT(compared[i], 2'000) << "light " << i;
}

TEST(LightSet, ARayAtTheRimOfALightHasADensity) {
  // Directions of float miss or hit a small sphere by their rounding: whoever found a hit is right.
  const LightSet lights(std::vector<Light>{SphereLight{{0, 0, 10}, 0.01f, false, {1, 1, 1}}});
  Pcg32 random(1, 0, 0);
  int missed = 0;
  for (int i = 0; i < 1000; ++i) {
    const double phi = 2 * pi<double>() * static_cast<double>(random.next_1d());
    const double sine = 1e-3;  // R/d: the rim
    const Vec3f wi = vec_cast<float>(
        Vec3d{sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1 - sine * sine)});
    missed += pdf(lights[0], Vec3f{}, wi) > 0 ? 0 : 1;
    EXPECT_GT(lights.pdf_at_hit(0, Vec3f{}, wi), 0.0f);
  }
  EXPECT_GT(missed, 100);  // or the rim was no rim
}

/// Cells of a grid, 2^a by 2^b, that hold a point.
std::size_t cells_hit(const std::vector<Vec2f>& points, int a, int b) {
  std::set<std::pair<int, int>> cells;
  for (const Vec2f& p : points) {
    cells.emplace(static_cast<int>(std::ldexp(p.x, a)), static_cast<int>(std::ldexp(p.y, b)));
  }
  return cells.size();
}

TEST(LightSet, EachOfFourLightsGetsANetOfItsOwn) {
  const LightSet lights(std::vector<Light>(4, ConstantEnvironment{{1, 1, 1}}));
  std::array<std::vector<Vec2f>, 4> points;
  for (std::uint64_t i = 0; i < 64; ++i) {
    const auto choice = lights.choose(SobolSampler(1, 2, i).next_2d());
    points.at(choice.light).push_back(choice.u);
  }
  for (const std::vector<Vec2f>& of_light : points) {
    ASSERT_EQ(of_light.size(), 16u);
    for (int a = 0; a <= 4; ++a) EXPECT_EQ(cells_hit(of_light, a, 4 - a), 16u) << a;
  }
}

TEST(LightSet, AChoiceAmongAThousandLeavesAllDigitsToAimWith) {
  // Where 14 of 24 digits are left, two of 1,000 points agree in them about 30 times, and in 24 of
  // them 0.03 times.
  const LightSet lights(std::vector<Light>(1024, ConstantEnvironment{{1, 1, 1}}));
  Pcg32 random(1, 0, 0);
  std::set<float> on_lights;
  constexpr std::size_t kPoints = 1000;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const auto choice = lights.choose(random.next_2d());
    EXPECT_GE(choice.u.x, 0.0f);
    EXPECT_LT(choice.u.x, 1.0f);
    on_lights.insert(choice.u.x);
  }
  EXPECT_GE(on_lights.size(), kPoints - 3);
}

TEST(LightSet, NothingIsSampledFromBehindAOneSidedLight) {
  const Vec3<double> behind{0, 0, 10};
  int one_sided = 0;
  for (const Light& light : one_of_each()) {
    if (std::holds_alternative<ConstantEnvironment>(light) ||
        std::holds_alternative<SunAndSky>(light) || std::holds_alternative<SphereLight>(light)) {
      continue;
    }
    ++one_sided;
    EXPECT_FALSE(sample(light, behind, Vec2<double>{0.3, 0.6})) << light.index();
    EXPECT_EQ(pdf(light, behind, Vec3<double>{0, 0, -1}), 0) << light.index();
  }
  EXPECT_EQ(one_sided, 3);  // rectangle, disk and triangle
}

/// How a rectangle is seen from the origin, along its sides x and y and its distance z.
struct Seen {
  double x, y, width, height, z;

  template <class Angle>
  Vec3d sample(const Vec2d& u) const {
    const SphericalRectangle<Angle> rectangle({x, y, z}, {width, 0, 0}, {0, height, 0}, {0, 0, 1});
    return vec_cast<double>(rectangle.sample({static_cast<Angle>(u.x), static_cast<Angle>(u.y)}));
  }
};

/// Sides from 0.01 to 1,000 distances, and the foot of the distance from within to 10 sides off.
Seen random_rectangle(Pcg32& random) {
  const auto power_of_ten = [&](float low, float high) {
    return std::pow(10.0, static_cast<double>(low + (high - low) * random.next_1d()));
  };
  const double width = power_of_ten(-2, 3), height = power_of_ten(-2, 3);
  const auto sideways = [&] {
    return (static_cast<double>(random.next_1d()) - 0.5) * power_of_ten(0, 1.3f) - 0.5;
  };
  const double x = sideways() * width, y = sideways() * height;
  return {x, y, width, height, 1};
}

TEST(SphericalRectangle, AFloatSampleIsThatOfNumbersNearby) {
  // u.x times the solid angle, which has six digits, and the sine and cosine of half of it with an
  // error of 1.2e-7, are an error of u.x of 2e-6 + 2.4e-7/Ω. So the point lies between those of the
  // numbers around. What y is made of in float adds, to first order and all of one sign, 23·2⁻²⁴ in
  // 1 ± k each and 27·2⁻²⁴ in what they are multiplied with: 50·2⁻²⁴ of the distance.
  Pcg32 random(1, 0, 0);
  for (int i = 0; i < 20'000; ++i) {
    const Seen seen = random_rectangle(random);
    const SphericalRectangle<double> exact({seen.x, seen.y, seen.z}, {seen.width, 0, 0},
                                           {0, seen.height, 0}, {0, 0, 1});
    if (exact.solid_angle() < kSmallestSolidAngle) continue;  // sampled by area
    const double off_x = 2e-6 + 2.4e-7 / exact.solid_angle(), off_y = 0x1p-22;
    const Vec2f drawn = random.next_2d();
    const Vec2d u{static_cast<double>(drawn.x), static_cast<double>(drawn.y)};
    const auto around = [](double a, double off) {
      return std::array{std::max(a - off, 0.0), std::min(a + off, 1.0)};
    };
    Vec3d low{1e9, 1e9, 0}, high{-1e9, -1e9, 0};
    for (const double a : around(u.x, off_x)) {
      for (const double b : around(u.y, off_y)) {
        const Vec3d p = seen.sample<double>({a, b});
        low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
      }
    }
    const Vec3d p = seen.sample<float>(u);
    const double rounding = 50 * 0x1p-24 * length(p);
    ASSERT_TRUE(p.x >= low.x - rounding && p.x <= high.x + rounding)
        << i << ": x " << p.x << " outside " << low.x << " … " << high.x << ", " << seen.x << ' '
        << seen.width << ' ' << seen.height << ", solid angle " << exact.solid_angle();
    ASSERT_TRUE(p.y >= low.y - rounding && p.y <= high.y + rounding)
        << i << ": y " << p.y << " outside " << low.y << " … " << high.y << ", " << seen.y << ' '
        << seen.width << ' ' << seen.height << ", solid angle " << exact.solid_angle();
  }
}

TEST(SphereLight, SolidAngleIsRightToSixDigitsInFloatHoweverSmallTheCone) {
  // pdf_w is the reciprocal of the solid angle 2π (1 − √(1 − R²/d²)), here in long double with
  // 1 − √(1 − x) = x/(1 + √(1 − x)). d and R are powers of two, exact in float.
  for (int exponent = -23; exponent <= -1; ++exponent) {
    const float radius = std::ldexp(1.0f, exponent);
    const SphereLight light{{0, 0, 1}, radius, false, {1, 1, 1}};
    const long double x = sqr(static_cast<long double>(radius));
    const long double solid_angle = 2 * pi<long double>() * x / (1 + std::sqrt(1 - x));
    const float pdf_w = light.pdf(Vec3f{}, Vec3f{0, 0, 1});
    EXPECT_NEAR(static_cast<double>(static_cast<long double>(pdf_w) * solid_angle), 1, 1e-6)
        << "R/d = 2^" << exponent;
    const auto sample = light.sample(Vec3f{}, Vec2f{0.5f, 0.25f});
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->pdf_w, pdf_w);
  }
}

TEST(SphereLight, TheFormulaWithOneMinusCosineWouldFail) {
  const float radius = 0x1.8p-12f;
  const float cos_max = std::sqrt(1 - radius * radius);
  const double naive = static_cast<double>(1 - cos_max);
  EXPECT_GT(std::abs(naive / (0.5 * 0x1.8p-12 * 0x1.8p-12) - 1), 0.05);
}

TEST(SphereLight, DistanceToTheSampledPointDoesNotCancel) {
  const SphereLight light{{0, 0, 1}, 0x1p-12f, false, {1, 1, 1}};
  for (const float u : {0.0f, 0.25f, 0.5f, 0.75f, 1 - 0x1p-24f}) {
    const auto sample = light.sample(Vec3f{}, Vec2f{u, 0.0f});
    ASSERT_TRUE(sample);
    EXPECT_GE(sample->distance, 1 - 0x1p-12f);
    EXPECT_LE(sample->distance, 1.0f);
    EXPECT_GE(sample->cos_light, 0.0f);
  }
}

}  // namespace
}  // namespace plumbline::renderer
