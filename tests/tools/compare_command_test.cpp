#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/renderer/core/render/film.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/image_io/exr.h>

#include "command_line.h"

namespace plumbline::tests {
namespace {

/// Renders in the scratch directory; 40×30 pixels of a scene take milliseconds.
void render(const ScratchDirectory& scratch, const std::string& arguments) {
  const Outcome outcome = run_plumbline(scratch.path(), "render --size 40x30 " + arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
}

constexpr int kComparedWidth = 40, kComparedHeight = 30;
constexpr int kComparedSamples = 256;

/// The closed form of sphere_light under noise of a known distribution: uniform, of half of each
/// pixel's value. What is asked of the comparison does not depend on how noisy the renderer is.
void write_noisy_answer(const ScratchDirectory& scratch, const std::string& to, std::uint64_t seed,
                        int samples = kComparedSamples) {
  const auto answer = make_oracle(analytic::known_scene("sphere_light"), {},
                                  analytic::FilmSize{kComparedWidth, kComparedHeight})
                          ->image();
  renderer::Image image{kComparedWidth, kComparedHeight, {}, {}, {}, {}};
  for (std::size_t pixel = 0; pixel < answer.size(); ++pixel) {
    renderer::PixelMoments moments;
    renderer::Pcg32 random(seed, pixel, 0);
    for (int i = 0; i < samples; ++i) {
      const auto& [r, g, b] = answer[pixel];
      const renderer::Rgbf colour = renderer::rgb_cast<float>(renderer::Rgbd{r, g, b});
      moments.add(colour * (0.5f + random.next_1d()));
    }
    image.pixels.push_back(renderer::rgb_cast<float>(moments.mean));
    image.variance.push_back(renderer::rgb_cast<float>(moments.variance()));
    image.count.push_back(static_cast<float>(moments.count));
  }
  renderer::write_exr(scratch / to, image);
}

/// Compares, and expects that verdict: an exit code of 1 alone may also say that nothing is proven.
///
/// @param why  words of its reason
void expect_compared(const ScratchDirectory& scratch, const std::string& arguments,
                     const std::string& verdict, const std::string& why = "") {
  const Outcome outcome = run_plumbline(scratch.path(), "compare " + arguments);
  EXPECT_EQ(outcome.exit_code, verdict == "pass" ? 0 : 1) << outcome.err;
  EXPECT_NE(outcome.out.find("image check gives " + verdict), std::string::npos) << outcome.out;
  const std::size_t reason = outcome.out.find("  why ");
  EXPECT_TRUE(why.empty() || outcome.out.find(why, reason) != std::string::npos) << outcome.out;
}

/// The image as another renderer would have written it: pixels, nothing else.
void strip(const ScratchDirectory& scratch, const std::string& from, const std::string& to) {
  renderer::Image image = renderer::read_exr(scratch / from);
  image.variance.clear();
  image.count.clear();
  image.metadata.clear();
  renderer::write_exr(scratch / to, image);
}

/// The image with every pixel multiplied.
void scale(const ScratchDirectory& scratch, const std::string& from, const std::string& to,
           float factor) {
  renderer::Image image = renderer::read_exr(scratch / from);
  for (renderer::Rgbf& pixel : image.pixels) pixel = pixel * factor;
  renderer::write_exr(scratch / to, image);
}

TEST(CompareCommand, UnbiasedImagePassesAndProvesABound) {
  const ScratchDirectory scratch;
  render(scratch, "sphere_light -o a.exr --spp 256");
  const Outcome outcome = run_plumbline(scratch.path(), "compare a.exr --scene sphere_light");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  for (const char* channel : {"R", "G", "B"}) {
    EXPECT_NE(outcome.out.find(std::string("a.exr against sphere_light, ") + channel +
                               ": image check gives pass, as expected"),
              std::string::npos)
        << channel;
  }
  EXPECT_NE(outcome.out.find("|bias| <="), std::string::npos);
}

TEST(CompareCommand, NoiseOfAKnownKindPassesAndABiasOfThreePercentFails) {
  const ScratchDirectory scratch;
  write_noisy_answer(scratch, "a.exr", check_seed("compare/noisy"));
  expect_compared(scratch, "a.exr --scene sphere_light", "pass");
  scale(scratch, "a.exr", "b.exr", 1.03f);
  expect_compared(scratch, "b.exr --scene sphere_light", "fail", "standard errors from the answer");
}

TEST(CompareCommand, TooFewSamplesAreInconclusiveWhichIsNotAPass) {
  const ScratchDirectory scratch;
  write_noisy_answer(scratch, "a.exr", check_seed("compare/few"), 2);
  expect_compared(scratch, "a.exr --scene sphere_light --tolerance 0.0001", "inconclusive",
                  "neither a difference nor");
}

TEST(CompareCommand, ImageOfAnotherRendererIsJudgedFromItsResiduals) {
  const ScratchDirectory scratch;
  write_noisy_answer(scratch, "a.exr", check_seed("compare/residuals"));
  strip(scratch, "a.exr", "stripped.exr");
  expect_compared(scratch, "stripped.exr --scene sphere_light", "pass");
  scale(scratch, "stripped.exr", "biased.exr", 1.03f);
  expect_compared(scratch, "biased.exr --scene sphere_light", "fail",
                  "standard errors from the answer");
}

TEST(CompareCommand, ParametersAndDepthComeFromTheHeader) {
  // By BSDF samples, of which each is the answer: without noise.
  const ScratchDirectory scratch;
  render(scratch, "furnace_sphere -o a.exr --spp 64 -D albedo=0.25 --max-depth 2 --strategy bsdf");
  expect_compared(scratch, "a.exr --scene furnace_sphere", "pass");
  strip(scratch, "a.exr", "b.exr");
  expect_compared(scratch, "b.exr --scene furnace_sphere", "fail",
                  "all samples are close to 0.625, the answer is 1");
  expect_compared(scratch, "b.exr --scene furnace_sphere -D albedo=0.25 --max-depth 2", "pass");
}

TEST(CompareCommand, ParametersMayBeColours) {
  const ScratchDirectory scratch;
  render(scratch, "furnace_sphere -o a.exr --spp 256 -D albedo=0.2,0.3,0.4 --max-depth 2");
  expect_compared(scratch, "a.exr --scene furnace_sphere", "pass");
  strip(scratch, "a.exr", "b.exr");
  const std::string of_b = "b.exr --scene furnace_sphere --max-depth 2 -D albedo=";
  expect_compared(scratch, of_b + "0.2,0.3,0.4", "pass");
  expect_compared(scratch, of_b + "0.2,0.4,0.3", "fail", "from the answer");
  EXPECT_EQ(run_plumbline(scratch.path(), "compare " + of_b + "0.2,0.3").exit_code, 2);
}

TEST(CompareCommand, AGreyImageAgainstAGreyAnswerIsJudgedOnce) {
  const ScratchDirectory scratch;
  const std::string grey = " -D albedo=0.75 -D radiance=4";
  render(scratch, "sphere_light -o a.exr --spp 256" + grey);
  const Outcome outcome = run_plumbline(scratch.path(), "compare a.exr --scene sphere_light");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_NE(outcome.out.find("a.exr against sphere_light: image check gives pass, as expected"),
            std::string::npos);
}

TEST(CompareCommand, StrategiesAgree) {
  const ScratchDirectory scratch;
  render(scratch, "sphere_light -o a.exr --spp 256 --strategy mis --seed 1");
  render(scratch, "sphere_light -o b.exr --spp 256 --strategy light --seed 2");
  expect_compared(scratch, "a.exr b.exr", "pass");
}

TEST(CompareCommand, ImagesThatDifferByThreePercentDoNotAgree) {
  const ScratchDirectory scratch;
  write_noisy_answer(scratch, "a.exr", check_seed("compare/one"));
  write_noisy_answer(scratch, "b.exr", check_seed("compare/other"));
  expect_compared(scratch, "a.exr b.exr", "pass");
  scale(scratch, "b.exr", "c.exr", 1.03f);
  expect_compared(scratch, "a.exr c.exr", "fail", "standard errors from the answer");
}

TEST(CompareCommand, ColouredImagesAreJudgedByChannel) {
  const ScratchDirectory scratch;
  write_noisy_answer(scratch, "a.exr", check_seed("compare/coloured"));
  renderer::Image image = renderer::read_exr(scratch / "a.exr");
  for (renderer::Rgbf& pixel : image.pixels) pixel.b *= 1.03f;
  renderer::write_exr(scratch / "b.exr", image);
  const Outcome outcome = run_plumbline(scratch.path(), "compare b.exr --scene sphere_light");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("sphere_light, R: image check gives pass"), std::string::npos);
  EXPECT_NE(outcome.out.find("sphere_light, G: image check gives pass"), std::string::npos);
  EXPECT_NE(outcome.out.find("sphere_light, B: image check gives fail"), std::string::npos);
}

TEST(CompareCommand, ImageWithAPixelThatIsNotFiniteFails) {
  const ScratchDirectory scratch;
  write_noisy_answer(scratch, "a.exr", check_seed("compare/not finite"));
  renderer::Image image = renderer::read_exr(scratch / "a.exr");
  image.pixels[7].g = std::numeric_limits<float>::quiet_NaN();
  renderer::write_exr(scratch / "b.exr", image);
  expect_compared(scratch, "b.exr --scene sphere_light", "fail", "not finite");
}

TEST(CompareCommand, ImagesOfDifferentSizesAreBadInput) {
  const ScratchDirectory scratch;
  render(scratch, "furnace_open -o a.exr --spp 1");
  ASSERT_EQ(
      run_plumbline(scratch.path(), "render furnace_open -o b.exr --spp 1 --size 8x8").exit_code,
      0);
  const Outcome outcome = run_plumbline(scratch.path(), "compare a.exr b.exr");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("the images differ in size: 40x30 and 8x8"), std::string::npos);
}

TEST(CompareCommand, ExactSeesTheLastBit) {
  const ScratchDirectory scratch;
  render(scratch, "furnace_open -o a.exr --spp 1");
  renderer::Image image = renderer::read_exr(scratch / "a.exr");
  float& value = image.pixels[45].r;
  value = std::nextafter(value, 2.0f);
  renderer::write_exr(scratch / "b.exr", image);
  const Outcome outcome = run_plumbline(scratch.path(), "compare a.exr b.exr --exact");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("R, G, B: 1 of 1200 pixels differ, the first at (5, 1)"),
            std::string::npos);
}

