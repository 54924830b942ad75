#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/pair.h>

/// Pairs from plain maps: weights and values, many numbers, inverses.
namespace plumbline::verify {
namespace {

constexpr double kPi = std::numbers::pi;

ContractOptions options_of(const std::string& name) {
  ContractOptions options = tests::contract_options(name);
  options.points = 2'000;
  return options;
}

CheckResult result_of(const Report& report, CheckKind kind) {
  for (const CheckResult& r : report) {
    if (r.kind == kind) return r;
  }
  ADD_FAILURE() << "no " << to_string(kind) << " check";
  return {};
}

struct Rgb {
  double r, g, b;
};

/// A point on a light as a renderer's record of it.
struct LightSample {
  double position;
  Rgb weight;
  double pdf;
};

/// Density 2x on [0, 1] for a radiance in three colours.
SamplingPair light(const std::string& name, double factor_of_green, double factor_of_pdf = 1) {
  const auto radiance = [](double x) { return Rgb{x, x * x, 0.5 * x + 1e-3}; };
  const auto pdf = [](double x) { return 2 * x; };
  const auto sample = [=](double u) {
    const double x = std::sqrt(1 - u);  // never 0
    const Rgb L = radiance(x);
    const double p = pdf(x);
    return LightSample{x, {L.r / p, factor_of_green * L.g / p, L.b / p}, factor_of_pdf * p};
  };
  return sampling_pair<double>(name, Domain::interval(), sample, pdf, radiance);
}

TEST(PlainPairs, HoldWeightAndDensityOfARecordToValueAndPdf) {
  const Report right = check_pair(light("right", 1), options_of("right"));
  EXPECT_TRUE(right.ok()) << right.summary();
  EXPECT_EQ(result_of(right, CheckKind::weight).verdict, Verdict::pass);
  EXPECT_EQ(result_of(right, CheckKind::record_pdf).verdict, Verdict::pass);
  const Report green = check_pair(light("green", 1.01), options_of("green"));
  EXPECT_EQ(result_of(green, CheckKind::weight).verdict, Verdict::fail);
  const Report other = check_pair(light("pdf", 1, 1.01), options_of("pdf"));
  EXPECT_EQ(result_of(other, CheckKind::record_pdf).verdict, Verdict::fail);
}

/// The mean of as many numbers as the map takes has the density of Irwin and Hall; here of five.
double density_of_five(double x) {
  // Σ (−1)^k C(5, k) (5x − k)₊⁴ / 4!, times 5 for the mean.
  double sum = 0, binomial = 1;
  for (int k = 0; k <= 5; ++k) {
    const double t = std::max(0.0, 5 * x - k);
    sum += (k % 2 == 0 ? 1 : -1) * binomial * std::pow(t, 4);
    binomial = binomial * (5 - k) / (k + 1);
  }
  return x < 0 || x > 1 ? 0 : std::max(0.0, 5 * sum / 24);
}

template <class T>
SamplingPair mean_of_five(const std::string& name, T lost) {
  return sampling_pair<T>(
      name, Domain::interval(),
      [lost](T a, T b, T c, T d, T e) { return (a + b + c + d + lost * e) / 5; },
      [](T x) { return density_of_five(x); });
}

TEST(PlainPairs, TakeMoreNumbersThanThree) {
  for (const SamplingPair& pair :
       {mean_of_five<double>("five", 1), mean_of_five<float>("five in float", 1)}) {
    const Report report = check_pair(pair, options_of(pair.name));
    EXPECT_TRUE(report.ok()) << report.summary();
  }
  EXPECT_EQ(check_chi_square(mean_of_five<double>("lost", 0.9), options_of("lost")).verdict,
            Verdict::fail);
}

template <class T>
using Point = std::array<T, 2>;

/// Shirley and Chiu's concentric map of the square onto the disk, and back.
template <class T>
Point<T> concentric(T u, T v) {
  const T a = 2 * u - 1, b = 2 * v - 1, quarter = T(kPi / 4);
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const T r = wide ? a : b;
  const T phi = wide ? quarter * (b / a) : T(kPi / 2) - quarter * (a / b);
  return {r * std::cos(phi), r * std::sin(phi)};
}

template <class T>
Point<T> square_of(const Point<T>& p) {
  const T quarter = T(kPi / 4);
  const T r = std::hypot(p[0], p[1]);
  const bool wide = std::abs(p[0]) > std::abs(p[1]);
  if (r == 0) return {T(0.5), T(0.5)};
  T a = 0, b = 0;
  if (wide) {
    a = std::copysign(r, p[0]);
    b = a * std::atan(p[1] / p[0]) / quarter;
  } else {
    b = std::copysign(r, p[1]);
    a = b * std::atan(p[0] / p[1]) / quarter;
  }
  return {std::clamp((a + 1) / 2, T(0), T(1)), std::clamp((b + 1) / 2, T(0), T(1))};
}

template <class T, class Inverse>
SamplingPair disk(const std::string& name, Inverse inverse) {
  const SamplingPair pair = sampling_pair<Point<T>>(
      name, Domain::disk(), [](T u, T v) { return concentric(u, v); },
      [](const Point<T>&) { return T(1 / kPi); });
  return with_inverse<Point<T>>(pair, inverse);
}

TEST(Inverse, PassesARoundTrip) {
  for (const SamplingPair& pair :
       {disk<double>("disk", square_of<double>), disk<float>("disk in float", square_of<float>)}) {
    const Report report = check_pair(pair, options_of(pair.name));
    EXPECT_TRUE(report.ok()) << report.summary();
    EXPECT_EQ(result_of(report, CheckKind::inverse).verdict, Verdict::pass);
  }
}

TEST(Inverse, PassesSteepMapsAndAnyOfSeveralWays) {
  // x = u⁸ has an inverse of infinite slope; a tent has two ways, and one of them is enough.
  const SamplingPair steep =
      with_inverse<double>(sampling_pair<double>(
                               "steep", Domain::interval(), [](double u) { return std::pow(u, 8); },
                               [](double x) { return std::pow(x, -7.0 / 8) / 8; }),
                           [](double x) { return std::pow(x, 1.0 / 8); });
  const SamplingPair tent = with_inverse<double>(
      sampling_pair<double>(
          "tent", Domain::interval(), [](double u) { return 1 - std::abs(2 * u - 1); },
          [](double) { return 1.0; }),
      [](double x) { return x / 2; });
  for (const SamplingPair& pair : {steep, tent}) {
    const CheckResult r = check_inverse(pair, options_of(pair.name));
    EXPECT_EQ(r.verdict, Verdict::pass) << describe(r);
  }
}

struct Wrong {
  const char* name;
  Point<double> (*inverse)(const Point<double>&);
};

TEST(Inverse, FailsWhatLeadsElsewhere) {
  const Wrong cases[] = {
      {"mirrored",
       [](const Point<double>& p) {
         return square_of<double>({p[0], -p[1]});
       }},
      {"exchanged",
       [](const Point<double>& p) {
         const auto u = square_of(p);
         return Point<double>{u[1], u[0]};
       }},
      {"a pixel off",
       [](const Point<double>& p) {
         const auto u = square_of(p);
         return Point<double>{std::min(u[0] + 1.0 / 4096, 1.0), u[1]};
       }},
      {"polar",
       [](const Point<double>& p) {
         return Point<double>{p[0] * p[0] + p[1] * p[1], std::atan2(p[1], p[0]) / (2 * kPi) + 0.5};
       }},
      {"a quarter only",
       [](const Point<double>& p) {
         return square_of<double>({std::abs(p[0]), std::abs(p[1])});
       }},
      {"outside",
       [](const Point<double>& p) {
         return Point<double>{p[0], p[1]};
       }},
      {"rounded",
       [](const Point<double>& p) {
         const auto u = square_of(p);
         return Point<double>{double(float(u[0])), double(float(u[1]))};
       }},
      {"not a number",
       [](const Point<double>&) {
         return Point<double>{NAN, 0.5};
       }},
  };
  for (const Wrong& wrong : cases) {
    const CheckResult r =
        check_inverse(disk<double>(wrong.name, wrong.inverse), options_of(wrong.name));
    EXPECT_EQ(r.verdict, Verdict::fail) << describe(r);
    EXPECT_FALSE(r.reason.empty());
  }
}

TEST(Inverse, NeedsAMapOfNumbers) {
  EXPECT_THROW(check_inverse(light("none", 1)), std::invalid_argument);
  const SamplingPair draws =
      with_inverse<double>(mean_of_five<double>("draws", 1), [](double x) { return x; });
  EXPECT_THROW(check_inverse(draws), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::verify
