#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <limits>
#include <string>

#include <plumbline/renderer/image_io/exr.h>

#include "command_line.h"

namespace plumbline::tests {
namespace {

/// Renders in the scratch directory; 40×30 pixels of a scene take milliseconds.
void render(const ScratchDirectory& scratch, const std::string& arguments) {
  const Outcome outcome = run_plumbline(scratch.path(), "render --size 40x30 " + arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
}

int compare(const ScratchDirectory& scratch, const std::string& arguments) {
  return run_plumbline(scratch.path(), "compare " + arguments).exit_code;
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

TEST(CompareCommand, BiasOfThreePercentFails) {
  const ScratchDirectory scratch;
  render(scratch, "sphere_light -o a.exr --spp 256");
  scale(scratch, "a.exr", "b.exr", 1.03f);
  EXPECT_EQ(compare(scratch, "b.exr --scene sphere_light"), 1);
}

TEST(CompareCommand, TooFewSamplesAreInconclusiveWhichIsNotAPass) {
  const ScratchDirectory scratch;
  render(scratch, "sphere_light -o a.exr --spp 1 --strategy bsdf");
  const Outcome outcome =
      run_plumbline(scratch.path(), "compare a.exr --scene sphere_light --tolerance 0.0001");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("inconclusive"), std::string::npos);
}

TEST(CompareCommand, ImageOfAnotherRendererIsJudgedFromItsResiduals) {
  const ScratchDirectory scratch;
  render(scratch, "sphere_light -o a.exr --spp 256");
  strip(scratch, "a.exr", "stripped.exr");
  EXPECT_EQ(compare(scratch, "stripped.exr --scene sphere_light"), 0);
  scale(scratch, "stripped.exr", "biased.exr", 1.03f);
  EXPECT_EQ(compare(scratch, "biased.exr --scene sphere_light"), 1);
}

TEST(CompareCommand, ParametersAndDepthComeFromTheHeader) {
  const ScratchDirectory scratch;
  render(scratch, "furnace_sphere -o a.exr --spp 64 -D albedo=0.25 --max-depth 2");
  EXPECT_EQ(compare(scratch, "a.exr --scene furnace_sphere"), 0);
  strip(scratch, "a.exr", "b.exr");
  EXPECT_EQ(compare(scratch, "b.exr --scene furnace_sphere"), 1);
  EXPECT_EQ(compare(scratch, "b.exr --scene furnace_sphere -D albedo=0.25 --max-depth 2"), 0);
}

TEST(CompareCommand, ParametersMayBeColours) {
  const ScratchDirectory scratch;
  render(scratch, "furnace_sphere -o a.exr --spp 256 -D albedo=0.2,0.3,0.4 --max-depth 2");
  EXPECT_EQ(compare(scratch, "a.exr --scene furnace_sphere"), 0);
  strip(scratch, "a.exr", "b.exr");
  EXPECT_EQ(compare(scratch, "b.exr --scene furnace_sphere -D albedo=0.2,0.3,0.4 --max-depth 2"),
            0);
  EXPECT_EQ(compare(scratch, "b.exr --scene furnace_sphere -D albedo=0.2,0.4,0.3 --max-depth 2"),
            1);
  EXPECT_EQ(compare(scratch, "b.exr --scene furnace_sphere -D albedo=0.2,0.3 --max-depth 2"), 2);
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
  EXPECT_EQ(compare(scratch, "a.exr b.exr"), 0);
  scale(scratch, "b.exr", "c.exr", 1.03f);
  EXPECT_EQ(compare(scratch, "a.exr c.exr"), 1);
}

TEST(CompareCommand, ColouredImagesAreJudgedByChannel) {
  const ScratchDirectory scratch;
  render(scratch, "sphere_light -o a.exr --spp 256");
  renderer::Image image = renderer::read_exr(scratch / "a.exr");
  for (renderer::Rgbf& pixel : image.pixels) pixel.b *= 1.03f;
  renderer::write_exr(scratch / "b.exr", image);
  const Outcome outcome = run_plumbline(scratch.path(), "compare b.exr --scene sphere_light");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("sphere_light, R: image check gives pass"), std::string::npos);
  EXPECT_NE(outcome.out.find("sphere_light, B: image check gives fail"), std::string::npos);
}

TEST(CompareCommand, ImageWithAPixelThatIsNotFiniteFails) {
  const ScratchDirectory scratch;
  render(scratch, "sphere_light -o a.exr --spp 256");
  renderer::Image image = renderer::read_exr(scratch / "a.exr");
  image.pixels[7].g = std::numeric_limits<float>::quiet_NaN();
  renderer::write_exr(scratch / "b.exr", image);
  EXPECT_EQ(compare(scratch, "b.exr --scene sphere_light"), 1);
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
  EXPECT_NE(outcome.out.find("1 of 1200 pixels differ, the first at (5, 1)"), std::string::npos);
}

}  // namespace
}  // namespace plumbline::tests
