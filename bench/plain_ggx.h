#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include <plumbline/renderer/core/bsdf/bsdf_sample.h>

namespace plumbline::bench {

/// The yardstick of the BSDFs' speed: an isotropic GGX conductor with constant reflectance in plain
/// float with libm, as a textbook has it. Angles and normals are formed where the equations have
/// them, nothing is shared between sample, eval and pdf.
struct PlainGgx {
  float alpha;
  renderer::Rgbf reflectance;

  struct Sample {
    renderer::Vec3f wi;
    renderer::Rgbf weight;
    float pdf_w;
  };

  /// @source Walter et al. 2007, Eq. 33
  float distribution(const renderer::Vec3f& h) const {
    const float cos2 = h.z * h.z, a2 = alpha * alpha;
    const float d = cos2 * (a2 - 1) + 1;
    return a2 / (std::numbers::pi_v<float> * d * d);
  }

  /// @source Walter et al. 2007, Eq. 34
  float masking(const renderer::Vec3f& w) const {
    const float tan2 = (1 - w.z * w.z) / (w.z * w.z);
    return 2 / (1 + std::sqrt(1 + alpha * alpha * tan2));
  }

  renderer::Rgbf eval(const renderer::Vec3f& wo, const renderer::Vec3f& wi) const {
    if (!(wo.z > 0 && wi.z > 0)) return {};
    const renderer::Vec3f h = normalize(wo + wi);
    return reflectance * (distribution(h) * masking(wo) * masking(wi) / (4 * wo.z * wi.z));
  }

  float pdf(const renderer::Vec3f& wo, const renderer::Vec3f& wi) const {
    if (!(wo.z > 0 && wi.z > 0)) return 0;
    const renderer::Vec3f h = normalize(wo + wi);
    return masking(wo) * distribution(h) / (4 * wo.z);
  }

  renderer::BsdfValue<float> evaluate(const renderer::Vec3f& wo, const renderer::Vec3f& wi) const {
    return {eval(wo, wi), pdf(wo, wi)};
  }

  /// @source Heitz 2018 (JCGT 7:4), Listing 1
  std::optional<Sample> sample(const renderer::Vec3f& wo, const renderer::Vec2f& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const renderer::Vec3f v = normalize(renderer::Vec3f{alpha * wo.x, alpha * wo.y, wo.z});
    const float length2 = v.x * v.x + v.y * v.y;
    const renderer::Vec3f t1 =
        length2 > 0 ? renderer::Vec3f{-v.y, v.x, 0} / std::sqrt(length2) : renderer::Vec3f{1, 0, 0};
    const renderer::Vec3f t2 = cross(v, t1);
    const float r = std::sqrt(u.x), phi = 2 * std::numbers::pi_v<float> * u.y;
    const float p1 = r * std::cos(phi), s = 0.5f * (1 + v.z);
    const float p2 = (1 - s) * std::sqrt(1 - p1 * p1) + s * r * std::sin(phi);
    const renderer::Vec3f n =
        t1 * p1 + t2 * p2 + v * std::sqrt(std::fmax(0.0f, 1 - p1 * p1 - p2 * p2));
    const renderer::Vec3f h =
        normalize(renderer::Vec3f{alpha * n.x, alpha * n.y, std::fmax(0.0f, n.z)});
    const renderer::Vec3f wi = h * (2 * dot(wo, h)) - wo;
    if (!(wi.z > 0)) return std::nullopt;
    return Sample{wi, reflectance * masking(wi), pdf(wo, wi)};
  }
};

}  // namespace plumbline::bench
