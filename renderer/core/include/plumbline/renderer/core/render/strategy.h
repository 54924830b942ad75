#pragma once

namespace plumbline::renderer {

/// How the techniques for direct light are combined at every vertex of a path.
enum class Strategy {
  bsdf,        ///< directions from the BSDF only
  light,       ///< points on lights only
  uniform,     ///< directions uniform on the hemisphere only
  mis,         ///< light samples and BSDF samples, weighted by a heuristic
  one_sample,  ///< light or BSDF, chosen at random (Veach 1997, Section 9.2.4)
  average  ///< half of each: a negative control, wrong wherever only one of them finds the light
};

/// Whether the heuristic has any effect.
constexpr bool uses_heuristic(Strategy strategy) {
  return strategy == Strategy::mis || strategy == Strategy::one_sample;
}

}  // namespace plumbline::renderer
