// Rough gold: single scattering between GGX microfacets; black from behind. Faults for the tests: 1, the half
// vector's Jacobian 1/(4 wo·h) forgotten in the pdf; 2, 1/cosθi forgotten in f.
const vec2 kAlpha = vec2(0.2, 0.4);
const vec3 kEta = vec3(0.18, 0.42, 1.37), kAbsorption = vec3(3.42, 2.35, 1.77);
#ifndef FAULT
#define FAULT 0
#endif
#include "ggx_normals.glsl"

/// Born, Wolf, Principles of Optics, Section 14.2: reflectance where η + ik is the index.
float fresnel_conductor(float c, float eta, float k) {
  const float c2 = c * c, s2 = 1 - c2;
  const float t = (eta - k) * (eta + k) - s2;
  const float m = sqrt(t * t + 4 * eta * eta * k * k);  // a² + b², where (a + ib)² = (η + ik)² - s2
  const float larger = sqrt((m + abs(t)) / 2);
  const float a = t > 0 ? larger : eta * k / larger;  // a² = (m + t)/2 would cancel
  const float cross_s = 2 * a * c, cross_p = cross_s * s2;
  const float s = (m + c2 - cross_s) / (m + c2 + cross_s);
  return s * (1 + (c2 * m + s2 * s2 - cross_p) / (c2 * m + s2 * s2 + cross_p)) / 2;
}

vec3 fresnel(float c) {
  return vec3(fresnel_conductor(c, kEta.r, kAbsorption.r), fresnel_conductor(c, kEta.g, kAbsorption.g),
              fresnel_conductor(c, kEta.b, kAbsorption.b));
}

float bsdf_pdf(vec3 wo, vec3 wi) {
  if (wo.z <= 0 || wi.z <= 0) return 0;
  const vec3 h = normalize(wo + wi);
#if FAULT == 1
  return visible_density(wo, h);
#else
  return visible_density(wo, h) / (4 * dot(wo, h));  // Walter et al. 2007, Eq. 14
#endif
}

/// Walter et al. 2007, Eq. 20: F D G/(4 cosθo cosθi), where G1/cosθ = 2/visible_area.
vec3 bsdf_eval(vec3 wo, vec3 wi) {
  if (wo.z <= 0 || wi.z <= 0) return vec3(0);
  const vec3 h = normalize(wo + wi);
  const vec3 f = fresnel(dot(wo, h)) * normal_density(h) / (visible_area(wo) * visible_area(wi));
#if FAULT == 2
  return f * wi.z;
#else
  return f;
#endif
}

bool bsdf_sample(vec3 wo, vec2 u, out vec3 wi, out float pdf, out vec3 weight) {
  if (wo.z <= 0) return false;
  const vec3 h = sample_visible_normal(wo, u);
  wi = 2 * dot(wo, h) * h - wo;
  pdf = bsdf_pdf(wo, wi);
  weight = fresnel(dot(wo, h)) * masking(wi);  // Heitz 2018, Eq. 19
  return wi.z > 0;
}
