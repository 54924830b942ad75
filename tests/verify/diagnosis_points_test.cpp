#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "diagnosis_cases.h"
#include "vec3.h"

/// Faults of warps, maps and lights, named for what they are.
namespace plumbline::verify {
namespace {

using std::numbers::pi;

SamplingPair directions(std::string name, std::function<Vec3(double, double)> sample,
                        std::function<double(const Vec3&)> pdf) {
  return sampling_pair<Vec3>(std::move(name), Domain::sphere(), std::move(sample), std::move(pdf));
}

std::vector<FaultyCase> points() {
  using K = CauseKind;
  std::vector<FaultyCase> list;
  const auto sphere = [](double u, double v) {
    const double z = 1 - 2 * u, r = std::sqrt(1 - z * z);
    return Vec3{r * std::cos(2 * pi * v), r * std::sin(2 * pi * v), z};
  };
  list.push_back(of("uniform sphere as 1/(2π)", K::constant,
                    directions("", sphere, [](const Vec3&) { return 1 / (2 * pi); })));
  list.push_back(of("map without sinθ", K::sine,
                    directions(
                        "",
                        [](double u, double v) {
                          const double t = pi * u;
                          return Vec3{std::sin(t) * std::cos(2 * pi * v),
                                      std::sin(t) * std::sin(2 * pi * v), std::cos(t)};
                        },
                        [](const Vec3&) { return 1 / (2 * pi * pi); })));
  list.push_back(of("disk without the root", K::radius,
                    sampling_pair<Vec3>(
                        "", Domain::disk(),
                        [](double u, double v) {
                          return Vec3{u * std::cos(2 * pi * v), u * std::sin(2 * pi * v), 0};
                        },
                        [](const Vec3&) { return 1 / pi; })));
  list.push_back(of("triangle without the root", K::radius,
                    sampling_pair<Vec3>(
                        "", Domain::triangle(),
                        [](double u, double v) {
                          return Vec3{u * (1 - v), u * v, 0};
                        },
                        [](const Vec3&) { return 2.0; })));
  const auto hg = [](double c, double g) {
    return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * c, 1.5));
  };
  list.push_back(of("g with the other sign", K::mirrored,
                    directions(
                        "",
                        [](double u, double v) {
                          const double g = 0.6, q = (1 - g * g) / (1 - g + 2 * g * u);
                          const double c = (1 + g * g - q * q) / (2 * g);
                          const double s = std::sqrt(std::max(0.0, 1 - c * c));
                          return Vec3{s * std::cos(2 * pi * v), s * std::sin(2 * pi * v), c};
                        },
                        [hg](const Vec3& w) { return hg(w[2], -0.6); })));
  // A table of 16 columns, looked up one column on.
  const auto table = [](double x) { return x < 1 ? 0.5 + std::floor(16 * x) / 15 : 1.5; };
  list.push_back(of("table read a cell on", K::shifted,
                    sampling_pair<Vec3>(
                        "", Domain::interval(),
                        [table](double u) {
                          double left = u * 16;
                          for (int i = 0; i < 16; ++i) {
                            const double p = table((i + 0.5) / 16);
                            if (left < p) return Vec3{(i + left / p) / 16, 0, 0};
                            left -= p;
                          }
                          return Vec3{1 - 1e-12, 0, 0};
                        },
                        [table](const Vec3& x) {
                          const double y = x[0] + 1.0 / 16;
                          return table(y - std::floor(y));
                        })));
  SamplingPair light = rectangle();
  light.pdf = [](const Vec3&) { return kLightArea; };
  list.push_back(of("area of a light", K::distance_or_area, light));
  // A square of side 2 in the plane z = 1, over the origin: area for solid angle.
  list.push_back(of("area for solid angle", K::distance_or_area,
                    directions(
                        "",
                        [](double u, double v) {
                          return unit(Vec3{2 * u - 1, 2 * v - 1, 1});
                        },
                        [](const Vec3& w) {
                          const bool hits =
                              w[2] > 0 && std::abs(w[0]) <= w[2] && std::abs(w[1]) <= w[2];
                          return hits ? 0.25 : 0.0;
                        })));
  // Two lights in a row: which one, and where on it, by the same number.
  list.push_back(of("number reused", K::numbers_reused,
                    sampling_pair<Vec3>(
                        "", Domain::unit_square(),
                        [](double u, double v) {
                          return Vec3{u < 0.3 ? u / 2 : 0.5 + u / 2, v, 0};
                        },
                        [](const Vec3& x) { return x[0] < 0.5 ? 0.6 : 1.4; })));
  list.push_back(
      of("sides exchanged", K::constant_per_hemisphere,
         directions(
             "",
             [](double u, double v) {
               const bool up = u < 0.7;
               const double r = up ? u / 0.7 : (u - 0.7) / 0.3, s = std::sqrt(r);
               const double z = std::sqrt(1 - r);
               return Vec3{s * std::cos(2 * pi * v), s * std::sin(2 * pi * v), up ? z : -z};
             },
             [](const Vec3& w) { return (w[2] > 0 ? 0.3 : 0.7) * std::abs(w[2]) / pi; })));
  list.push_back(of("not folded", K::not_rejected,
                    sampling_pair<Vec3>(
                        "", Domain::triangle(),
                        [](double u, double v) {
                          return Vec3{u, v, 0};
                        },
                        [](const Vec3& x) { return x[0] + x[1] <= 1 ? 2.0 : 0.0; })));
  list.push_back(
      of("middles of cells", K::on_a_line,
         sampling_pair<Vec3>(
             "", Domain::unit_square(),
             [](double u, double v) {
               return Vec3{(std::floor(16 * u) + 0.5) / 16, (std::floor(8 * v) + 0.5) / 8, 0};
             },
             [](const Vec3&) { return 1.0; })));
  list.push_back(of("clamped", K::on_a_line,
                    directions(
                        "",
                        [sphere](double u, double v) {
                          Vec3 w = sphere(u, v);
                          if (w[2] > 0.9) {
                            const double r = std::sqrt(1 - 0.81) / std::hypot(w[0], w[1]);
                            w = {w[0] * r, w[1] * r, 0.9};
                          }
                          return w;
                        },
                        [](const Vec3&) { return 1 / (4 * pi); })));
  return list;
}

