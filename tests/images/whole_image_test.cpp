#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/scene_file/load_scene.h>
#include <plumbline/verify/image.h>
#include <plumbline_tests/support.h>
#include "colour_check.h"

/// Whole images against the closed form averaged over each pixel's footprint: mean, tiles and
/// pixels.
namespace plumbline::tests {
namespace {

constexpr analytic::FilmSize kFilm{48, 36};

renderer::Film render_scene(const std::string& scene_name, std::uint32_t samples,
                            std::uint64_t seed) {
  auto description = renderer::load_scene(analytic::scene_file(scene_name));
  description.camera.width = kFilm.width;
  description.camera.height = kFilm.height;
  renderer::RenderOptions options;
  options.path.max_depth = description.integrator.max_depth;
  options.path.rr_depth = description.integrator.rr_depth;
  options.samples_per_pixel = samples;
  options.seed = seed;
  return render(renderer::make_scene(description), options).film;
}

verify::Image rendered(const renderer::Film& film, const Channel& channel) {
  verify::Image image{film.width(), film.height(), {}, {}, {}};
  for (const renderer::PixelMoments& pixel : film.pixels()) {
    image.mean.push_back(pixel.mean.*channel.rendered);
    image.variance.push_back(pixel.variance().*channel.rendered);
    image.count.push_back(pixel.count);
  }
  return image;
}

std::vector<analytic::Colour> exact_pixels(const std::string& scene_name,
                                           const analytic::ParameterValues& overrides = {}) {
  return make_oracle(analytic::known_scene(scene_name), overrides, kFilm)->image();
}

verify::Image exact(const std::vector<analytic::Colour>& pixels, const Channel& channel) {
  verify::Image image{kFilm.width, kFilm.height, {}, {}, {}};
  for (const analytic::Colour& pixel : pixels) image.mean.push_back(pixel.*channel.exact);
  return image;
}

constexpr double kTolerance = 0.005;  // of an image's mean

/// Samples per pixel with which a right image is undecided less than once in 1e7, at night in 4e9.
/// What a pass proves of the mean is its distance from the answer and 3.3 standard errors σ, and
/// the distance exceeds 5.3 σ, 6.3 σ, as seldom as that: 9 σ, 10 σ, with what the skewness guard
/// adds, are to fit the tolerance.
///
/// @param pilot  of independent samples
std::uint32_t samples_to_decide(const renderer::Film& pilot) {
  constexpr double kFewest = 512;
  const double deviations = verify::run_level() < verify::kRunLevel ? 10 : 9;
  const double pixels = static_cast<double>(pilot.pixels().size());
  double samples = kFewest;
  for (const Channel& channel : kChannels) {
    double variance = 0, mean = 0;
    for (const renderer::PixelMoments& pixel : pilot.pixels()) {
      variance += pixel.variance().*channel.rendered / pixels / pixels;
      mean += pixel.mean.*channel.rendered / pixels;
    }
    const double tolerance = kTolerance * mean / deviations;
    samples = std::max(samples, variance / (tolerance * tolerance));
  }
  return static_cast<std::uint32_t>(std::ceil(samples));
}

verify::ImageOptions options_for(const std::string& subject, verify::Verdict expected) {
  verify::ImageOptions options;
  options.subject = subject;
  options.tolerance = kTolerance;
  options.expected = expected;
  options.seed = check_seed(subject);
  return options;
}

class WholeImage : public testing::TestWithParam<std::string> {};

TEST_P(WholeImage, EveryPixelIsTheClosedFormOverItsFootprint) {
  const auto samples =
      samples_to_decide(render_scene(GetParam(), 64, check_seed(GetParam() + "/pilot")));
  const renderer::Film film = render_scene(GetParam(), samples, check_seed(GetParam() + "/image"));
  const std::vector<analytic::Colour> pixels = exact_pixels(GetParam());
  for (const Channel& channel : kChannels) {
    const auto options =
        options_for(GetParam() + "/image/" + std::string(channel.name), verify::Verdict::pass);
    expect_verdict(check_image(options, rendered(film, channel), exact(pixels, channel)).check);
  }
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const analytic::KnownScene& known : analytic::known_scenes()) names.emplace_back(known.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, WholeImage, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

TEST(WholeImageControl, AnAlbedoOffByOnePercentInOneChannelFailsInThatChannel) {
  const std::string subject = "control/furnace_open, green albedo off by 1 %";
  const renderer::Film film = render_scene("furnace_open", 1024, check_seed(subject));
  const auto pixels = exact_pixels("furnace_open", {{"albedo", {0.9, 0.7575, 0.4}}});
  for (const Channel& channel : kChannels) {
    const auto options =
        options_for(subject + "/" + std::string(channel.name),
                    channel.name == "green" ? verify::Verdict::fail : verify::Verdict::pass);
    expect_verdict(check_image(options, rendered(film, channel), exact(pixels, channel)).check);
  }
}

TEST(WholeImageControl, AnImageMovedByOnePixelFailsThoughItsMeanHardlyChanges) {
  const auto options = options_for("control/furnace_open, one pixel aside", verify::Verdict::fail);
  const Channel& green = kChannels[1];
  const verify::Image image = rendered(render_scene("furnace_open", 1024, options.seed), green);
  verify::Image moved = image;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 1; x < image.width; ++x) {
      const auto to = static_cast<std::size_t>(y * image.width + x);
      moved.mean[to] = image.mean[to - 1];
      moved.variance[to] = image.variance[to - 1];
    }
  }
  expect_verdict(check_image(options, moved, exact(exact_pixels("furnace_open"), green)).check);
}

}  // namespace
}  // namespace plumbline::tests
