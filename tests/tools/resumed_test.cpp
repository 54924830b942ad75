#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <plumbline/output/checkpoint.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/load_scene.h>

/// A render that is stopped, kept in a file and gone on with is the one that never stopped.
namespace plumbline::tests {
namespace {

using renderer::PixelMoments;
using renderer::RenderOptions;
using renderer::RenderResult;
using renderer::RenderState;

std::vector<unsigned char> bits_of(const RenderResult& result) {
  const std::vector<PixelMoments>& pixels = result.film.pixels();
  std::vector<unsigned char> bits(pixels.size() * sizeof(PixelMoments));
  std::memcpy(bits.data(), pixels.data(), bits.size());
  return bits;
}

/// A scene with one of the settings that samples are dealt out by.
class Resumed : public testing::Test {
 protected:
  Resumed()
      : scene_(renderer::make_scene(renderer::load_scene(
            source_file("analytic/scenes/glass_sphere.xml"), {}, renderer::FilmSize{96, 72}))),
        shallow_(renderer::make_scene(renderer::load_scene(
            source_file("analytic/scenes/sphere_light.xml"), {}, renderer::FilmSize{24, 16}))) {
    options_.samples_per_pixel = 12;
    options_.threads = 2;
    options_.seed = run_seed();
  }

  /// Stops after so many looks, one to each tile and slice; keeps the state in a file, and goes on
  /// from what the file holds.
  /// @return the result, after how many stops
  RenderResult stopped_again_and_again(const renderer::Scene& scene, int& stops) {
    std::mt19937 random(static_cast<unsigned>(check_seed("stops") + static_cast<unsigned>(stops)));
    RenderOptions options = options_;
    options.interruptions.slice = 0;
    std::atomic<int> looks = 0;
    options.interruptions.stop = [&] { return --looks < 0; };
    options.interruptions.keep = [&](const RenderState& state, bool is_last) {
      if (is_last) output::write_checkpoint(scratch_ / "state", {{"seed", "1"}}, state);
    };
    for (;;) {
      looks = std::uniform_int_distribution(0, 14)(random);
      RenderResult result = render(scene, options);
      if (!result.stopped) return result;
      ++stops;
      options.interruptions.from =
          std::make_shared<const RenderState>(output::read_checkpoint(scratch_ / "state").state);
    }
  }

  /// @return  number of stops
  int expect_the_same(const renderer::Scene& scene) {
    const RenderResult whole = render(scene, options_);
    int stops = 0;
    // How often a render stops is up to its threads, too: about eight times.
    for (int i = 0; i < 10; ++i) {
      const RenderResult result = stopped_again_and_again(scene, stops);
      EXPECT_EQ(bits_of(result), bits_of(whole));
      EXPECT_EQ(result.bsdf_counts, whole.bsdf_counts);
      EXPECT_EQ(result.samples_per_pixel, whole.samples_per_pixel);
      EXPECT_EQ(result.counters.camera_rays, whole.counters.camera_rays);
      EXPECT_EQ(result.counters.shadow_rays, whole.counters.shadow_rays);
      EXPECT_EQ(result.counters.rejected, whole.counters.rejected);
    }
    return stops;
  }

