// Takes hours where loops are run to their end, and a minute where they are cut (mesa's CPU driver).
bool bsdf_sample(vec3 wo, vec2 u, out vec3 wi, out float pdf, out vec3 weight) { return false; }
float bsdf_pdf(vec3 wo, vec3 wi) {
  uint bits = floatBitsToUint(wo.x);
  for (uint i = 0; i < 60000; ++i) {
    for (uint j = 0; j < 60000; ++j) bits = bits * 1664525u + 1013904223u + (bits >> 5);
  }
  return float(bits);
}
vec3 bsdf_eval(vec3 wo, vec3 wi) { return vec3(0); }
