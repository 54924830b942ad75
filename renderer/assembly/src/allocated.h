#pragma once

#include <plumbline/renderer/assembly/render.h>

namespace plumbline::renderer {

/// `render` with an allocation.
RenderResult render_allocated(const Scene& scene, const RenderOptions& options);

}  // namespace plumbline::renderer
