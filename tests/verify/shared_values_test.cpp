#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <plumbline/verify/joint.h>
#include <plumbline/verify/pair.h>

#include "pairs/lines.h"

/// Samples on lines and in points, where a density is stated: bins that follow the samples may hold
/// as much as they should.
namespace plumbline::verify {
namespace {

constexpr double kDouble = 0x1p-53, kFloat = 0x1p-24;

std::vector<double> values_of(const std::function<double(double)>& map) {
  Random random(tests::check_seed("shared values"));
  std::vector<double> values(16384);
  for (double& x : values) x = map(random.uniform());
  return values;
}

TEST(SharedValues, AreFoundInWhatNoDensityGives) {
  const SharedValues clamped =
      shared_values(values_of([](double u) { return std::min(u, 0.7); }), kDouble);
  EXPECT_EQ(clamped.count, 1u);
  EXPECT_EQ(clamped.example, 0.7);
  EXPECT_NEAR(clamped.share, 0.3, 0.03);
  const auto cells = [](double u) { return std::floor(256 * u) / 256; };
  EXPECT_EQ(shared_values(values_of(cells), kDouble).count, 255u) << "all but that at the edge";
  const auto moved = [](double u) { return u < 0.002 ? 0.4 : u; };
  EXPECT_EQ(shared_values(values_of(moved), kDouble).count, 1u);
  EXPECT_EQ(shared_values(values_of(moved), kFloat).count, 1u);
}

TEST(SharedValues, AreNotWhatRoundingOrANarrowLobeGives) {
  const auto in_float = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  const auto lobe = [](double width) {
    return [width](double u) { return 0.3 + width * (u - 0.5); };
  };
  const std::vector<std::function<double(double)>> maps = {
      [](double u) { return u; },
      [](double u) { return u * u * u; },
      [&](double u) { return in_float(u); },
      lobe(1e-11),
      [&](double u) { return in_float(lobe(1e-4)(u)); },
      [&](double u) { return 1 - in_float(1 - 1e-6 * u); },
      [](double u) { return 1e-15 * u; }};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const bool rounded = i == 2 || i == 4 || i == 5;
    EXPECT_EQ(shared_values(values_of(maps[i]), rounded ? kFloat : kDouble).count, 0u) << i;
  }
}

struct Place {
  double x = 0, y = 0;
};

struct Direction {
  double x = 0, y = 0, z = 0;
};

using ToPlace = std::function<Place(double, double)>;
using ToDirection = std::function<Direction(double, double)>;

Report of_square(const std::string& name, const ToPlace& sample) {
  return check_pair(sampling_pair<Place>(
      name, Domain::unit_square(), [sample](double u, double v) { return sample(u, v); },
      [](const Place&) { return 1.0; }));
}

Report of_line(const std::string& name, const std::function<double(double)>& sample) {
  return check_pair(sampling_pair<double>(
      name, Domain::interval(), [sample](double u) { return sample(u); },
      [](double) { return 1.0; }));
}

Report of_sphere(const std::string& name, const ToDirection& sample) {
  return check_pair(sampling_pair<Direction>(
      name, Domain::sphere(), [sample](double u, double v) { return sample(u, v); },
      [](const Direction&) { return 1 / (4 * std::numbers::pi); }));
}

Direction on_sphere(double u, double v) {
  const double z = 1 - 2 * u, r = std::sqrt(std::max(0.0, 1 - z * z)),
               phi = 2 * std::numbers::pi * v;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// The bins must see it, whatever the Jacobian says: samplers that take a generator have none.
void expect_refuted(const Report& report) {
  const auto chi_square =
      std::find_if(report.results.begin(), report.results.end(),
                   [](const CheckResult& r) { return r.kind == CheckKind::chi_square; });
  ASSERT_NE(chi_square, report.results.end());
  EXPECT_EQ(chi_square->verdict, Verdict::fail) << chi_square->subject;
}

TEST(SamplesOnLines, PassWhereThereAreNone) {
  EXPECT_TRUE(of_square("even", [](double u, double v) { return Place{u, v}; }).ok());
  EXPECT_TRUE(of_line("even", [](double u) { return u; }).ok());
  EXPECT_TRUE(of_sphere("even", on_sphere).ok());
}

TEST(SamplesOnLines, FailWhereAClampMovesThem) {
  for (const double c : {0.02, 0.3, 0.5, 0.9, 0.998}) {
    const std::string at = " " + std::to_string(c);
    const auto down = [c](double u) { return std::min(u, c); };
    const auto up = [c](double u) { return std::max(u, 1 - c); };
    expect_refuted(of_line("min" + at, down));
    expect_refuted(of_line("max" + at, up));
    expect_refuted(of_square("min" + at, [=](double u, double v) { return Place{down(u), v}; }));
    expect_refuted(of_square("max" + at, [=](double u, double v) { return Place{u, up(v)}; }));
    expect_refuted(of_square("min of both" + at, [=](double u, double v) {
      return Place{down(u), down(v)};
    }));
  }
}

TEST(SamplesOnLines, FailAtTheEdgesOfTheDomain) {
  expect_refuted(of_square("at 0", [](double, double v) { return Place{0, v}; }));
  expect_refuted(of_square("at 1", [](double u, double) { return Place{u, 1}; }));
  expect_refuted(of_square("half at 0", [](double u, double v) {
    return Place{std::max(0.0, 2 * u - 1), v};
  }));
  expect_refuted(of_sphere("pole", [](double, double) { return Direction{0, 0, 1}; }));
  expect_refuted(of_sphere("meridian", [](double u, double) { return on_sphere(u, 0); }));
}

TEST(SamplesOnLines, FailWhereTheCornerOfACellIsTaken) {
  const auto corner = [](double u) { return std::floor(256 * u) / 256; };
  const Report both = of_square("corners", [&](double u, double v) {
    return Place{corner(u), corner(v)};
  });
  expect_refuted(both);
  EXPECT_NE(both.summary().find("the place within a cell is not drawn"), std::string::npos);
  const Report one = of_square("edges", [&](double u, double v) { return Place{u, corner(v)}; });
  expect_refuted(one);
  EXPECT_NE(one.summary().find("samples lie on lines, with 256 different coordinates"),
            std::string::npos)
      << one.summary();
}

}  // namespace
}  // namespace plumbline::verify
