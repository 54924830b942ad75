#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <plumbline/renderer/adaptive/sample_counts.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/loop/render_loop.h>
#include <plumbline/verify/mean.h>

/// Counts of samples that follow the noise of neighbours: how many they are, and that the image
/// stays unbiased.
namespace plumbline::tests {
namespace {

using renderer::Film;
using renderer::LoopResult;
using renderer::PathCounters;
using renderer::PixelMoments;
using renderer::PixelSampler;
using renderer::RenderState;
using renderer::Rgbf;
using renderer::SampleCounts;
using renderer::SampleNeed;
using renderer::SamplerType;
using renderer::SamplingOptions;

constexpr int kSide = 8;

renderer::Camera camera(int width, int height) {
  renderer::CameraDescription description;
  description.width = width;
  description.height = height;
  return {description, {}};
}

/// A pixel's moments of two samples a, b.
PixelMoments moments_of(float a, float b) {
  PixelMoments moments;
  moments.add(Rgbf{a, a, a});
  moments.add(Rgbf{b, b, b});
  return moments;
}

TEST(SampleNeeds, AreThoseOfThePixelsAroundByTheirFormula) {
  Film film(3, 1);
  film.pixels() = {moments_of(1, 3), moments_of(5, 105), moments_of(2, 2)};
  const std::vector<SampleNeed> needs = needs_from_neighbours(film);
  // Of the middle one the neighbours have deviations √2 and 0, means 2 and 2.
  const double middle = (0.5 * std::sqrt(2.0) * 0.5 * std::sqrt(2.0)) / (4 + 0.01);
  EXPECT_NEAR(needs[1], 1024 * 0.5 * std::log2(middle), 1);
  // Of the left one the middle is one pixel away, the right one two.
  const double near = std::exp(-1 / 1.28), far = std::exp(-4 / 1.28);
  const double mean = (near * 55 + far * 2) / (near + far);
  const double deviation = near * std::sqrt(5000.0) / (near + far);
  const double between = (near * 55 * 55 + far * 4) / (near + far) - mean * mean;
  const double left = (deviation * deviation + between) / (mean * mean + 0.01);
  EXPECT_NEAR(needs[0], 1024 * 0.5 * std::log2(left), 1);
}

TEST(SampleNeeds, OfAPixelAreNotItsOwn) {
  Film film(kSide, kSide);
  renderer::Pcg32 random(run_seed(), 0, 0);
  for (PixelMoments& pixel : film.pixels()) pixel = moments_of(random.next_1d(), random.next_1d());
  const std::vector<SampleNeed> before = needs_from_neighbours(film);
  for (std::size_t i = 0; i < film.pixels().size(); ++i) {
    Film other = film;
    other.pixels()[i] = moments_of(100, 900);
    const std::vector<SampleNeed> after = needs_from_neighbours(other);
    EXPECT_EQ(after[i], before[i]);
    EXPECT_NE(after, before);
  }
}

TEST(SampleNeeds, OfWhatIsBlackAloneOrBeyondNumbersAreNumbers) {
  constexpr SampleNeed kLeast = -std::numeric_limits<SampleNeed>::max();
  EXPECT_EQ(needs_from_neighbours(Film(1, 1)), std::vector<SampleNeed>{kLeast});
  EXPECT_EQ(needs_from_neighbours(Film(2, 1)), std::vector<SampleNeed>(2, kLeast));
  Film film(2, 1);
  film.pixels()[0].count = 2;
  film.pixels()[0].sum_squares.g = std::numeric_limits<double>::infinity();
  EXPECT_EQ(needs_from_neighbours(film)[1], std::numeric_limits<SampleNeed>::max());
  film.pixels()[0].mean.g = 1e300;  // its square is no number
  EXPECT_EQ(needs_from_neighbours(film)[1], std::numeric_limits<SampleNeed>::max());
}

/// Numbers of all pixels at a level.
std::vector<std::uint32_t> numbers(SampleCounts& counts, std::uint32_t level, std::size_t pixels) {
  counts.set_level(level);
  std::vector<std::uint32_t> all(pixels);
  for (std::size_t i = 0; i < pixels; ++i) all[i] = counts.of(i);
  return all;
}

TEST(SampleCounts, AreSoManyOnAverageAndGrow) {
  constexpr std::size_t kPixels = 20'000;
  constexpr std::uint32_t kPilot = 16;
  std::vector<SampleNeed> needs(kPixels);
  renderer::Pcg32 random(run_seed(), 1, 0);
  for (SampleNeed& need : needs) need = static_cast<SampleNeed>(8192 * random.next_1d() - 4096);
  std::sort(needs.begin(), needs.end());
  SampleCounts counts(needs, kPilot);
  std::vector<std::uint32_t> before(kPixels, 0);
  for (const std::uint32_t level : {1u, 16u, 17u, 40u, 64u, 100u, 1000u, 1'000'000u}) {
    const std::vector<std::uint32_t> now = numbers(counts, level, kPixels);
    const double mean = std::accumulate(now.begin(), now.end(), 0.0) / kPixels;
    EXPECT_LE(mean, std::max(level, kPilot));
    // A step of needs holds 1/8192 of the pixels, and doubles them.
    EXPECT_GE(mean, 0.99 * level);
    EXPECT_TRUE(std::is_sorted(now.begin(), now.end()));
    // Of eight octaves of needs, where none is held down to the pilot or up to the most.
    if (level == 1'000'000u) {
      EXPECT_EQ(now.back(), 256 * now.front());
    }
    for (std::size_t i = 0; i < kPixels; ++i) {
      EXPECT_TRUE(std::has_single_bit(now[i])) << now[i];
      EXPECT_GE(now[i], std::max(before[i], kPilot));
    }
    before = now;
  }
}

TEST(SampleCounts, OfEqualNeedsAreEqual) {
  SampleCounts counts(std::vector<SampleNeed>(9, -32767), 16);
  EXPECT_EQ(numbers(counts, 127, 9), std::vector<std::uint32_t>(9, 64));
  EXPECT_EQ(numbers(counts, 128, 9), std::vector<std::uint32_t>(9, 128));
  // There is an end to what can be counted.
  EXPECT_EQ(numbers(counts, 1u << 31, 9), std::vector<std::uint32_t>(9, 1u << 30));
  SampleCounts none;
  EXPECT_EQ(numbers(none, 100, 3), std::vector<std::uint32_t>(3, 100));
}

/// A pixel's values: 1/p with probability p, else 0; or 1 alone.
class RareLight final : public PixelSampler {
 public:
  RareLight(std::uint64_t seed, int first_noisy_x) : seed_(seed), first_noisy_x_(first_noisy_x) {}

