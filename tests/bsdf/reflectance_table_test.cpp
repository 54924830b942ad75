#include <plumbline/renderer/core/bsdf/reflectance_table.h>

#include <gtest/gtest.h>

#include <cmath>

#include <plumbline/renderer/core/bsdf/fresnel.h>
#include <plumbline/renderer/layered_bsdfs/film_fresnel.h>

/// Tables in the place of formulas: as good as they are said to be, and there where they should be.
namespace plumbline::renderer {
namespace {

double largest_error(const ReflectanceTable& table, double (*truth)(double)) {
  double largest = 0;
  for (int i = 0; i <= 1000; ++i) {
    const auto cosine = static_cast<float>(i) / 1000;
    const double expected = truth(static_cast<double>(cosine));
    largest = std::max(largest, std::abs(static_cast<double>(table(cosine).g) / expected - 1));
  }
  return largest;
}

Rgbd grey(double value) { return {value, value, value}; }

TEST(ReflectanceTable, OfASmoothReflectanceIsWithinItsTolerance) {
  const auto truth = [](double c) { return 0.04 + 0.96 * std::pow(1 - c, 5); };
  const ReflectanceTable table([&](double c) { return grey(truth(c)); });
  ASSERT_FALSE(table.empty());
  EXPECT_LT(largest_error(table, truth), 1.5e-5);
}

/// Sixteen pieces, the fewest, are enough for a cubic, whose pieces are right up to rounding.
TEST(ReflectanceTable, OfACubicIsTheCubic) {
  const auto truth = [](double c) { return 0.3 + c * (0.2 - c * (0.4 - 0.7 * c)); };
  const ReflectanceTable table([&](double c) { return grey(truth(c)); });
  ASSERT_FALSE(table.empty());
  EXPECT_LT(largest_error(table, truth), 1e-6);
}

TEST(ReflectanceTable, KeepsTheChannelsApart) {
  const ReflectanceTable table([](double c) { return Rgbd{0.25, 0.5 * c + 0.25, 1 - 0.5 * c}; });
  const Rgbf middle = table(0.5f);
  EXPECT_FLOAT_EQ(middle.r, 0.25f);
  EXPECT_FLOAT_EQ(middle.g, 0.5f);
  EXPECT_FLOAT_EQ(middle.b, 0.75f);
}

TEST(ReflectanceTable, OfAKinkThatNoPiecesFitIsEmpty) {
  EXPECT_TRUE(ReflectanceTable([](double c) { return grey(0.5 + std::abs(c - 0.3)); }).empty());
  EXPECT_TRUE(ReflectanceTable().empty());
}

// Results are the same without a table, in a dozen times the time.
TEST(ReflectanceTable, IsTakenByMetalsAndFilms) {
  EXPECT_TRUE(ConductorFresnel({0.18f, 0.42f, 1.37f}, {3.42f, 2.35f, 1.77f}).tabulated());
  EXPECT_FALSE(ConductorFresnel().tabulated()) << "a mirror without loss needs none";
  EXPECT_FALSE(ConductorFresnel({0, 0, 0}, {1, 1, 1}).tabulated());
  EXPECT_TRUE(FilmOnDielectric({100, 1.3f}, 1.5f).tabulated());
}

/// More fringes than pieces.
TEST(ReflectanceTable, IsNotTakenWhereAFilmHasNone) {
  const FilmOnDielectric thick({1e6f, 1.3f}, 1.5f);
  ASSERT_FALSE(thick.tabulated());
  for (const float cosine : {0.1f, 0.5f, 0.9f}) {
    const double cos2 = static_cast<double>(cosine) * static_cast<double>(cosine);
    const auto exact = thick.split<double>(cos2, true);
    const auto rendered = thick.split<float>(cos2, true);
    EXPECT_NEAR(static_cast<double>(rendered.reflected.g), exact.reflected.g, 1e-3) << cosine;
    EXPECT_NEAR(static_cast<double>(rendered.transmitted.b), exact.transmitted.b, 1e-3) << cosine;
  }
}

}  // namespace
}  // namespace plumbline::renderer
