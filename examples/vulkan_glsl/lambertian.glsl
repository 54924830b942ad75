// Diffuse reflection on the side of the normal. Faults for the tests: 1, 1/π forgotten in the pdf; 2, the cosine.
#ifndef FAULT
#define FAULT 0
#endif
#include "warps.glsl"

const vec3 kAlbedo = vec3(0.5, 0.2, 0.8);

float bsdf_pdf(vec3 wo, vec3 wi) {
  if (wo.z <= 0 || wi.z <= 0) return 0;
#if FAULT == 1
  return wi.z;
#elif FAULT == 2
  return 1 / kPi;
#else
  return wi.z / kPi;
#endif
}

vec3 bsdf_eval(vec3 wo, vec3 wi) { return wo.z > 0 && wi.z > 0 ? kAlbedo / kPi : vec3(0); }

bool bsdf_sample(vec3 wo, vec2 u, out vec3 wi, out float pdf, out vec3 weight) {
  wi = vec3(sqrt(u.x) * cos_sin_turns(u.y), sqrt(1 - u.x));
  pdf = bsdf_pdf(wo, wi);
  weight = kAlbedo;
  return wo.z > 0 && wi.z > 0;
}
