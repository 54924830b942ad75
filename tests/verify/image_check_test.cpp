#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <stdexcept>

#include <plumbline/verify/image.h>

#include "samplers.h"

namespace plumbline::verify {
namespace {

using tests::expect_verdict;

constexpr int kWidth = 128, kHeight = 96;

/// A smooth answer between 0.5 and 1.5.
double answer(int x, int y) { return 1 + 0.5 * std::sin(0.1 * x) * std::cos(0.07 * y); }

Image exact() {
  Image image{kWidth, kHeight, {}, {}, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) image.mean.push_back(answer(x, y));
  }
  return image;
}

/// A render of the answer times `bias(x, y)`, with exponential noise.
template <class Bias>
Image render(std::uint64_t seed, int spp, Bias bias) {
  Image image{kWidth, kHeight, {}, {}, {}};
  Random random(seed);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      Moments m;
      for (int s = 0; s < spp; ++s) m.add(answer(x, y) * bias(x, y) * tests::Exponential{}(random));
      image.mean.push_back(m.mean());
      image.variance.push_back(m.variance());
      image.count.push_back(spp);
    }
  }
  return image;
}

double unbiased(int, int) { return 1; }

ImageOptions image_options(const char* subject, Verdict expected = Verdict::pass) {
  ImageOptions o;
  o.subject = subject;
  o.expected = expected;
  o.seed = tests::check_seed(subject);
  return o;
}

TEST(ImageCheck, PassesAnUnbiasedRenderAndProvesTheBound) {
  const ImageOptions o = image_options("image/unbiased");
  const ImageResult r = check_image(o, render(o.seed, 64, unbiased), exact());
  expect_verdict(r.check);
  EXPECT_LE(r.check.bound, r.check.tolerance);
  EXPECT_EQ(r.p_map.size(), static_cast<std::size_t>(r.map_width * r.map_height));
  EXPECT_EQ(r.histogram.size(), 20u);
}

TEST(ImageCheck, FailsABiasOfTwoPercentEverywhere) {
  const ImageOptions o = image_options("image/two percent", Verdict::fail);
  expect_verdict(check_image(o, render(o.seed, 64, [](int, int) { return 1.02; }), exact()).check);
}

TEST(ImageCheck, FailsATileWhoseBiasTheGlobalMeanHides) {
  const ImageOptions o = image_options("image/tile", Verdict::fail);
  // +20 % in one tile of 16 pixels, −20 % in another: the mean stays.
  const auto bias = [](int x, int y) {
    if (y / 16 != 2) return 1.0;
    return x / 16 == 1 ? 1.2 : x / 16 == 5 ? 0.8 : 1.0;
  };
  const ImageResult r = check_image(o, render(o.seed, 64, bias), exact());
  expect_verdict(r.check);
  EXPECT_NE(r.check.reason.find("tile"), std::string::npos) << r.check.reason;
}

TEST(ImageCheck, FailsASinglePixel) {
  const ImageOptions o = image_options("image/pixel", Verdict::fail);
  const auto bias = [](int x, int y) { return x == 40 && y == 30 ? 4.0 : 1.0; };
  const ImageResult r = check_image(o, render(o.seed, 256, bias), exact());
  expect_verdict(r.check);
  EXPECT_NE(r.check.reason.find("pixel (40, 30)"), std::string::npos) << r.check.reason;
}

TEST(ImageCheck, AgreesWithASecondRender) {
  const ImageOptions o = image_options("image/second render");
  expect_verdict(
      check_image(o, render(o.seed, 64, unbiased), render(o.seed + 1, 128, unbiased)).check);
}

TEST(ImageCheck, FailsASecondRenderThatIsOff) {
  const ImageOptions o = image_options("image/second render off", Verdict::fail);
  expect_verdict(check_image(o, render(o.seed, 64, unbiased),
                             render(o.seed + 1, 128, [](int, int) { return 1.02; }))
                     .check);
}

TEST(ImageCheck, EstimatesTheNoiseWithoutAVarianceLayer) {
  const ImageOptions o = image_options("image/no variance layer");
  Image image = render(o.seed, 64, unbiased);
  image.variance.clear();
  image.count.clear();
  expect_verdict(check_image(o, image, exact()).check);
  const ImageOptions off = image_options("image/no variance layer, off", Verdict::fail);
  image = render(off.seed, 64, [](int, int) { return 1.02; });
  image.variance.clear();
  image.count.clear();
  expect_verdict(check_image(off, image, exact()).check);
}

TEST(ImageCheck, TheSameImageNeverDiffersFromItself) {
  const ImageOptions o = image_options("image/itself");
  const Image image = render(o.seed, 64, unbiased);
  expect_verdict(check_image(o, image, image).check);
}

