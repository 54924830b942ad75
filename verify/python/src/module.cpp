#include <pybind11/pybind11.h>

#include "bindings.h"

/// The compiled part of the Python package `plumbline`, which holds what people call.
PYBIND11_MODULE(_core, module) {
  plumbline::python::bind_results(module);
  plumbline::python::bind_pairs(module);
  plumbline::python::bind_bsdfs(module);
  plumbline::python::bind_estimates(module);
}
