#include <plumbline/verify/pair.h>

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/bsdf/lambertian.h>
#include <plumbline/renderer/core/light/light.h>
#include <plumbline/renderer/core/sampling/warps.h>
#include <plumbline_tests/support.h>

/// Chi-square of the directions that the renderer samples, in float as rendered, against the
/// density that it states for them.
namespace plumbline::tests {
namespace {

using renderer::Light;
using renderer::Vec2f;
using renderer::Vec3f;

template <class Density, class Sampler>
void check(const std::string& subject, const Density& density, const Sampler& sampler,
           verify::Verdict expected = verify::Verdict::pass) {
  verify::ContractOptions options;
  options.seed = check_seed(subject);
  verify::CheckResult result = verify::check_chi_square<Vec3f>(subject, density, sampler, options);
  result.expected = expected;
  expect_verdict(std::move(result));
}

TEST(ChiSquare, LambertianSamplesFollowTheirDensity) {
  const renderer::Lambertian bsdf{{0.5f, 0.5f, 0.5f}};
  for (const Vec3f& wo : {Vec3f{0, 0, 1}, normalize(Vec3f{0.9f, 0.1f, 0.1f})}) {
    check(
        wo.z == 1 ? "lambertian/0 degrees" : "lambertian/84 degrees",
        [&](const Vec3f& wi) { return bsdf.pdf(wo, wi); },
        [&](float u1, float u2) -> std::optional<Vec3f> {
          const auto sample = bsdf.sample(wo, Vec2f{u1, u2});
          if (!sample) return std::nullopt;
          return sample->wi;
        });
  }
}

TEST(ChiSquare, UniformHemisphereSamplesFollowTheirDensity) {
  check(
      "uniform hemisphere",
      [](const Vec3f& w) { return renderer::square_to_uniform_hemisphere_pdf_w(w); },
      [](float u1, float u2) -> std::optional<Vec3f> {
        return renderer::square_to_uniform_hemisphere(Vec2f{u1, u2});
      });
}

/// Lights as seen from a point beside them, so that no symmetry hides an error.
const std::vector<std::pair<std::string, Light>>& lights() {
  static const renderer::Rgbf white{1, 1, 1};
  static const std::vector<std::pair<std::string, Light>> all{
      {"sphere light", renderer::SphereLight{{0.5f, 1, 3}, 0.7f, false, white}},
      {"sphere light from inside", renderer::SphereLight{{0.5f, 1, 0}, 2, true, white}},
      {"rectangle light",
       renderer::RectangleLight{{-1, -0.5f, 2}, {2, 0, 0}, {0, 1.5f, 0}, {0, 0, -1}, white}},
      {"disk light", renderer::DiskLight{{0.5f, 0.3f, 1}, {0, 0, -1}, 1, white}},
      {"triangle light",
       renderer::TriangleLight{{-1, 0, 2}, {2, 0.5f, 0}, {0.25f, 2, 0}, {0, 0, -1}, white}},
      {"constant environment", renderer::ConstantEnvironment{white}}};
  return all;
}

const Vec3f kReference{0.1f, -0.2f, 0.3f};

std::optional<Vec3f> sample_direction(const Light& light, float u1, float u2) {
  const auto sample = renderer::sample(light, kReference, Vec2f{u1, u2});
  if (!sample) return std::nullopt;
  return sample->wi;
}

TEST(ChiSquare, LightSamplesFollowTheirDensity) {
  for (const auto& [subject, light] : lights()) {
    check(
        subject, [&](const Vec3f& wi) { return pdf(light, kReference, wi); },
        [&](float u1, float u2) { return sample_direction(light, u1, u2); });
  }
}

TEST(ChiSquare, AnAreaDensityTakenForASolidAngleDensityFails) {
  const auto light = std::get<renderer::RectangleLight>(lights()[2].second);
  check(
      "control/rectangle light, density by area",
      [&](const Vec3f& wi) { return light.pdf(kReference, wi) > 0 ? 1 / light.area<float>() : 0; },
      [&](float u1, float u2) { return sample_direction(light, u1, u2); }, verify::Verdict::fail);
}

TEST(ChiSquare, ALambertianDensityWithoutOneOverPiFails) {
  check(
      "control/lambertian, density without 1/pi",
      [](const Vec3f& wi) { return std::max(wi.z, 0.0f); },
      [](float u1, float u2) -> std::optional<Vec3f> {
        return renderer::square_to_cosine_hemisphere(Vec2f{u1, u2});
      },
      verify::Verdict::fail);
}

}  // namespace
}  // namespace plumbline::tests
