#pragma once

#include <optional>

#include <plumbline/renderer/core/scene/embree.h>
#include <plumbline/renderer/core/scene/ray.h>
#include <plumbline/renderer/core/scene/ray_engine.h>
#include "tables.h"

/// All by the best instruction set that this machine has, and the same bits by every one.
namespace plumbline::renderer::brute_force {

/// Sixteen rays side by side, primitive after primitive.
void intersect(const Tables& tables, RTCRayHit16& rays);
void occluded(const Tables& tables, RTCRay16& rays);

/// One ray, primitives side by side: from the same numbers, compared in the same order, and hence
/// with the same bits.
std::optional<PrimitiveHit> intersect(const Tables& tables, const Ray& ray);
bool occluded(const Tables& tables, const Ray& ray);

}  // namespace plumbline::renderer::brute_force