/// Choices out of sets, random numbers that enter as a power, records without a probability.
std::vector<FaultyCase> choices_and_numbers() {
  using K = CauseKind;
  std::vector<FaultyCase> list;
  const std::vector<double> shares{0.1, 0.2, 0.3, 0.4};
  const auto item_at = [shares](double u) {
    std::size_t i = 0;
    while (i + 1 < shares.size() && u >= shares[i]) u -= shares[i++];
    return Vec3{static_cast<double>(i), 0, 0};
  };
  const auto set = [&](const char* name, K kind, const std::function<double(std::size_t)>& pmf) {
    list.push_back(of(
        name, kind,
        sampling_pair<Vec3>("", Domain::discrete(shares.size()), item_at,
                            [pmf](const Vec3& x) { return pmf(static_cast<std::size_t>(x[0])); })));
  };
  set("pmf without the weight", K::choice_probability, [](std::size_t) { return 0.25; });
  set("pmf of another item's weight", K::choice_probability,
      [shares](std::size_t i) { return shares[i] * shares[i] / 0.3; });
  set("density of a table for its probability", K::constant,
      [shares](std::size_t i) { return 4 * shares[i]; });
  // Two levels, the number of the first not stretched for the second: the last of each way only.
  list.push_back(of("tree, number not stretched", K::numbers_reused,
                    sampling_pair<Vec3>(
                        "", Domain::discrete(4),
                        [](double u) {
                          return Vec3{(u < 0.5 ? 0.0 : 2.0) + (u < 0.5 ? 0.0 : 1.0), 0, 0};
                        },
                        [](const Vec3& x) { return x[0] < 1 || x[0] > 2 ? 0.3 : 0.2; })));
  // A cap around an axis of its own: u where u² belongs shows in no coordinate, but in u.
  const Vec3 axis = unit({1, 2, 3});
  const auto cap = [axis](double u, double v) {
    const Vec3 s = unit(cross(axis, {1, 0, 0})), t = cross(axis, s);
    const double c = 1 - 0.3 * u, r = std::sqrt(std::max(0.0, 1 - c * c));
    const double x = r * std::cos(2 * pi * v), y = r * std::sin(2 * pi * v);
    return Vec3{c * axis[0] + x * s[0] + y * t[0], c * axis[1] + x * s[1] + y * t[1],
                c * axis[2] + x * s[2] + y * t[2]};
  };
  const auto even = [axis](const Vec3& w) { return dot(w, axis) > 0.7 ? 1 / (2 * pi * 0.3) : 0.0; };
  list.push_back(of("cap, number squared", K::radius,
                    directions(
                        "", [cap](double u, double v) { return cap(u * u, v); }, even)));
  return list;
}

TEST(Diagnosis, NamesFaultsOfChoicesAndNumbers) { expect_named(choices_and_numbers()); }

TEST(Diagnosis, NamesFaultsOfWarpsMapsAndLights) { expect_named(points()); }

}  // namespace
}  // namespace plumbline::verify
