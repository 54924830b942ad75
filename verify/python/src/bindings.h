#pragma once

#include <pybind11/pybind11.h>

namespace plumbline::python {

/// `CheckResult`, `Report`, `ImageResult`: what checks return.
void bind_results(pybind11::module_& module);

/// `Domain`, `ContractOptions`, `PairLobe`, `SamplingPair` and `check_pair`.
void bind_pairs(pybind11::module_& module);

/// `BsdfOptions`, `Bsdf` and `check_bsdf`.
void bind_bsdfs(pybind11::module_& module);

/// Means, agreement, ratios, proportions, images.
void bind_estimates(pybind11::module_& module);

}  // namespace plumbline::python
