#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <optional>
#include <string>

#include <plumbline/renderer/bsdf/lambertian.h>
#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/jacobian_autodiff.h>

/// The Lambertian through the whole battery, chi-square included, from both faces.
namespace plumbline::tests {
namespace {

using renderer::Vec2;
using renderer::Vec3;

const renderer::Lambertian kGray{{0.2f, 0.5f, 0.8f}};

template <class T>
std::vector<verify::CheckResult> battery(const std::string& name) {
  verify::BsdfOptions options;
  options.contract.seed = check_seed(name);
  options.albedo = [](const verify::Vec3& wo) {
    return wo[2] > 0 ? static_cast<double>(kGray.albedo.r) : 0.0;
  };
  return verify::check_bsdf<Vec3<T>, Vec2<T>>(name, kGray, options);
}

TEST(Lambertian, KeepsTheContractInFloatAsRendered) {
  for (const verify::CheckResult& r : battery<float>("lambertian/float")) expect_verdict(r);
}

TEST(Lambertian, KeepsTheContractInDouble) {
  for (const verify::CheckResult& r : battery<double>("lambertian/double")) expect_verdict(r);
}

TEST(Lambertian, PdfIsTheInverseJacobianOfSample) {
  const auto sample = [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    const auto s = kGray.sample(Vec3<T>{T(0.6), T(0), T(0.8)}, Vec2<T>{u, T(v)});
    return s ? std::optional<Vec3<T>>(s->wi) : std::nullopt;
  };
  const auto pdf = [](const verify::Vec3& wi) {
    return kGray.pdf(renderer::Vec3d{0.6, 0, 0.8}, verify::from_vec3<renderer::Vec3d>(wi));
  };
  verify::AutodiffOptions options;
  options.seed = check_seed("lambertian/autodiff");
  expect_verdict(
      check_jacobian_autodiff("lambertian", verify::Domain::hemisphere(), sample, pdf, options));
}

}  // namespace
}  // namespace plumbline::tests
