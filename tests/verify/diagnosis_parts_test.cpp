#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "diagnosis/parts.h"
#include "diagnosis_cases.h"

/// Faults of samplers that are taken apart: by the number that chooses, by their branches, by where
/// their densities have moved.
namespace plumbline::verify {
namespace {

using std::numbers::pi;

SamplingPair directions(std::function<Vec3(double, double)> sample,
                        std::function<double(const Vec3&)> pdf, Domain domain = Domain::sphere()) {
  return sampling_pair<Vec3>("", std::move(domain), std::move(sample), std::move(pdf));
}

Vec3 around(double cosine, double turns) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return {sine * std::cos(2 * pi * turns), sine * std::sin(2 * pi * turns), cosine};
}

/// A lobe ∝ ((1 + cosθ)/2)^n around ±z.
Vec3 lobe(double n, bool up, double u, double v) {
  const Vec3 w = around(2 * std::pow(u, 1 / (n + 1)) - 1, v);
  return {w[0], w[1], up ? w[2] : -w[2]};
}
double lobe_pdf(double n, bool up, const Vec3& w) {
  return (n + 1) / (4 * pi) * std::pow((1 + (up ? w[2] : -w[2])) / 2, n);
}

constexpr double kUp = 0.3;

/// @param stretched  the number that has chosen is brought back to [0, 1)
SamplingPair two_lobes(double share_in_pdf, bool stretched) {
  return directions(
      [=](double u, double v) {
        const bool up = u < kUp;
        const double again = !stretched ? u : up ? u / kUp : (u - kUp) / (1 - kUp);
        // The other way round, so that the lobes do not meet where one number passes to the next.
        return lobe(up ? 6 : 2, up, up ? again : 1 - again, v);
      },
      [=](const Vec3& w) {
        return share_in_pdf * lobe_pdf(6, true, w) + (1 - share_in_pdf) * lobe_pdf(2, false, w);
      });
}

std::vector<FaultyCase> samplers() {
  using K = CauseKind;
  std::vector<FaultyCase> list;
  list.push_back(
      of("two lobes, other shares in the pdf", K::lobe_probability, two_lobes(0.5, true)));
  list.push_back(
      of("two lobes, the number not stretched", K::numbers_reused, two_lobes(kUp, false)));
  // Around a tilted axis; what lies below the horizon is folded up.
  const double c = std::cos(1.2), s = std::sin(1.2);
  list.push_back(of("folded up at the horizon", K::not_rejected,
                    directions(
                        [=](double u, double v) {
                          const Vec3 w = lobe(4, true, u, v);
                          return Vec3{c * w[0] + s * w[2], w[1], std::abs(c * w[2] - s * w[0])};
                        },
                        [=](const Vec3& w) {
                          return lobe_pdf(4, true, {0, 0, s * w[0] + c * w[2]});
                        },
                        Domain::hemisphere())));
  list.push_back(of("around another axis", K::tangent_frame,
                    directions([](double u, double v) { return lobe(8, true, u, v); },
                               [=](const Vec3& w) {
                                 return lobe_pdf(8, true, {0, 0, s * w[0] + c * w[2]});
                               })));
  list.push_back(
      of("moved along a line", K::shifted,
         sampling_pair<double>(
             "", Domain::interval(0, 4), [](double u) { return 1.5 + std::tan((u - 0.5) * 1.8); },
             [](double x) {
               const double t = x - 1.1;
               return 1 / (1.8 * (1 + t * t));
             })));
  // Of a sphere of radius 1 in a distance of 3, by its area.
  list.push_back(of("spherical light without its cosine", K::distance_or_area,
                    directions(
                        [](double u, double v) {
                          const Vec3 n = around(-(1.0 / 3) - (2.0 / 3) * u, v);
                          const Vec3 p{n[0], n[1], 3 + n[2]};
                          const double d = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
                          return Vec3{p[0] / d, p[1] / d, p[2] / d};
                        },
                        [](const Vec3& w) {
                          const double root = 1 - 9 * (1 - w[2] * w[2]);
                          if (w[2] < 0 || root < 0) return 0.0;
                          const double d = 3 * w[2] - std::sqrt(root);
                          return d * d / (2 * pi * 2 / 3);
                        })));
  return list;
}

TEST(Parts, AreFoundWhereOneNumberJumps) {
  const Parts parts = parts_of(two_lobes(kUp, true));
  ASSERT_EQ(parts.count(), 2u);
  EXPECT_EQ(parts.chooser, 0u);
  EXPECT_NEAR(parts.share(0), kUp, 1e-6);
}

TEST(Parts, AreNoneOfASmoothMap) {
  const auto smooth = [](double u, double v) { return lobe(3, true, u, v); };
  const SamplingPair pair = directions(smooth, [](const Vec3&) { return 1.0; });
  const Parts parts = parts_of(pair);
  EXPECT_EQ(parts.count(), 1u);
  EXPECT_FALSE(choice_is_used_again(pair, parts)) << "nothing is chosen";
}

TEST(Parts, FarTooManyAreAChoiceUsedAgain) {
  const auto in_cells = [](double u, double v) {
    return lobe(3, true, std::fmod(64 * u, 1), (std::floor(64 * u) + v) / 64);
  };
  const SamplingPair pair = directions(in_cells, [](const Vec3&) { return 1.0; });
  EXPECT_TRUE(choice_is_used_again(pair, parts_of(pair)));
}

TEST(Diagnosis, TakesSamplersApart) { expect_named(samplers()); }

}  // namespace
}  // namespace plumbline::verify
