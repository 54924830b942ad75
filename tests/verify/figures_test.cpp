#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <plumbline/verify/detail/budget.h>
#include <plumbline/verify/image.h>
#include <plumbline/verify/mean.h>
#include <plumbline/verify/ratio.h>

#include "distributions.h"
#include "images/image_tiles.h"
#include "means/mean_judgement.h"

/// Numbers of checks against those that are worked out by hand, from inputs without noise.
namespace plumbline::verify {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Moments moments_of(const std::vector<double>& samples) {
  Moments m;
  for (const double x : samples) m.add(x);
  return m;
}

/// Of 0, 0, 0, 4: mean 1, squares 12, cubes 24, so √4 · 24/12^(3/2).
TEST(Figures, OfMoments) {
  const Moments m = moments_of({0, 0, 0, 4});
  EXPECT_DOUBLE_EQ(m.variance(), 4);
  EXPECT_DOUBLE_EQ(m.standard_error(), 1);
  EXPECT_DOUBLE_EQ(m.skewness(), 2 / std::sqrt(3));
  EXPECT_DOUBLE_EQ(m.largest_share(), 0.75);
  const Evidence e = evidence(m);
  EXPECT_EQ(e.samples, 4u);
  EXPECT_DOUBLE_EQ(e.skewness, 1 / std::sqrt(3));
  EXPECT_EQ(e.smallest, 0);
  EXPECT_EQ(e.largest, 4);
}

/// With errors 3 and 4 together 5: third moments keep 27/125 and 64/125 of their skewness.
TEST(Figures, OfADifference) {
  Evidence a, b;
  a = {100, 7, 3, 0.5, 0.2, 5, 1, 9, 2, 3};
  b = {50, 2, 4, 0.25, 0.3, 4, -1, 6, 5, 4};
  const Evidence d = difference(a, b);
  EXPECT_EQ(d.samples, 150u);
  EXPECT_EQ(d.estimate, 5);
  EXPECT_EQ(d.standard_error, 5);
  EXPECT_NEAR(d.skewness, 0.5 * 27 / 125 - 0.25 * 64 / 125, 1e-15);
  EXPECT_NEAR(d.largest_share, 0.3 * 16 / 25, 1e-15);
  EXPECT_EQ(d.tail_index, 4);
  EXPECT_EQ(d.smallest, 1 - 6);
  EXPECT_EQ(d.largest, 9 + 1);
  EXPECT_EQ(d.rejected, 7u);
  EXPECT_EQ(d.non_finite, 7u);
}

TEST(Figures, OfLooks) {
  const auto looks = [](std::uint64_t n0, std::uint64_t most) {
    return plan_looks(n0, most, ErrorBudget{}).samples;
  };
  using Counts = std::vector<std::uint64_t>;
  EXPECT_EQ(looks(1, 1), (Counts{1}));
  EXPECT_EQ(looks(4, 4), (Counts{4}));
  EXPECT_EQ(looks(1, 8), (Counts{1, 2, 4, 8}));
  EXPECT_EQ(looks(10, 100), (Counts{10, 20, 40, 80, 100}));
  EXPECT_EQ(looks(10, 85), (Counts{10, 20, 40, 85})) << "less than a tenth short of the cap";
  EXPECT_EQ(looks(10, 89), (Counts{10, 20, 40, 80, 89}));
  EXPECT_EQ(looks(10, 5), (Counts{5}));
}

/// Batches of a variance, as they are given.
CheckResult ratio_of(const std::vector<double>& a, const std::vector<double>& b,
                     double at_least = 0.5) {
  VarianceRatioOptions o;
  o.subject = "ratio";
  o.seed = 77;
  o.at_least = at_least;
  return check_variance_ratio(o, std::span<const double>(a), std::span<const double>(b));
}

/// Sixteen batches of 3 and 5 against ones. Without one of them the mean is 57/15 or 59/15.
TEST(Figures, OfARatioOfVariances) {
  std::vector<double> a(16), ones(16, 1.0);
  for (std::size_t i = 0; i < 16; ++i) a[i] = i % 2 == 0 ? 3 : 5;
  const CheckResult r = ratio_of(a, ones);
  EXPECT_EQ(*r.estimate, 4);
  EXPECT_EQ(r.figure(Figure::variance_of_a), 4);
  EXPECT_EQ(r.figure(Figure::variance_of_b), 1);
  EXPECT_EQ(r.figure(Figure::largest_batch_of_a), 5 / 64.0);
  EXPECT_EQ(r.samples, 32u);
  // Two values, as many of each: no skewness, and each is half their distance from the mean.
  const double error = std::log(61 / 59.0) / 2 * std::sqrt(15);
  const double t = student_quantile(5e-4, 15);
  EXPECT_NEAR(std::log(r.interval->high / 4), t * error, 1e-12);
  EXPECT_NEAR(std::log(r.interval->low / 4), -t * error, 1e-12);
  EXPECT_EQ(r.verdict, Verdict::pass);
  // Straddled, it says so.
  const CheckResult straddles = ratio_of(a, ones, 3.9);
  EXPECT_EQ(straddles.verdict, Verdict::inconclusive);
  EXPECT_EQ(straddles.reason, "the interval straddles the claim");
  EXPECT_EQ(straddles.advice, "larger batches narrow it, all of them");
}

/// One batch that holds more than the others pulls the truth upwards, in a or downwards, in b.
TEST(Figures, OfASkewedRatioReachFartherToTheTail) {
  std::vector<double> tailed(16, 1.0), ones(16, 1.0);
  tailed[5] = 3;
  for (std::size_t i = 0; i < 16; ++i) ones[i] += i % 2 == 0 ? 0.01 : -0.01;
  const CheckResult up = ratio_of(tailed, ones), down = ratio_of(ones, tailed);
  EXPECT_GT(std::log(up.interval->high / *up.estimate),
            1.2 * std::log(*up.estimate / up.interval->low));
  EXPECT_GT(std::log(*down.estimate / down.interval->low),
            1.2 * std::log(down.interval->high / *down.estimate));
}

TEST(Figures, OfARatioCountWhatIsNotFinite) {
  std::vector<Moments> a(16, moments_of({0, 1, 2})), b = a;
  a[3] = moments_of({0, kNan, 1, kInfinity});
  b[4] = moments_of({0, kNan, 1});
  VarianceRatioOptions o;
  o.at_least = 0.5;
  const CheckResult r =
      check_variance_ratio(o, std::span<const Moments>(a), std::span<const Moments>(b));
  EXPECT_EQ(r.verdict, Verdict::fail);
  EXPECT_EQ(r.reason, "3 samples or batches were not finite");
  std::vector<double> numbers(16, 1.0), others = numbers;
  numbers[0] = kNan;
  EXPECT_EQ(ratio_of(numbers, others).reason, "1 samples or batches were not finite");
}

TEST(Figures, OfAProportionThatStraddlesItsClaim) {
  ProportionOptions o;
  o.at_most = 0.5;
  const CheckResult r = check_proportion(o, 10, 20);
  EXPECT_EQ(r.verdict, Verdict::inconclusive);
  EXPECT_EQ(*r.estimate, 0.5);
  EXPECT_EQ(r.reason, "the interval straddles the claim");
  EXPECT_EQ(r.advice, "more trials narrow it");
}

/// Of equal samples.
CheckResult mean_of_equal(double value, double reference, std::optional<double> variance) {
  MeanOptions o;
  o.reference = reference;
  o.relative = false;
  o.tolerance = 0.1;
  o.exact_variance = variance;
  o.max_samples = 20'000;
  return check_mean(o, [value](std::uint64_t, std::uint64_t count) {
    Moments m;
    for (std::uint64_t i = 0; i < count; ++i) m.add(value);
    return m;
  });
}

TEST(Figures, OfEqualSamples) {
  const CheckResult dark = mean_of_equal(0, 0, {});
  EXPECT_EQ(dark.verdict, Verdict::pass);
  EXPECT_EQ(dark.p_value, 1);
  EXPECT_EQ(dark.bound, 0);
  EXPECT_EQ(dark.interval, (Interval{0, 0}));
  // Each of n as far off on one side by chance, beyond what rounding may do: (σ²/(σ² + d²))^n.
  const CheckResult off = mean_of_equal(0.5, 0.51, 0.01);
  EXPECT_EQ(off.leaned_on, "exact variance");
  EXPECT_NEAR(*off.bound, 0.01, 1e-15);
  const double distance = 0.01 - 1e-5;
  EXPECT_NEAR(std::log(*off.p_value) / static_cast<double>(off.samples),
              -std::log1p(distance * distance / 0.01), 1e-12);
}

TEST(Figures, OfTheSkewnessOfASum) {
  // One of a hundred: squares 0.99, cubes 0.9702; two standard errors of noise are 2 √6/100.
  std::vector<double> residuals(100);
  residuals[7] = 1;
  const double noise = 2 * std::sqrt(6) / 100, seen = 0.9702 / std::pow(0.99, 1.5);
  EXPECT_NEAR(sum_skewness(residuals).skewness, seen - noise, 1e-12);
  EXPECT_NEAR(sum_skewness(residuals).largest_share, 0.99, 1e-12);
  for (double& x : residuals) x = 5 - x;
  EXPECT_NEAR(sum_skewness(residuals).skewness, noise - seen, 1e-12);
  for (std::size_t i = 0; i < 100; ++i) residuals[i] = i % 2 == 0 ? 1 : -1;
  EXPECT_EQ(sum_skewness(residuals).skewness, 0);
}

/// An image of an edge in pixels: 1 everywhere, and noise of ±1 like a chessboard's over a bias.
Image chessboard(int edge, double bias) {
  Image image;
  image.width = image.height = edge;
  for (int i = 0; i < edge * edge; ++i) {
    image.mean.push_back(1 + bias + ((i % edge + i / edge) % 2 == 0 ? 0.1 : -0.1));
  }
  return image;
}
Image white(int edge) {
  Image image;
  image.width = image.height = edge;
  image.mean.assign(static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge), 1.0);
  return image;
}

