#pragma once

#include <cstddef>

#include <plumbline/renderer/core/render/path.h>

namespace plumbline::renderer {

inline constexpr std::size_t kBsdfTechnique = 0;
inline constexpr std::size_t kLightTechnique = 1;

/// Direct light at the end of one camera ray, by one sample of one technique.
struct DirectSample {
  Rgbf emission;        ///< of the surface itself towards the camera [W/(m² sr)]
  Rgbf value;           ///< light reflected there, over `pdf`: f·cos·radiance/pdf, black if none
  float pdf = 1;        ///< pdf_w [1/sr] of the technique that drew it; the mass of an atom
  float other_pdf = 0;  ///< pdf_w of the other technique for the same point
};

/// @param ray        from Camera::ray
/// @param technique  kBsdfTechnique: a direction from the BSDF; kLightTechnique: a point on a light
/// @param u          in [0, 1)²
/// @return           value averages to the reflected light that the technique can find
DirectSample sample_direct_light(const Scene& scene, const Ray& ray, std::size_t technique,
                                 const Vec2f& u, PathCounters& counters);

}  // namespace plumbline::renderer