  void sample(int x, int /*y*/, std::uint64_t net, std::uint64_t index, PixelMoments& to) override {
    constexpr float kProbability = 0.05f;
    const bool hit = renderer::Pcg32(seed_, net, index).next_1d() < kProbability;
    const float value = x < first_noisy_x_ ? 1 : hit ? 1 / kProbability : 0.0f;
    to.add(Rgbf{value, value, value});
  }

 private:
  std::uint64_t seed_;
  int first_noisy_x_;
};

LoopResult render_rare_light(const SamplingOptions& options, int first_noisy_x) {
  return run_render_loop(camera(kSide, kSide), options,
                         [&] { return std::make_unique<RareLight>(options.seed, first_noisy_x); });
}

SamplingOptions adaptive_options(std::uint64_t seed) {
  SamplingOptions options;
  options.adaptive = true;
  options.samples_per_pixel = 64;
  options.threads = 1;
  options.seed = seed;
  return options;
}

/// What a scheme that looks at a pixel's own samples would take: more where they were seen to vary.
LoopResult render_by_own_noise(const SamplingOptions& options) {
  RenderState state;
  SamplingOptions pilot = options;
  pilot.samples_per_pixel = pilot_samples(options);
  pilot.interruptions.keep = [&](const RenderState& kept, bool) { state = kept; };
  render_rare_light(pilot, 0);
  const renderer::Film film = state.film();
  for (const PixelMoments& pixel : film.pixels()) {
    const double need = 1024 * 0.5 * std::log2(pixel.variance().g + 1e-3);
    state.needs.push_back(static_cast<SampleNeed>(need));
  }
  SamplingOptions rest = options;
  rest.interruptions.from = std::make_shared<const RenderState>(std::move(state));
  return render_rare_light(rest, 0);
}

verify::CheckResult check_bias(const std::string& subject,
                               LoopResult (*render)(const SamplingOptions&)) {
  verify::MeanOptions options;
  options.subject = subject;
  options.reference = 1;
  options.tolerance = 0.02;
  options.seed = check_seed(subject);
  return check_mean(options, [&](std::uint64_t first, std::uint64_t count) {
    verify::Moments moments;
    for (std::uint64_t i = first; i < first + count; ++i) {
      moments.add(render(adaptive_options(options.seed + i)).film.mean().g);
    }
    return moments;
  });
}

TEST(Adaptive, CountsByTheNoiseOfNeighboursAreUnbiased) {
  expect_verdict(check_bias("adaptive/mean of rare light", [](const SamplingOptions& options) {
    return render_rare_light(options, 0);
  }));
}

TEST(Adaptive, CountsByAPixelsOwnNoiseAreBiased) {
  verify::CheckResult result = check_bias("control/counts by own noise", render_by_own_noise);
  result.expected = verify::Verdict::fail;
  expect_verdict(result);
}

TEST(Adaptive, SamplesGoWhereTheNoiseIs) {
  constexpr int kFirstNoisy = 5;
  for (const SamplerType sampler : {SamplerType::independent, SamplerType::sobol}) {
    SamplingOptions options = adaptive_options(run_seed());
    options.sampler = sampler;
    options.replicates = 4;
    const LoopResult result = render_rare_light(options, kFirstNoisy);
    std::uint64_t all = 0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const std::uint32_t drawn = result.drawn[result.film.index(x, y)];
        all += drawn;
        // Two pixels are looked at each way.
        if (x < kFirstNoisy - 2) {
          EXPECT_EQ(drawn, 16u);
        } else if (x >= kFirstNoisy) {
          EXPECT_GE(drawn, 64u);
        }
        const std::uint32_t count = result.film.at(x, y).count;
        EXPECT_EQ(count, sampler == SamplerType::sobol ? 4u : drawn);
      }
    }
    EXPECT_EQ(result.samples_per_pixel, (all + kSide * kSide / 2) / (kSide * kSide));
    EXPECT_LE(all, 64u * kSide * kSide);
    EXPECT_GE(all, 40u * kSide * kSide);
  }
}

TEST(Adaptive, PilotsAreNetsOfEachReplicate) {
  SamplingOptions options = adaptive_options(1);
  options.sampler = SamplerType::sobol;
  const auto pilot = [&](std::uint32_t replicates) {
    options.replicates = replicates;
    return pilot_samples(options);
  };
  EXPECT_EQ(pilot(1), 16u);
  EXPECT_EQ(pilot(3), 24u);
  EXPECT_EQ(pilot(4), 16u);
  EXPECT_EQ(pilot(16), 16u);
  EXPECT_EQ(pilot(17), 17u);
  options.sampler = SamplerType::independent;
  EXPECT_EQ(pilot(3), 16u);
}

TEST(Adaptive, WithinItsPilotIsNoOther) {
  SamplingOptions options = adaptive_options(7);
  options.samples_per_pixel = 16;
  const LoopResult adaptive = render_rare_light(options, 0);
  EXPECT_EQ(adaptive.drawn, std::vector<std::uint32_t>(kSide * kSide, 16));
}

}  // namespace
}  // namespace plumbline::tests
