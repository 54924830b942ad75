const float kPi = 3.14159265, kExponent = 20, kAlbedo = 0.8;

struct GlossySample {
  vec3 direction;
  float value;  // f · cosθi
  float pdf;    // 0: no direction could be sampled
};

float glossy_pdf(vec3 wo, vec3 wi) {
  if (wo.y <= 0 || wi.y <= 0) return 0;
  const vec3 h = normalize(wo + wi);
  const float pdf_h = (kExponent + 2) / (2 * kPi) * pow(h.y, kExponent + 1);
  return pdf_h / (4 * dot(wo, h));  // dωi = 4 (wo·h) dωh
}

// f · cosθi
float glossy_value(vec3 wo, vec3 wi) {
  if (wo.y <= 0 || wi.y <= 0) return 0;
  const vec3 h = normalize(wo + wi);
  const float d = (kExponent + 2) / (2 * kPi) * pow(h.y, kExponent);
  return kAlbedo * d / (4 * max(wo.y, wi.y)) * wi.y;
}

GlossySample glossy_sample(vec3 wo, vec2 u) {
  const float cosine = pow(1 - u.x, 1 / (kExponent + 2)), phi = 2 * kPi * u.y;
  const float sine = sqrt(max(0, 1 - cosine * cosine));
  const vec3 wi = reflect(-wo, vec3(sine * cos(phi), cosine, sine * sin(phi)));
  return GlossySample(wi, glossy_value(wo, wi), glossy_pdf(wo, wi));
}