TEST(CompareCommand, ExactSeesEveryLayerAndTheHeader) {
  const ScratchDirectory scratch;
  render(scratch, "furnace_open -o a.exr --spp 2");
  const renderer::Image image = renderer::read_exr(scratch / "a.exr");
  const auto expect_difference = [&](const renderer::Image& other, const std::string& message) {
    renderer::write_exr(scratch / "b.exr", other);
    const Outcome outcome = run_plumbline(scratch.path(), "compare a.exr b.exr --exact");
    EXPECT_EQ(outcome.exit_code, message.empty() ? 0 : 1) << message;
    EXPECT_NE(outcome.out.find(message.empty() ? "the images are identical" : message),
              std::string::npos)
        << outcome.out;
  };
  renderer::Image other = image;
  other.variance[41].g = std::nextafter(other.variance[41].g, 1.0f);
  expect_difference(other, "variance: 1 of 1200 pixels differ, the first at (1, 1)");
  other = image;
  other.count[80] += 1;
  expect_difference(other, "count: 1 of 1200 pixels differ, the first at (0, 2): 2 and 3");
  other = image;
  other.count.clear();
  expect_difference(other, "only the first image has the layer count");
  other = image;
  other.metadata["seed"] = "7";
  expect_difference(other, "header: seed: 0 and 7");
  other = image;
  other.metadata.erase("sampler");
  expect_difference(other, "header: sampler: independent and nothing");
  other = image;
  other.metadata["parameter.albedo"] = "0.5";
  expect_difference(other, "header: parameter.albedo: nothing and 0.5");
  other = image;  // what may differ
  other.metadata["seconds"] = "12";
  other.metadata["capDate"] = "2026:11:30 12:00:00";
  expect_difference(other, "");
}

