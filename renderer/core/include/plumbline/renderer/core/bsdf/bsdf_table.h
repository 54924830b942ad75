#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <plumbline/renderer/core/bsdf/bsdf_sample.h>

namespace plumbline::renderer {

/// The BSDFs of a scene, by index, as the integrator asks them: in float. Which types there are is
/// decided above the core (assembly/bsdf.h).
///
/// Directions are unit vectors in the local frame, pointing away from the surface.
class BsdfTable {
 public:
  virtual ~BsdfTable() = default;

  virtual std::size_t size() const = 0;

  virtual const BsdfParts& parts(std::uint32_t bsdf) const = 0;

  /// @return f [1/sr], without the cosine, for radiance: across a refraction it holds (η_o/η_i)²;
  ///         and pdf_w [1/sr] of `sample`, finite, ≥ 0. Atoms do not show
  virtual BsdfValue<float> evaluate(std::uint32_t bsdf, const Vec3f& wo, const Vec3f& wi) const = 0;

  /// @param u  in [0, 1)²
  /// @return   nullopt where there is nothing to sample from wo, or u leads below the horizon
  virtual std::optional<BsdfSample<float>> sample(std::uint32_t bsdf, const Vec3f& wo,
                                                  const Vec2f& u) const = 0;
};

}  // namespace plumbline::renderer
