#pragma once

#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/scene/scene.h>

namespace plumbline::tools {

/// Says on standard error what of an image that has been written is no number: samples that were
/// left out because they were not finite, and variances beyond single precision.
///
/// @return whether all are
bool check_numbers(const renderer::Scene& scene, const renderer::RenderOptions& options,
                   const renderer::RenderResult& result);

}  // namespace plumbline::tools