/// Without a variance layer noise is seen in the pixels: 64 are enough, fewer are not judged.
TEST(Figures, OfTilesWithoutVariance) {
  // The mean of 64 is off by two of its standard errors, √(64 · 0.1²/63/64).
  const double bias = 2 * 0.1 / std::sqrt(63);
  const TileTest test = test_tiles(make_residuals(chessboard(8, bias), white(8)), 8, 0).tests[0];
  EXPECT_NEAR(test.z, 2, 1e-9);
  // P(|T| > 2), 63 degrees of freedom.
  EXPECT_NEAR(test.p_plain, 0.0498158, 1e-7);
  EXPECT_NEAR(test.p_safe, 0.0498158, 1e-7);
  const Residuals seven = make_residuals(chessboard(7, bias), white(7));
  EXPECT_TRUE(std::isnan(test_tiles(seven, 7, 0).tests[0].p_safe));
  EXPECT_FALSE(std::isnan(test_tiles(seven, 7, 0).tests[0].p_plain));
}

TEST(Figures, OfTilesWithVariance) {
  Image image = chessboard(4, 0), reference = white(4);
  image.variance.assign(16, 0.64);
  image.count.assign(16, 400);
  reference.variance.assign(16, 0.36);
  reference.count.assign(16, 100);
  image.mean[0] = 1.3;
  // Of a pixel 0.64/400 + 0.36/100; of a tile of four a quarter of it.
  const Residuals r = make_residuals(image, reference);
  const TileScale pixels = test_tiles(r, 1, 0), tiles = test_tiles(r, 2, 0);
  const double error = std::sqrt(0.0016 + 0.0036);
  EXPECT_NEAR(pixels.tests[0].z, 0.3 / error, 1e-9);
  EXPECT_NEAR(tiles.tests[0].z, (0.3 - 0.1) / 4 / (error / 2), 1e-9);
  EXPECT_EQ(tiles.width, 2);
  EXPECT_EQ(tiles.height, 2);
  // A rounding that is allowed is none of it.
  EXPECT_NEAR(test_tiles(r, 1, 0.05).tests[0].z, 0.25 / error, 1e-9);
  // Partial tiles at the far edges count.
  EXPECT_EQ(test_tiles(r, 3, 0).tests.size(), 4u);
}

