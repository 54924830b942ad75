// The example, but π is 3.1416: what no check of an example's own tolerance sees.
#define WARPS_GLSL
const float kPi = 3.1416;
vec2 cos_sin_turns(float u) { return vec2(cos(2 * kPi * u), sin(2 * kPi * u)); }
#include "ggx.glsl"
