#pragma once

#include <memory>

#include <plumbline/renderer/batched/bsdf_kernels.h>
#include <plumbline/renderer/core/bsdf/bsdf_table.h>

namespace plumbline::renderer {

/// The loops of the batched backend for all types of the list.
///
/// @return nullptr for a table that is no BsdfSet
std::unique_ptr<BsdfKernels> batched_bsdfs(const BsdfTable& table);

}  // namespace plumbline::renderer
