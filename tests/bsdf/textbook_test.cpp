#include <gtest/gtest.h>
#include <plumbline_tests/directions.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <plumbline/renderer/core/bsdf/ggx_dielectric.h>
#include <plumbline/verify/detail/random.h>

/// Rough glass by value, from both sides, reflected and refracted, against the formulas as they are
/// printed.
namespace plumbline::tests {
namespace {

using namespace renderer;

constexpr float kRoughness = 0.3f;
constexpr double kAlpha{kRoughness};

/// Λ of Smith's masking. @source Heitz 2014, Eq. 72
double lambda(const Vec3d& w) {
  const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return (std::sqrt(1 + kAlpha * kAlpha * tan2) - 1) / 2;
}

/// @source Walter et al. 2007, Eq. 33
double distribution(const Vec3d& h) {
  const double c2 = h.z * h.z, a2 = kAlpha * kAlpha;
  return a2 / (std::numbers::pi * std::pow(1 + (a2 - 1) * c2, 2));
}

/// Of unpolarised light. @param e  index behind over index before
double reflectance(double cosine, double e) {
  const double sine2 = (1 - cosine * cosine) / (e * e);
  if (sine2 >= 1) return 1;
  const double t = std::sqrt(1 - sine2);
  const double s = (cosine - e * t) / (cosine + e * t), p = (e * cosine - t) / (e * cosine + t);
  return (s * s + p * p) / 2;
}

/// f for radiance, with G = G1(wo) G1(wi). @source Walter et al. 2007, Eqs. 16, 20 and 21
double printed(Vec3d wo, Vec3d wi, double eta) {
  const double e = wo.z > 0 ? eta : 1 / eta;
  if (wo.z < 0) wo.z = -wo.z, wi.z = -wi.z;
  const bool reflected = wi.z > 0;
  Vec3d h = reflected ? wo + wi : -(wo + wi * e);
  h = normalize(h.z < 0 ? -h : h);
  const double o = dot(wo, h), i = dot(wi, h);
  if (!(o > 0) || reflected != (i > 0)) return 0;
  const double dg = distribution(h) / ((1 + lambda(wo)) * (1 + lambda(wi)));
  if (reflected) return reflectance(o, e) * dg / (4 * wo.z * wi.z);
  return (1 - reflectance(o, e)) * dg * o * -i / (wo.z * -wi.z * std::pow(o + e * i, 2));
}

template <class T>
void expect_as_printed(const GgxDielectric& glass, double eta, double tolerance) {
  verify::Random random(check_seed("textbook/" + std::to_string(eta)));
  const auto cosine = [&] {
    const double z = 0.05 + 0.9 * random.uniform();
    return random.uniform() < 0.5 ? z : -z;
  };
  int positive = 0;
  for (int k = 0; k < 4000; ++k) {
    const auto direction = [&] {
      const double z = cosine(), r = std::sqrt(1 - z * z),
                   phi = 2 * pi<double>() * random.uniform();
      return vec_cast<T>(Vec3d{r * std::cos(phi), r * std::sin(phi), z});
    };
    const Vec3<T> wo = direction(), wi = direction();
    const double expected = printed(vec_cast<double>(wo), vec_cast<double>(wi), eta);
    const double actual = static_cast<double>(glass.evaluate(wo, wi).f.g);
    positive += expected > 1e-3 ? 1 : 0;
    // Next to the critical angle and to where a normal turns its back a digit decides.
    EXPECT_NEAR(actual, expected, tolerance * std::max(expected, 1.0))
        << "eta " << eta << " cosθo " << static_cast<double>(wo.z) << " cosθi "
        << static_cast<double>(wi.z);
  }
  EXPECT_GT(positive, 200);
}

TEST(RoughGlass, IsAsPrintedFromBothSides) {
  for (const float eta : {1.5f, 1 / 1.5f, 1.05f}) {
    const GgxDielectric glass{{kRoughness, kRoughness}, BareInterface{eta}};
    expect_as_printed<double>(glass, static_cast<double>(eta), 1e-7);
    expect_as_printed<float>(glass, static_cast<double>(eta), 2e-3);
  }
}

}  // namespace
}  // namespace plumbline::tests
