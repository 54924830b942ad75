#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/scene_file/load_scene.h>
#include <plumbline/verify/image.h>
#include <plumbline_tests/support.h>

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

/// The scenes are grey: one channel says it all.
verify::Image green(const renderer::Film& film) {
  verify::Image image{film.width(), film.height(), {}, {}, {}};
  for (const renderer::PixelMoments& pixel : film.pixels()) {
    image.mean.push_back(pixel.mean.g);
    image.variance.push_back(pixel.variance().g);
    image.count.push_back(pixel.count);
  }
  return image;
}

verify::Image exact(const std::string& scene_name,
                    const analytic::ParameterValues& overrides = {}) {
  const auto oracle = make_oracle(analytic::known_scene(scene_name), overrides, kFilm);
  return {kFilm.width, kFilm.height, oracle->image(), {}, {}};
}

verify::ImageOptions options_for(const std::string& subject, verify::Verdict expected) {
  verify::ImageOptions options;
  options.subject = subject;
  options.tolerance = 0.005;
  options.expected = expected;
  options.seed = check_seed(subject);
  return options;
}

class WholeImage : public testing::TestWithParam<std::string> {};

TEST_P(WholeImage, EveryPixelIsTheClosedFormOverItsFootprint) {
  const auto options = options_for(GetParam() + "/image", verify::Verdict::pass);
  const renderer::Film film = render_scene(GetParam(), 512, options.seed);
  expect_verdict(check_image(options, green(film), exact(GetParam())).check);
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const analytic::KnownScene& known : analytic::known_scenes()) names.emplace_back(known.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, WholeImage, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

TEST(WholeImageControl, AnAlbedoOffByOnePercentFails) {
  const auto options =
      options_for("control/furnace_open, albedo off by 1 %", verify::Verdict::fail);
  const renderer::Film film = render_scene("furnace_open", 1024, options.seed);
  expect_verdict(
      check_image(options, green(film), exact("furnace_open", {{"albedo", 0.7575}})).check);
}

TEST(WholeImageControl, AnImageMovedByOnePixelFailsThoughItsMeanHardlyChanges) {
  const auto options = options_for("control/furnace_open, one pixel aside", verify::Verdict::fail);
  const verify::Image image = green(render_scene("furnace_open", 1024, options.seed));
  verify::Image moved = image;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 1; x < image.width; ++x) {
      const auto to = static_cast<std::size_t>(y * image.width + x);
      moved.mean[to] = image.mean[to - 1];
      moved.variance[to] = image.variance[to - 1];
    }
  }
  expect_verdict(check_image(options, moved, exact("furnace_open")).check);
}

}  // namespace
}  // namespace plumbline::tests
