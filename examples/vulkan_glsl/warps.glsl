#ifndef WARPS_GLSL
#define WARPS_GLSL

const float kPi = 3.14159265358979;

/// cos and sin of 2πu, u in [0, 1], by Taylor's series on an eighth of a turn; both are off by less than 1e-7.
///
/// Vulkan promises no more than 2^-11 of cos() and sin(): a direction that is off by 5e-4 is not where its pdf is.
vec2 cos_sin_turns(float u) {
  const float quarter = floor(4 * u + 0.5);
  const float x = 2 * kPi * (u - 0.25 * quarter), x2 = x * x;
  const float s = x * (1 - x2 / 6 * (1 - x2 / 20 * (1 - x2 / 42 * (1 - x2 / 72))));
  const float c = 1 - x2 / 2 * (1 - x2 / 12 * (1 - x2 / 30 * (1 - x2 / 56 * (1 - x2 / 90))));
  const int q = int(quarter) & 3;
  return q == 0 ? vec2(c, s) : q == 1 ? vec2(-s, c) : q == 2 ? vec2(-c, -s) : vec2(s, -c);
}

#endif
