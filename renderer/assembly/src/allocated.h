#pragma once

#include <plumbline/renderer/assembly/render.h>

namespace plumbline::renderer {

/// @throws InputError for other options that do not fit an allocation
void check_allocation(const RenderOptions& options);

/// `render` with an allocation.
RenderResult render_allocated(const Scene& scene, const RenderOptions& options);

}  // namespace plumbline::renderer
