#pragma once

#include <algorithm>
#include <cmath>

#include "tiny_vector.h"

namespace tiny {

/// A glossy reflection: half vectors with density (n + 2)/2π · cosθh^(n+1), wi mirrored at them.
struct Glossy {
  static constexpr float kPi = 3.14159265f;
  float exponent = 20;
  float albedo = 0.8f;

  struct Sample {
    Vector direction;
    float value;  ///< f · cosθi
    float pdf;    ///< 0: no direction could be sampled
  };

  Sample sample(const Vector& wo, float u1, float u2) const {
    const float cosine = std::pow(1 - u1, 1 / (exponent + 2)), phi = 2 * kPi * u2;
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    const Vector h(sine * std::cos(phi), cosine, sine * std::sin(phi));
    const Vector wi = 2 * dot(wo, h) * h + -1 * wo;
    return {wi, eval(wo, wi), pdf(wo, wi)};
  }

  float pdf(const Vector& wo, const Vector& wi) const {
    if (wo[1] <= 0 || wi[1] <= 0) return 0;
    const Vector h = half_vector(wo, wi);
    const float pdf_h = (exponent + 2) / (2 * kPi) * std::pow(h[1], exponent + 1);
    return pdf_h / (4 * dot(wo, h));  // dωi = 4 (wo·h) dωh
  }

  /// Returns f · cosθi.
  float eval(const Vector& wo, const Vector& wi) const {
    if (wo[1] <= 0 || wi[1] <= 0) return 0;
    const float d = (exponent + 2) / (2 * kPi) * std::pow(half_vector(wo, wi)[1], exponent);
    return albedo * d / (4 * std::max(wo[1], wi[1])) * wi[1];
  }

  static Vector half_vector(const Vector& wo, const Vector& wi) {
    const Vector sum = wo + wi;
    return 1 / std::sqrt(dot(sum, sum)) * sum;
  }
};

}  // namespace tiny
