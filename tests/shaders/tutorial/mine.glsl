#include "glossy.glsl"

bool bsdf_sample(vec3 wo, vec2 u, out vec3 wi, out float pdf, out vec3 weight) {
  const GlossySample s = glossy_sample(wo, u);
  wi = s.direction, pdf = s.pdf, weight = vec3(s.value);
  return true;
}
float bsdf_pdf(vec3 wo, vec3 wi) { return glossy_pdf(wo, wi); }
vec3 bsdf_eval(vec3 wo, vec3 wi) { return vec3(glossy_value(wo, wi)); }