TEST(ImageCheck, TakesANoiselessImageForWhatItIs) {
  Image flat = exact();
  flat.variance.assign(flat.mean.size(), 0.0);
  flat.count.assign(flat.mean.size(), 64);
  expect_verdict(check_image(image_options("image/noiseless"), flat, exact()).check);
  for (double& v : flat.mean) v *= 1.001;
  expect_verdict(
      check_image(image_options("image/noiseless but off", Verdict::fail), flat, exact()).check);
}

TEST(ImageCheck, ProvesNothingFromPixelsThatNothingHasHit) {
  // Light hits one sample in 200: most of the pixels are black after 16, and none is wrong.
  const ImageOptions o = image_options("image/rare hits", Verdict::inconclusive);
  Image image{kWidth, kHeight, {}, {}, {}}, reference = image;
  Random random(o.seed);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    Moments m;
    for (int s = 0; s < 16; ++s) m.add(tests::Bernoulli{0.005}(random));
    image.mean.push_back(m.mean());
    image.variance.push_back(m.variance());
    image.count.push_back(16);
    reference.mean.push_back(0.005);
  }
  expect_verdict(check_image(o, image, reference).check);
}

/// Light of mean 1 that one sample in `rarity` hits, over a faint glow.
Image rarely_lit(std::uint64_t seed, int spp, double rarity, double glow) {
  Image image{kWidth, kHeight, {}, {}, {}};
  Random random(seed);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    Moments m;
    for (int s = 0; s < spp; ++s) {
      m.add(glow * random.uniform() + rarity * tests::Bernoulli{1 / rarity}(random));
    }
    image.mean.push_back(m.mean());
    image.variance.push_back(m.variance());
    image.count.push_back(spp);
  }
  return image;
}

TEST(ImageCheck, ARenderThatSeldomHitsTheLightNeverDiffersFromOneThatAlwaysDoes) {
  for (const double rarity : {50.0, 1'000.0, 100'000.0}) {
    for (const double glow : {0.0, 0.1}) {
      ImageOptions o = image_options("image/seldom hit against always hit", Verdict::inconclusive);
      o.seed += static_cast<std::uint64_t>(rarity * (1 + glow));
      o.tolerance = 1e-4;  // undecided: nothing is to fail
      const Image seldom = rarely_lit(o.seed, 64, rarity, glow);
      const Image always = rarely_lit(o.seed + 1, 64, 1, glow);
      expect_verdict(check_image(o, seldom, always).check);
      expect_verdict(check_image(o, always, seldom).check);
    }
  }
}

TEST(ImageCheck, ABlackImageWithoutVarianceProvesNothing) {
  Image black = exact();
  black.mean.assign(black.mean.size(), 0.0);
  expect_verdict(
      check_image(image_options("image/black", Verdict::inconclusive), black, exact()).check);
  // With as many samples as make zeros believable it is wrong.
  black.variance.assign(black.mean.size(), 0.0);
  black.count.assign(black.mean.size(), 1024);
  expect_verdict(
      check_image(image_options("image/black for good", Verdict::fail), black, exact()).check);
}

TEST(ImageCheck, NeverPassesAPixelThatIsNotFinite) {
  const ImageOptions o = image_options("image/NaN", Verdict::fail);
  Image image = render(o.seed, 64, unbiased);
  image.mean[1234] = std::nan("");
  expect_verdict(check_image(o, image, exact()).check);
  ImageOptions counted = image_options("image/samples not finite", Verdict::fail);
  counted.non_finite = 1;
  expect_verdict(check_image(counted, render(o.seed, 64, unbiased), exact()).check);
}

TEST(ImageCheck, PValuesOfAnUnbiasedRenderAreFlat) {
  const ImageOptions o = image_options("image/flat histogram");
  const ImageResult r = check_image(o, render(o.seed, 256, unbiased), exact());
  EXPECT_GT(r.check.figure(Figure::histogram_p_value), ErrorBudget{}.fail_level());
}

TEST(ImageCheck, RefusesImagesThatDoNotMatch) {
  Image small{2, 2, {1, 1, 1, 1}, {}, {}};
  EXPECT_THROW(check_image(image_options("i"), small, exact()), std::invalid_argument);
  small.variance = {1};
  EXPECT_THROW(check_image(image_options("i"), small, small), std::invalid_argument);
}

TEST(ImageCheck, RefusesCountsThatAreNone) {
  Image image{2, 2, {1, 1, 1, 1}, {1, 1, 1, 1}, {4, 4, 4, 4}};
  EXPECT_EQ(check_image(image_options("i"), image, image).check.samples, 16u);
  for (const double count : {-4.5, std::nan(""), HUGE_VAL, 1e30}) {
    image.count[2] = count;
    EXPECT_THROW(check_image(image_options("i"), image, image), std::invalid_argument) << count;
  }
}

}  // namespace
}  // namespace plumbline::verify
