#version 450
#extension GL_GOOGLE_include_directive : require
// What host.cpp runs: rows of a query of docs/protocol.md in, rows of its answer out, one to an invocation.
//
//   glslangValidator -V -I. verify.comp -o mine.spv   (-I: the folder of mine.glsl)
//
// mine.glsl has, in the conventions of docs/conventions.md (z the normal; wo and wi unit, away from the surface):
//
//   bool bsdf_sample(vec3 wo, vec2 u, out vec3 wi, out float pdf, out vec3 weight);  // false: no sample
//   float bsdf_pdf(vec3 wo, vec3 wi);  // [1/sr]
//   vec3 bsdf_eval(vec3 wo, vec3 wi);  // f [1/sr], without the cosine
//
// weight is f |cosθi| / pdf. `#define NUMBERS 3` if u is a vec3, 1 if it is a float.
#include "mine.glsl"

#ifndef NUMBERS
#define NUMBERS 2
#endif

layout(local_size_x = 64) in;
layout(push_constant) uniform Query {
  uint kind;  // 0: what takes the shader? 1: sample, 2: pdf, 3: eval
  uint rows;
} query;
// Arrays of numbers, without the padding of an array of vec3.
layout(std430, binding = 0) readonly buffer Outgoing { float wo[]; };      // (rows, 3)
layout(std430, binding = 1) readonly buffer Given { float given[]; };      // u (rows, NUMBERS) or wi (rows, 3)
layout(std430, binding = 2) writeonly buffer Incoming { float wi[]; };     // (rows, 3)
layout(std430, binding = 3) writeonly buffer Density { float pdf[]; };     // (rows,)
layout(std430, binding = 4) writeonly buffer Value { float value[]; };     // weight or f, (rows, 3)
layout(std430, binding = 5) writeonly buffer Accepted { uint accepted[]; };  // (rows,); NUMBERS for kind 0

vec3 wo_of(uint row) { return vec3(wo[3 * row], wo[3 * row + 1], wo[3 * row + 2]); }
vec3 wi_of(uint row) { return vec3(given[3 * row], given[3 * row + 1], given[3 * row + 2]); }
#if NUMBERS == 1
float u_of(uint row) { return given[row]; }
#elif NUMBERS == 2
vec2 u_of(uint row) { return vec2(given[2 * row], given[2 * row + 1]); }
#else
vec3 u_of(uint row) { return wi_of(row); }
#endif

void put_value(uint row, vec3 v) {
  for (int i = 0; i < 3; ++i) value[3 * row + i] = v[i];
}

void answer_sample(uint row) {
  vec3 direction = vec3(0), weight = vec3(0);
  float density = 0;
  accepted[row] = bsdf_sample(wo_of(row), u_of(row), direction, density, weight) ? 1u : 0u;
  for (int i = 0; i < 3; ++i) wi[3 * row + i] = direction[i];
  pdf[row] = density;
  put_value(row, weight);
}

void main() {
  const uint row = gl_GlobalInvocationID.x;
  if (row >= query.rows) return;
  if (query.kind == 0) accepted[row] = NUMBERS;
  if (query.kind == 1) answer_sample(row);
  if (query.kind == 2) pdf[row] = bsdf_pdf(wo_of(row), wi_of(row));
  if (query.kind == 3) put_value(row, bsdf_eval(wo_of(row), wi_of(row)));
}
