#include "diagnosis/geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "lattice.h"

/// The quantities that explanations are made of, against what they are by definition: differences,
/// integrals, the laws of reflection and refraction.
namespace plumbline::verify {
namespace {

using std::numbers::pi;

/// Solid angle of a direction's neighbours after a map over that before, by central differences.
double stretch(const std::function<Vec3(const Vec3&)>& map, const Vec3& w) {
  constexpr double kStep = 1e-5;
  const Vec3 s = normalized(cross(std::abs(w[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, w));
  const Vec3 t = cross(w, s);
  const auto along = [&](const Vec3& d) {
    const Vec3 a = map(normalized(sum(w, scaled(d, kStep))));
    const Vec3 b = map(normalized(sum(w, scaled(d, -kStep))));
    return scaled(sum(a, scaled(b, -1)), 1 / (2 * kStep));
  };
  return length(cross(along(s), along(t)));
}

/// By the law of refraction, of a direction that points away from the surface.
/// @param eta  index behind over index before
Vec3 refracted(const Vec3& wo, const Vec3& normal, double eta) {
  const double c = dot(wo, normal);
  const double inside = std::sqrt(1 - (1 - c * c) / (eta * eta));
  return sum(scaled(wo, -1 / eta), scaled(normal, c / eta - inside));
}

constexpr Vec3 kWo{0.48, 0.36, 0.8};

TEST(HalfVector, OfAReflectionIsTheNormalThatMirrors) {
  for (const Vec3& m : even_directions(20, false)) {
    const double c = dot(kWo, m);
    if (c < 0.1) continue;
    const Vec3 wi = sum(scaled(m, 2 * c), scaled(kWo, -1));
    if (wi[2] < 0.05) continue;
    EXPECT_LT(length(sum(half_vector_of(kWo, wi, 1.5), scaled(m, -1))), 1e-14);
    // From behind it is the same line, with z ≥ 0.
    const Vec3 h = half_vector_of(scaled(kWo, -1), scaled(wi, -1), 1.5);
    EXPECT_LT(length(sum(h, scaled(m, -1))), 1e-14);
  }
}

TEST(HalfVector, OfARefractionIsTheNormalThatRefracts) {
  constexpr double kEta = 1.5;
  for (const Vec3& m : even_directions(20, false)) {
    if (dot(kWo, m) < 0.2 || m[2] < 0.5) continue;
    // Seen from above, and the way back.
    const Vec3 wi = refracted(kWo, m, kEta);
    EXPECT_LT(length(sum(half_vector_of(kWo, wi, kEta), scaled(m, -1))), 1e-14);
    EXPECT_LT(length(sum(half_vector_of(wi, kWo, kEta), scaled(m, -1))), 1e-14);
  }
}

TEST(HalfVector, OfOppositeDirectionsIsTheNormal) {
  EXPECT_EQ(half_vector_of({1, 0, 0}, {-1, 0, 0}, 1), (Vec3{0, 0, 1}));
}

TEST(RefractionJacobian, IsWhatTheHalfVectorMovesBy) {
  constexpr double kEta = 1.5;
  for (const Vec3& m : even_directions(20, false)) {
    if (dot(kWo, m) < 0.2 || m[2] < 0.5) continue;
    const Vec3 wi = refracted(kWo, m, kEta);
    const double down = stretch([&](const Vec3& w) { return half_vector_of(kWo, w, kEta); }, wi);
    EXPECT_NEAR(refraction_jacobian(kWo, wi, m, 1, kEta) / down, 1, 1e-8);
    const double up = stretch([&](const Vec3& w) { return half_vector_of(wi, w, kEta); }, kWo);
    EXPECT_NEAR(refraction_jacobian(wi, kWo, m, kEta, 1) / up, 1, 1e-8);
  }
}

TEST(Indices, AreThoseOfTheSideThatADirectionPointsInto) {
  EXPECT_EQ(index_of({0, 0, -1}, 1.5), 1.5);
  EXPECT_EQ(index_of({0, 0, 1}, 1.5), 1);
  EXPECT_TRUE(transmits({0, 0, 1}, {0, 0, -1}));
  EXPECT_TRUE(transmits({0, 0, -1}, {0, 0, 1}));
  EXPECT_FALSE(transmits({0, 0, -1}, {0, 0, -1}));
  EXPECT_FALSE(transmits({0, 0, 1}, {1, 0, 0}));
}

/// ∫ f dω above the horizon.
double over_hemisphere(const std::function<double(const Vec3&)>& f) {
  constexpr int kSteps = 400, kTurns = 64;
  double total = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double theta = pi / 2 * (i + 0.5) / kSteps, r = std::sin(theta);
    for (int j = 0; j < kTurns; ++j) {
      const double phi = 2 * pi * (j + 0.5) / kTurns;
      total += f({r * std::cos(phi), r * std::sin(phi), std::cos(theta)}) * r;
    }
  }
  return total * pi / 2 * 2 * pi / (kSteps * kTurns);
}

/// What makes a distribution of normals one: their projected area is that of the surface, and the
/// visible ones cover what is seen of it. @source Heitz 2014 (JCGT 3:2), Eqs. 11 and 17
TEST(Microfacets, CoverTheSurface) {
  for (const double alpha : {0.3, 0.8}) {
    // Midpoints of steps h err by h²/24 of the integrand's slope at the ends, 2/α² at the normal;
    // turns at a clamp by h² of the same size.
    constexpr double kError = 5e-5;
    EXPECT_NEAR(over_hemisphere([&](const Vec3& h) { return ggx_d(h, alpha) * h[2]; }), 1, kError);
    EXPECT_NEAR(over_hemisphere([&](const Vec3& h) { return beckmann_d(h, alpha) * h[2]; }), 1,
                kError);
    const double seen = over_hemisphere([&](const Vec3& h) {
      return smith_g1(kWo, alpha) * ggx_d(h, alpha) * std::max(0.0, dot(kWo, h));
    });
    EXPECT_NEAR(seen, kWo[2], kError) << alpha;
  }
}

/// At the normal, at Brewster's angle and beyond the critical one; between them against Snell's and
/// Fresnel's laws with both angles.
TEST(Fresnel, OfADielectricHasItsKnownValues) {
  EXPECT_NEAR(fresnel_dielectric(1, 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnel_dielectric(1, 1 / 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnel_dielectric(-1, 1.5), 0.04, 1e-15);
  EXPECT_EQ(fresnel_dielectric(0.5, 1 / 1.5), 1);
  EXPECT_NEAR(fresnel_dielectric(0, 1.5), 1, 1e-15);
  // tan² of both angles' sum and difference, halved with sin²; parallel light is let through whole.
  const double brewster = std::atan(1.5), inside = pi / 2 - brewster;
  EXPECT_NEAR(fresnel_dielectric(std::cos(brewster), 1.5),
              std::pow(std::sin(brewster - inside), 2) / 2, 1e-15);
  const double angle = 0.6, below = std::asin(std::sin(angle) / 1.33);
  const double s = std::sin(angle - below) / std::sin(angle + below);
  const double p = std::tan(angle - below) / std::tan(angle + below);
  EXPECT_NEAR(fresnel_dielectric(std::cos(angle), 1.33), (s * s + p * p) / 2, 1e-15);
}

TEST(Fresnel, OfSchlickIsAFifthPower) {
  EXPECT_EQ(fresnel_schlick(1, 0.04), 0.04);
  EXPECT_EQ(fresnel_schlick(0, 0.04), 1);
  EXPECT_NEAR(fresnel_schlick(0.5, 0.04), 0.04 + 0.96 / 32, 1e-15);
  EXPECT_NEAR(fresnel_schlick(-0.5, 0.04), 0.04 + 0.96 / 32, 1e-15);
}

}  // namespace
}  // namespace plumbline::verify
