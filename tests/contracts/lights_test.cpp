#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/verify/autodiff.h>
#include <plumbline/verify/mean.h>
#include <plumbline/verify/pair.h>

#include "light_examples.h"
#include "many_lights.h"

/// Every light of the renderer through the contract battery, driven by the variant's type list.
namespace plumbline::tests {
namespace {

using renderer::Vec2;
using renderer::Vec3;
using verify::SamplingPair;

/// The light as a sampling pair of directions at the reference point, in the scalar T.
template <class T>
SamplingPair light_pair(const LightExample& example) {
  const Vec3<T> reference = renderer::vec_cast<T>(example.reference);
  SamplingPair pair;
  pair.name = "light/" + example.name;
  pair.domain = verify::Domain::sphere();
  pair.epsilon = std::is_same_v<T, float> ? 0x1p-24 : 0x1p-53;
  pair.sample = [=](const verify::Uniforms& u) -> std::optional<verify::SampleRecord> {
    const auto s = renderer::sample(example.light, reference,
                                    Vec2<T>{static_cast<T>(u[0]), static_cast<T>(u[1])});
    if (!s) return std::nullopt;
    verify::SampleRecord result;
    result.x = verify::to_vec3(s->wi);
    result.pdf = static_cast<double>(s->pdf_w);
    result.mass = static_cast<double>(s->mass);
    return result;
  };
  pair.pdf = [=](const verify::Vec3& wi) {
    return static_cast<double>(
        renderer::pdf(example.light, reference, verify::from_vec3<Vec3<T>>(wi)));
  };
  return pair;
}

/// The same pair on a domain where its density does not jump.
SamplingPair evened(SamplingPair pair, const EvenChart& chart) {
  pair.domain = verify::Domain::surface(chart.from_square, chart.to_square, chart.solid_angle);
  return pair;
}

class Lights : public testing::TestWithParam<LightExample> {};

TEST_P(Lights, KeepTheContract) {
  const SamplingPair pair = light_pair<double>(GetParam());
  verify::ContractOptions options = contract_options(pair.name);
  if (GetParam().pole) options.mass_tolerance.reset();
  const auto& chart = GetParam().chart;
  int without_samples = 0;
  for (verify::CheckResult r : chart ? check_pointwise(pair, options) : check_pair(pair, options)) {
    // From behind a light gives no sample, and the check says that nothing was tested.
    if (r.kind == verify::CheckKind::samples) {
      ++without_samples;
      r.expected = verify::Verdict::inconclusive;
    }
    expect_verdict(r);
  }
  EXPECT_EQ(without_samples, GetParam().seen == Seen::nothing ? 1 : 0);
  if (chart) {
    expect_verdict(check_integral(evened(pair, *chart), options));
    expect_verdict(check_chi_square(evened(pair, *chart), options));
  }
}

TEST_P(Lights, SampleTheirDensityInFloatAsRendered) {
  SamplingPair pair = light_pair<float>(GetParam());
  pair.name += "/float";
  const verify::ContractOptions options = contract_options(pair.name);
  for (const verify::CheckResult& r : check_pointwise(pair, options)) expect_verdict(r);
  if (GetParam().chart) pair = evened(pair, *GetParam().chart);
  expect_verdict(check_chi_square(pair, options));
}

TEST_P(Lights, PdfIsTheInverseJacobianOfSample) {
  const LightExample& example = GetParam();
  const auto sample = [&](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    auto s =
        renderer::sample(example.light, renderer::vec_cast<T>(example.reference), Vec2<T>{u, T(v)});
    return s && !s->is_atom() ? std::optional<Vec3<T>>(s->wi) : std::nullopt;
  };
  const auto pdf = [&](const verify::Vec3& wi) {
    return renderer::pdf(example.light, renderer::vec_cast<double>(example.reference),
                         verify::from_vec3<renderer::Vec3d>(wi));
  };
  verify::AutodiffOptions options;
  options.seed = check_seed(example.name);
  verify::CheckResult r = check_jacobian_autodiff("light/" + example.name, verify::Domain::sphere(),
                                                  sample, pdf, options);
  if (example.seen == Seen::density) {
    // Of an inward sphere of radius 2 at a distance of 3, the nearest sixth faces away: of half of
    // the points, which are even, a sixth is lost, and of those next to the ends of u a half.
    EXPECT_GE(r.samples, 6'000u);
  } else {
    EXPECT_EQ(r.samples, 0u) << "an atom has no Jacobian, and from behind there is nothing";
    r.expected = verify::Verdict::inconclusive;
  }
  expect_verdict(r);
}

INSTANTIATE_TEST_SUITE_P(All, Lights, testing::ValuesIn(all_light_examples()),
                         [](const testing::TestParamInfo<LightExample>& example) {
                           std::string name = example.param.name;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

class LightSelection : public testing::TestWithParam<renderer::LightSelection> {};

TEST_P(LightSelection, IsADiscretePairForAnyNumberOfLights) {
  for (const std::uint32_t count : {1u, 2u, 5u, 1000u}) {
    const renderer::LightSet lights = light_set(count, GetParam());
    std::string name = "light selection/";
    name.append(renderer::name(GetParam())).append("/").append(std::to_string(count));
    const verify::ContractOptions options = contract_options(name);
    const auto pair = verify::sampling_pair<int>(
        name, verify::Domain::discrete(count),
        [&](float u) {
          return static_cast<int>(lights.choose(Vec2<float>{u, 0.5f}).light);
        },
        [&](int i) { return lights.pmf<float>(static_cast<std::uint32_t>(i)); });
    for (const verify::CheckResult& r : check_pair(pair, options)) expect_verdict(r);
  }
}

/// Solid angle of the cone of light `i`, as the mean of 1/pdf over samples that fall into it.
///
/// @param pdf  of a direction, 0 outside of every light
template <class Pdf>
void expect_solid_angle(const std::string& subject, const renderer::LightSet& lights,
                        std::uint32_t count, std::uint32_t i, const Pdf& pdf,
                        verify::Verdict expected = verify::Verdict::pass) {
  verify::MeanOptions options;
  options.subject = subject;
  const double h = one_minus_cos(i);
  options.reference = 2 * renderer::pi<double>() * h;
  options.tolerance = 0.01;
  // By power the widest light, which is the dimmest, is chosen so seldom that cv is 4: four million
  // samples leave one run in six undecided.
  const double cv = std::sqrt(variance_of_solid_angle(lights, count, i)) / options.reference;
  options.max_samples =
      std::max<std::uint64_t>(1 << 17, verify::samples_to_decide(options.tolerance, cv));
  options.expected = expected;
  options.seed = check_seed(subject);
  expect_verdict(check_mean(options, [&](std::uint64_t first, std::uint64_t samples) {
    verify::Moments moments;
    verify::Random random(options.seed, first);
    for (std::uint64_t n = 0; n < samples; ++n) {
      const auto s =
          lights.sample(Vec3<double>{}, Vec2<double>{random.uniform(), random.uniform()});
      moments.add(s && 1 - s->wi.z <= h * (1 + 1e-6) ? 1 / pdf(s->wi) : 0.0);
    }
    return moments;
  }));
}

/// The density of a direction is the sum over the lights that lie along it; what MIS asks for is
/// the share of the one that is hit.
TEST_P(LightSelection, DensityOfADirectionIsTheSumOverAllLights) {
  for (const std::uint32_t count : {1u, 2u, 5u}) {
    const renderer::LightSet lights = light_set(count, GetParam());
    std::string subject = "overlapping lights/";
    subject.append(renderer::name(GetParam())).append("/").append(std::to_string(count));
    const auto pdf_of = [&](std::uint32_t i, const Vec3<double>& wi) {
      return lights.pmf<double>(i) * renderer::pdf(lights[i], Vec3<double>{}, wi);
    };
    const auto sum = [&](const Vec3<double>& wi) {
      double result = 0;
      for (std::uint32_t i = 0; i < count; ++i) result += pdf_of(i, wi);
      return result;
    };
    const std::uint32_t narrowest = count - 1;
    expect_solid_angle(subject + "/widest", lights, count, 0, sum);
    expect_solid_angle(subject + "/narrowest", lights, count, narrowest, sum);
    if (count == 1) continue;
    const auto one_only = [&](const Vec3<double>& wi) { return pdf_of(narrowest, wi); };
    expect_solid_angle("control/" + subject + ", one light's density", lights, count, narrowest,
                       one_only, verify::Verdict::fail);
  }
}

INSTANTIATE_TEST_SUITE_P(All, LightSelection, testing::ValuesIn(renderer::kLightSelections),
                         [](const auto& selection) {
                           return std::string(renderer::name(selection.param));
                         });

TEST(DiscreteDistribution, IsADiscretePairAndLeavesAUniformNumberBehind) {
  // One choice is ten million times less likely than another, one is impossible.
  const std::vector<double> weights{3, 0, 1e-7, 1, 2};
  const renderer::DiscreteDistribution distribution(weights);
  EXPECT_EQ(distribution.pmf<float>(1), 0);
  EXPECT_EQ(distribution.pmf<float>(2), 0x1p-24f);
  EXPECT_EQ(distribution.pmf<float>(5), 0);
  const verify::ContractOptions options = contract_options("discrete distribution");
  const auto choice = verify::sampling_pair<int>(
      "discrete distribution/choice", verify::Domain::discrete(5),
      [&](float u) { return static_cast<int>(distribution.sample(u).index); },
      [&](int i) { return distribution.pmf<float>(static_cast<std::uint32_t>(i)); });
  for (const verify::CheckResult& r : check_pair(choice, options)) expect_verdict(r);

  auto rest = verify::sampling_pair<float>(
      "discrete distribution/rest", verify::Domain::interval(0, 1),
      [&](float u) { return distribution.sample(u).u; }, [](float) { return 1.0f; });
  rest.many_to_one = true;  // each choice leads to every rest
  for (const verify::CheckResult& r : check_pair(rest, options)) expect_verdict(r);
}

TEST(DiscreteDistribution, ChoosesAsOftenAsItSays) {
  // Counted over every number that the generator can return.
  const std::vector<double> weights{1e-9, 5, 0, 1, 1e-3, 0};
  const renderer::DiscreteDistribution distribution(weights);
  std::vector<std::uint32_t> counts(weights.size());
  for (std::uint32_t i = 0; i < 1u << 24; ++i) {
    const auto choice = distribution.sample(renderer::to_unit(i << 8));
    ++counts[choice.index];
    ASSERT_TRUE(choice.u >= 0 && choice.u < 1);
  }
  for (std::uint32_t i = 0; i < counts.size(); ++i) {
    EXPECT_EQ(static_cast<float>(counts[i]) * 0x1p-24f, distribution.pmf<float>(i)) << i;
  }
  // All black is no reason to choose none.
  const renderer::DiscreteDistribution black(std::vector<double>{0, 0});
  EXPECT_EQ(black.pmf<float>(0), 0.5f);
}

TEST(SunAndSky, DensitiesOfConeAndRestAddUpToOne) {
  // 2π (1 − cosθ) of the cone and 2π (1 + cosθ) of the rest, to the last digit.
  for (const float h : {0x1p-20f, 1e-5f, 0.25f, 1.0f}) {
    const renderer::SunAndSky light{{0, 0, 1}, h, kRadiance, kRadiance};
    const double in = light.pdf(renderer::Vec3d{}, renderer::Vec3d{0, 0, 1});
    const double out = light.pdf(renderer::Vec3d{}, renderer::Vec3d{0, 0, -1});
    const double cone = 2 * renderer::pi<double>() * static_cast<double>(h);
    EXPECT_NEAR(in * cone, 0.5, 1e-15);
    EXPECT_NEAR(out * (4 * renderer::pi<double>() - cone), 0.5, 1e-15);
  }
}

TEST(EnvironmentMap, PixelsCoverTheSphereInAnyNumberOfRows) {
  // The density of each pixel times its solid angle, 2π/width (cosθ_top − cosθ_bottom).
  for (const int rows : {1, 2, 3, 5, 64}) {
    constexpr int kColumns = 7;
    std::vector<renderer::Rgbf> pixels;
    for (int i = 0; i < kColumns * rows; ++i) {
      pixels.push_back(kRadiance * static_cast<float>(1 + i * i % 13));
    }
    const renderer::EnvironmentMap map{
        std::make_shared<renderer::EnvironmentTable>(kColumns, rows, pixels, false)};
    double sum = 0;
    for (int row = 0; row < rows; ++row) {
      const double step = renderer::pi<double>() / rows;
      const double solid_angle = 2 * renderer::pi<double>() / kColumns *
                                 (std::cos(row * step) - std::cos((row + 1) * step));
      for (int column = 0; column < kColumns; ++column) {
        const double theta = (row + 0.5) * step;
        const double phi = (column + 0.5) * 2 * renderer::pi<double>() / kColumns;
        const renderer::Vec3d wi{std::sin(theta) * std::sin(phi), std::cos(theta),
                                 -std::sin(theta) * std::cos(phi)};
        sum += map.pdf(renderer::Vec3d{}, wi) * solid_angle;
        EXPECT_EQ(map.radiance_along(renderer::vec_cast<float>(wi)).g,
                  pixels[static_cast<std::size_t>(row * kColumns + column)].g);
      }
    }
    EXPECT_NEAR(sum, 1, 1e-12) << rows;
  }
}

/// The small map as a pair on its even chart, with a fault put in.
SamplingPair faulty_map(const std::string& fault) {
  const LightExample example = LightExamples<renderer::EnvironmentMap>::all().front();
  SamplingPair pair = evened(light_pair<double>(example), *example.chart);
  pair.name = "control/environment map, " + fault;
  return pair;
}

double row_of(const verify::Vec3& wi) {
  return std::floor(std::acos(wi[1]) / renderer::pi<double>() * kSmallMapHeight);
}

/// At a user's effort: the gate's shorter check may pass faults as small as these. It is the
/// samples that must say so: an integral of the density that is off would fail the check without
/// them.
void expect_chi_square_fails(const SamplingPair& pair) {
  verify::ContractOptions options;
  options.seed = check_seed(pair.name);
  verify::CheckResult r = check_chi_square(pair, options);
  r.expected = verify::Verdict::fail;
  expect_verdict(r);
  EXPECT_NE(r.reason.find("bins, the one around"), std::string::npos) << r.reason;
}

/// Share of the light in a row of the small map, in units of its own.
double mass_of_row(int row) {
  const std::vector<double> greys = small_map_greys();
  const double step = renderer::pi<double>() / kSmallMapHeight;
  double sum = 0;
  for (int i = row * kSmallMapWidth; i < (row + 1) * kSmallMapWidth; ++i) {
    sum += greys[static_cast<std::size_t>(i)];
  }
  return sum * (std::cos(row * step) - std::cos((row + 1) * step));
}

TEST(EnvironmentMap, ADensityOffInOneRowOfPixelsFails) {
  // What one row has too much another lacks: the integral stays.
  SamplingPair pair = faulty_map("one row 4 % off");
  const double less = 0.04 * mass_of_row(2) / mass_of_row(3);
  pair.pdf = [right = pair.pdf, less](const verify::Vec3& wi) {
    const double row = row_of(wi);
    return right(wi) * (row == 2 ? 1.04 : row == 3 ? 1 - less : 1);
  };
  expect_chi_square_fails(pair);
}

TEST(EnvironmentMap, ADensityWithoutTheSineOfItsRowFails) {
  SamplingPair pair = faulty_map("pdf without sinθ");
  pair.pdf = [right = pair.pdf](const verify::Vec3& wi) {
    const double step = renderer::pi<double>() / kSmallMapHeight;
    const double row = row_of(wi);
    const double exact = std::cos(row * step) - std::cos((row + 1) * step);
    return right(wi) * exact / (2.0 / kSmallMapHeight);
  };
  expect_chi_square_fails(pair);
}

TEST(EnvironmentMap, SamplesThatFollowLuminanceWithoutSolidAngleFail) {
  // Weights that undo the solid angle by which rows are chosen; the density stays right.
  SamplingPair pair = faulty_map("rows without their solid angle");
  std::vector<renderer::Rgbf> pixels;
  const std::vector<double> greys = small_map_greys();
  for (std::size_t i = 0; i < greys.size(); ++i) {
    const double step = renderer::pi<double>() / kSmallMapHeight;
    const double row = static_cast<double>(i / kSmallMapWidth);
    pixels.push_back(kRadiance * static_cast<float>(greys[i] / (std::cos(row * step) -
                                                                std::cos((row + 1) * step))));
  }
  LightExample wrong = LightExamples<renderer::EnvironmentMap>::all().front();
  wrong.light = renderer::EnvironmentMap{std::make_shared<renderer::EnvironmentTable>(
      kSmallMapWidth, kSmallMapHeight, std::move(pixels), false)};
  pair.sample = light_pair<double>(wrong).sample;
  expect_chi_square_fails(pair);
}

TEST(SunAndSky, ASunChosenMoreOftenThanStatedFails) {
  const LightExample example = LightExamples<renderer::SunAndSky>::all().front();
  SamplingPair pair = evened(light_pair<double>(example), *example.chart);
  pair.name = "control/sun and sky, sun chosen too often";
  pair.sample = [right = pair.sample](const verify::Uniforms& u) {
    verify::Uniforms more = u;
    more[0] = std::pow(u[0], 1.02);  // ½ becomes 0.493: 1 % more of the sun
    return right(more);
  };
  expect_chi_square_fails(pair);
}

TEST(Lights, TheBatteryFailsAreaInThePlaceOfItsInverse) {
  // Seen by nobody who tests with unit areas: the rectangle has 40 m².
  SamplingPair pair = light_pair<float>(light_example("RectangleLight/large"));
  EXPECT_NE(check_pair(pair).verdict(), verify::Verdict::fail);
  pair.pdf = [right = pair.pdf](const verify::Vec3& wi) { return right(wi) * 40 * 40; };
  EXPECT_EQ(check_pair(pair).verdict(), verify::Verdict::fail);
}

TEST(Lights, AnAreaDensityTakenForASolidAngleDensityFails) {
  SamplingPair pair = light_pair<float>(light_example("RectangleLight/beside"));
  pair.name = "control/rectangle light, density by area";
  pair.pdf = [right = pair.pdf](const verify::Vec3& wi) {
    return right(wi) > 0 ? 1 / (2 * 1.5) : 0;  // of 2 m by 1.5 m
  };
  expect_chi_square_fails(pair);
}

}  // namespace
}  // namespace plumbline::tests
