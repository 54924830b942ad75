// GGX microfacet normals around +z with Smith's masking. Before it is included: const vec2 kAlpha, the roughness.
#include "warps.glsl"

/// S(w) = |(αx x, αy y, z)|
float stretched_length(vec3 w) { return length(vec3(kAlpha * w.xy, w.z)); }

/// |z| + S(w), with which G1(w) = 2 |z| / (|z| + S(w)): Heitz 2014 (JCGT 3:2), Eq. 86.
float visible_area(vec3 w) { return abs(w.z) + stretched_length(w); }

float masking(vec3 w) { return 2 * abs(w.z) / visible_area(w); }

/// D(h) [1/sr] of a unit normal: Heitz 2014, Eq. 85.
float normal_density(vec3 h) {
  const vec3 s = vec3(h.xy / kAlpha, h.z);
  const float s2 = dot(s, s);
  return 1 / (kPi * kAlpha.x * kAlpha.y * s2 * s2);
}

/// Density [1/sr] of the normals that wo (z > 0) sees: D (wo·h) G1(wo)/cosθo. Heitz 2018 (JCGT 7:4), Eq. 3.
float visible_density(vec3 wo, vec3 h) {
  return 2 * dot(wo, h) * normal_density(h) / visible_area(wo);
}

/// Such a normal: Dupuy, Benyoub 2023, "Sampling visible GGX normals with spherical caps", Listing 3.
vec3 sample_visible_normal(vec3 wo, vec2 u) {
  const vec3 w = normalize(vec3(kAlpha * wo.xy, wo.z));
  // The cap z = 1 - t of the sphere. 1 - z² is a product, and so is 1 - w.z: nothing cancels.
  const float t = u.y * (1 + w.z), rest = (1 - u.y) * (1 + w.z);
  const float one_minus_wz = dot(w.xy, w.xy) / (1 + w.z);
  const vec2 c = sqrt(t * (one_minus_wz + rest)) * cos_sin_turns(u.x);
  return normalize(vec3(kAlpha * (c + w.xy), rest));
}