  const ScratchDirectory scratch_;
  renderer::Scene scene_, shallow_;
  RenderOptions options_;
};

TEST_F(Resumed, AtMoreThanAHundredMomentsIsTheSameBitForBit) {
  int stops = expect_the_same(scene_);
  options_.path.strategy = renderer::Strategy::one_sample;  // one path after the other
  stops += expect_the_same(scene_);
  options_.path.strategy = renderer::Strategy::mis;
  options_.sampler = renderer::SamplerType::sobol;
  options_.replicates = 4;
  stops += expect_the_same(scene_);
  EXPECT_GE(stops, 100);
}

TEST_F(Resumed, AdaptiveIsTheSameBitForBit) {
  options_.adaptive = true;
  options_.samples_per_pixel = 50;
  EXPECT_GE(expect_the_same(shallow_), 8);
  options_.sampler = renderer::SamplerType::sobol;
  options_.replicates = 4;
  EXPECT_GE(expect_the_same(shallow_), 8);
  const std::vector<std::uint32_t> drawn = render(shallow_, options_).drawn;
  EXPECT_LT(*std::min_element(drawn.begin(), drawn.end()),
            *std::max_element(drawn.begin(), drawn.end()));
  options_.relative_error = 0.01;
  options_.samples_per_pixel = 1024;
  EXPECT_GE(expect_the_same(shallow_), 8);
}

TEST_F(Resumed, StopsAtTheSameErrorAsARenderThatNeverStopped) {
  options_.path.strategy = renderer::Strategy::bsdf;
  options_.samples_per_pixel = 1024;
  options_.relative_error = 0.2;  // a hundredth of one sample's variance, about
  EXPECT_GE(expect_the_same(shallow_), 8);
  const RenderResult whole = render(shallow_, options_);
  EXPECT_GT(whole.samples_per_pixel, 8u);
  EXPECT_LT(whole.samples_per_pixel, 1024u);
}

/// Pixels that have more samples than a look had, as where a slice was cut, are no look.
TEST_F(Resumed, BetweenTwoLooksAtTheErrorDoesNotLookAgain) {
  options_.samples_per_pixel = 9;
  RenderState at_8, at_9;
  RenderOptions kept = options_;
  kept.interruptions.slice = 0;  // one sample of each pixel at a time
  kept.interruptions.keep = [&](const RenderState& state, bool) {
    if (state.least_drawn() == 8) at_8 = state;
    if (state.least_drawn() == 9) at_9 = state;
  };
  render(shallow_, kept);
  RenderState between = at_8;
  for (std::size_t i = 0; i < between.drawn.size(); ++i) {
    // Each pixel whose own error fell: what is there seems better than it was at the look.
    const auto error = [i](const RenderState& state) {
      const PixelMoments& pixel = state.moments[i];
      const double mean = luminance(pixel.mean);
      return luminance(pixel.variance()) / pixel.count / (mean * mean + 0.01);
    };
    if (!(error(at_9) < error(at_8))) continue;
    between.drawn[i] = 9;
    between.moments[i] = at_9.moments[i];
  }
  const double limit = (at_8.film().relative_error() + between.film().relative_error()) / 2;
  ASSERT_LT(between.film().relative_error(), limit);
  options_.samples_per_pixel = 16;
  options_.relative_error = limit;
  EXPECT_FALSE(is_good_enough(at_8, options_));
  EXPECT_FALSE(is_good_enough(between, options_));
  options_.interruptions.from = std::make_shared<const RenderState>(between);
  EXPECT_EQ(render(shallow_, options_).samples_per_pixel, 16u);
}

TEST_F(Resumed, WithAnAllocationIsTheSameBitForBit) {
  options_.path.max_depth = 2;
  options_.allocation.emplace();
  options_.allocation->iterations = 3;
  options_.samples_per_pixel = 60;
  EXPECT_GE(expect_the_same(shallow_), 8);
}

/// The same states with a fault in each: what must be kept for the bits to be the same.
TEST_F(Resumed, IsAnotherImageWhereTheStateIsNotKeptWhole) {
  options_.sampler = renderer::SamplerType::sobol;
  options_.replicates = 4;
  const auto whole = bits_of(render(scene_, options_));
  RenderState kept;
  RenderOptions half = options_;
  half.interruptions.slice = 0;
  int looks = 8;
  half.threads = 1;
  half.interruptions.stop = [&] { return --looks < 0; };
  half.interruptions.keep = [&](const RenderState& state, bool) { kept = state; };
  ASSERT_TRUE(render(scene_, half).stopped);
  const auto resumed = [&](const RenderState& state) {
    RenderOptions options = options_;
    options.interruptions.from = std::make_shared<const RenderState>(state);
    return bits_of(render(scene_, options));
  };
  EXPECT_EQ(resumed(kept), whole);
  RenderState forgot = kept;
  forgot.drawn.assign(forgot.drawn.size(), 0);
  EXPECT_NE(resumed(forgot), whole);
  RenderState rounded = kept;
  for (PixelMoments& m : rounded.moments) {
    m.mean = renderer::rgb_cast<double>(renderer::rgb_cast<float>(m.mean * (1 / 3.0))) * 3.0;
  }
  EXPECT_NE(resumed(rounded), whole);
}

TEST_F(Resumed, FromAFileThatIsTornOrChangedIsRefused) {
  RenderState state = fresh_state(3, 2, options_);
  state.drawn = {1, 1, 1, 0, 0, 0};
  output::write_checkpoint(scratch_ / "state", {{"seed", "1"}}, state);
  const std::string text = scratch_.read("state");
  EXPECT_EQ(output::read_checkpoint(scratch_ / "state").state.drawn, state.drawn);
  for (std::size_t i = 0; i < text.size(); i += 5) {
    scratch_.write("state", text.substr(0, i));
    EXPECT_THROW(output::read_checkpoint(scratch_ / "state"), renderer::InputError) << i;
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    scratch_.write("state", changed);
    EXPECT_THROW(output::read_checkpoint(scratch_ / "state"), renderer::InputError) << i;
  }
  scratch_.write("state", text + "x");
  EXPECT_THROW(output::read_checkpoint(scratch_ / "state"), renderer::InputError);
}

}  // namespace
}  // namespace plumbline::tests
