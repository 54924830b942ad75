#pragma once

#include <limits>
#include <optional>

#include <plumbline/renderer/core/light/light_sample.h>
#include <plumbline/renderer/core/sampling/warps.h>

namespace plumbline::renderer {

/// The same radiance from every direction, infinitely far away; sampled uniformly on the sphere.
struct ConstantEnvironment {
  Rgbf radiance;

  /// @param u  in [0, 1)²; the reference point does not matter
  template <class T>
  std::optional<LightSample<T>> sample(const Vec3<T>&, const Vec2<T>& u) const {
    const Vec3<T> wi = square_to_uniform_sphere(u);
    return LightSample<T>{wi, T(std::numeric_limits<float>::infinity()), T(1),
                          rgb_cast<T>(radiance), square_to_uniform_sphere_pdf_w(wi)};
  }

  /// @return pdf_w [1/sr] of `sample(ref, u)`
  template <class T>
  T pdf(const Vec3<T>&, const Vec3<T>& wi) const {
    return square_to_uniform_sphere_pdf_w(wi);
  }
};

}  // namespace plumbline::renderer