/// Samples that differ by less than rounding may do are taken for equal; those with noise are too
/// few.
TEST(Figures, OfAnImageWithoutNoise) {
  const auto leaned_on = [](double variance) {
    Image image = white(4);
    image.variance.assign(16, variance);
    image.count.assign(16, 10);
    return check_image({}, image, white(4)).check.leaned_on;
  };
  // Twice the standard error of a pixel, of ten samples, within 1e-5 of the mean, or not.
  EXPECT_EQ(leaned_on(10 * std::pow(0.49e-5, 2)), "nearly equal samples");
  EXPECT_EQ(leaned_on(10 * std::pow(0.51e-5, 2)), "skewness guard");
}

TEST(Figures, OfDistributionsKeepWhatIsNoNumber) {
  EXPECT_TRUE(std::isnan(student_two_sided(kNan, 5)));
  EXPECT_TRUE(std::isnan(chi_square_tail(kNan, 5)));
  EXPECT_EQ(student_two_sided(kInfinity, 5), 0);
  EXPECT_EQ(chi_square_tail(kInfinity, 5), 0);
  // From tables: one in twenty.
  EXPECT_NEAR(student_two_sided(2.5706, 5), 0.05, 1e-5);
  EXPECT_NEAR(chi_square_tail(11.0705, 5), 0.05, 1e-6);
}

}  // namespace
}  // namespace plumbline::verify
