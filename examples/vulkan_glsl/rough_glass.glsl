// Rough glass: GGX microfacets that reflect or refract, from both sides; f is for radiance, it holds 1/η² across a
// refraction. u.xy give the normal, u.z whether it reflects. Walter et al. 2007, "Microfacet models for refraction
// through rough surfaces". Faults for the tests: 1, η² forgotten in the Jacobian of refraction in the pdf; 2, 1/η²
// forgotten in f and in the weight.
#define NUMBERS 3
const vec2 kAlpha = vec2(0.3, 0.5);
const float kEta = 1.5;  // index inside (z < 0) over index outside
#ifndef FAULT
#define FAULT 0
#endif
#include "ggx_normals.glsl"

/// What wo sees: the frame mirrored so that wo is above, and η the index below over the one above.
struct Side {
  float flip, eta;
};
Side side_of(vec3 wo) { return wo.z > 0 ? Side(1, kEta) : Side(-1, 1 / kEta); }
vec3 flipped(vec3 w, Side side) { return vec3(w.xy, side.flip * w.z); }

/// g = η cosθt; 0 where all is reflected.
float refracted_cosine(float c, float eta) { return sqrt(max((eta - 1) * (eta + 1) + c * c, 0)); }

/// Eq. 22, with g - c = (η² - 1)/(g + c).
float fresnel(float c, float eta) {
  const float g = refracted_cosine(c, eta);
  if (g == 0) return 1;
  const float sum = g + c, difference = (eta - 1) * (eta + 1) / sum;
  const float s = difference / sum, p = (c * sum - 1) / (c * difference + 1);
  return s * s * (1 + p * p) / 2;
}

/// The normal between two directions in wo's frame, Eqs. 13 and 16; false if it shows one of them its back.
bool half_vector(vec3 wo, vec3 wi, float eta, out vec3 h) {
  h = normalize(wi.z > 0 ? wo + wi : wo + eta * wi);
  if (h.z < 0) h = -h;
  return dot(wo, h) > 0 && dot(wi, h) * wi.z > 0;
}

/// |dh/dwi| of refraction, Eq. 17.
float refraction_jacobian(float o, float i, float eta) {
  const float sum = o + eta * i;
  return eta * eta * abs(i) / (sum * sum);
}

float bsdf_pdf(vec3 wo, vec3 wi) {
  const Side side = side_of(wo);
  const vec3 o = flipped(wo, side), i = flipped(wi, side);
  vec3 h;
  if (o.z * i.z == 0 || !half_vector(o, i, side.eta, h)) return 0;
  const float f = fresnel(dot(o, h), side.eta), d = visible_density(o, h);
  if (i.z > 0) return f * d / (4 * dot(o, h));
  const float jacobian = refraction_jacobian(dot(o, h), dot(i, h), side.eta);
#if FAULT == 1
  return (1 - f) * d * jacobian / (side.eta * side.eta);
#else
  return (1 - f) * d * jacobian;
#endif
}

/// Eqs. 20 and 21, where G1/cosθ = 2/visible_area.
vec3 bsdf_eval(vec3 wo, vec3 wi) {
  const Side side = side_of(wo);
  const vec3 o = flipped(wo, side), i = flipped(wi, side);
  vec3 h;
  if (o.z * i.z == 0 || !half_vector(o, i, side.eta, h)) return vec3(0);
  const float f = fresnel(dot(o, h), side.eta);
  const float facets = normal_density(h) / (visible_area(o) * visible_area(i));
  if (i.z > 0) return vec3(f * facets);
  const float jacobian = refraction_jacobian(dot(o, h), dot(i, h), side.eta);
  const float for_power = 4 * dot(o, h) * (1 - f) * facets * jacobian;
#if FAULT == 2
  return vec3(for_power);
#else
  return vec3(for_power / (side.eta * side.eta));
#endif
}

bool bsdf_sample(vec3 wo, vec3 u, out vec3 wi, out float pdf, out vec3 weight) {
  if (wo.z == 0) return false;
  const Side side = side_of(wo);
  const vec3 o = flipped(wo, side), h = sample_visible_normal(o, u.xy);
  const float c = dot(o, h);
  const bool reflects = u.z < fresnel(c, side.eta);
  // Refraction by Eq. 40, with c - g = -(η² - 1)/(c + g).
  const float along = (side.eta - 1) * (side.eta + 1) / (c + refracted_cosine(c, side.eta));
  const vec3 i = reflects ? 2 * c * h - o : -(along * h + o) / side.eta;
  wi = flipped(i, side);
  pdf = bsdf_pdf(wo, wi);
#if FAULT == 2
  weight = vec3(masking(i));
#else
  weight = vec3(masking(i) / (reflects ? 1 : side.eta * side.eta));
#endif
  return reflects ? i.z > 0 : i.z < 0;
}