/// The header's word for how deep an image was rendered decides how long its closed form takes.
TEST(CompareCommand, DepthsThatAHeaderClaimsAreReadAsNumbersAndBounded) {
  const ScratchDirectory scratch;
  render(scratch, "furnace_sphere -o a.exr --spp 16 --strategy bsdf");
  renderer::Image image = renderer::read_exr(scratch / "a.exr");
  for (const char* depth : {"2147483647", "1000001", "-2", "9999999999999999999", "nan", "5x"}) {
    image.metadata["max_depth"] = depth;
    renderer::write_exr(scratch / "b.exr", image);
    const Outcome outcome = run_plumbline(scratch.path(), "compare b.exr --scene furnace_sphere");
    EXPECT_EQ(outcome.exit_code, 2) << depth << outcome.out;
    EXPECT_NE(outcome.err.find(std::string("the image's header has max_depth=") + depth +
                               ", not a whole number from -1 to 1000000: say --max-depth"),
              std::string::npos)
        << outcome.err;
  }
  // By hand any depth will do: no closed form takes longer for it.
  EXPECT_EQ(
      run_plumbline(scratch.path(), "compare b.exr --scene furnace_sphere --max-depth 2147483647")
          .exit_code,
      0);
  image.metadata["max_depth"] = "1000000";
  image.metadata["non_finite"] = "some";
  renderer::write_exr(scratch / "b.exr", image);
  EXPECT_EQ(run_plumbline(scratch.path(), "compare b.exr --scene furnace_sphere").exit_code, 2);
}

TEST(CompareCommand, AClosedFormByQuadratureShowsItsProgressOnATerminal) {
  const ScratchDirectory scratch;
  const Outcome rendered =
      run_plumbline(scratch.path(), "render sphere_shadow -o a.exr --spp 4 --size 6x4");
  ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
  const std::string shown = run_on_terminal(scratch.path(), "compare a.exr --scene sphere_shadow");
  EXPECT_NE(shown.find(" s left"), std::string::npos) << shown;
}

}  // namespace
}  // namespace plumbline::tests
