#pragma once

#include <plumbline/renderer/math.h>

namespace plumbline::renderer {

/// Which part of a BSDF a sample came from.
enum class Lobe { diffuse };

/// One sampled direction of a BSDF.
template <class T>
struct BsdfSample {
  Vec3<T> wi;     ///< unit, local frame, away from the surface
  Rgb<T> weight;  ///< f·|cosθi|/pdf_w [1], finite also where f and pdf_w are not
  T pdf_w;        ///< [1/sr], the same value as pdf(wo, wi)
  Lobe lobe;
};

}  // namespace plumbline::renderer
