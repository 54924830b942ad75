#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/pair.h>

#include "bindings.h"
#include "function.h"

namespace plumbline::python {

namespace {

using verify::Atom;
using verify::ContractOptions;
using verify::Domain;
using verify::PairLobe;
using verify::SamplingPair;

/// How points of a domain look in arrays.
Layout layout_of(const Domain& domain, Number number) {
  if (domain.dimension() == 0) return {1, true, Number::int64};
  if (domain.dimension() == 1) return {1, true, number};
  return {domain.directions() ? 3 : 2, false, number};
}

Number arithmetic(bool single) { return single ? Number::float32 : Number::float64; }

double rounding_unit(bool single) { return single ? 0x1p-24 : 0x1p-53; }

/// What a sampler returns: of a discrete domain integers, from numbers of the arithmetic stated.
Layout answer_of(const Domain& domain, bool single) {
  Layout layout = layout_of(domain, arithmetic(single));
  layout.number = arithmetic(single);
  return layout;
}

Layout numbers_layout(int numbers, bool single) { return {numbers, false, arithmetic(single)}; }

PairLobe make_lobe(const Domain& domain, std::string name, double probability,
                   const py::object& sample, const py::object& pdf, int numbers, bool single) {
  PairLobe lobe;
  lobe.name = std::move(name);
  lobe.probability = probability;
  const Layout answer = answer_of(domain, single);
  assign(lobe.sample, sample, "sample of " + lobe.name, {numbers_layout(numbers, single)}, answer);
  assign(lobe.pdf, pdf, "pdf of " + lobe.name, {layout_of(domain, arithmetic(single))}, answer);
  return lobe;
}

SamplingPair make_pair(std::string name, const Domain& domain, const py::object& sample,
                       const py::object& pdf, const py::object& value, int numbers, bool single) {
  SamplingPair pair;
  pair.name = std::move(name);
  pair.domain = domain;
  pair.numbers = numbers;
  pair.epsilon = rounding_unit(single);
  const Layout answer = answer_of(domain, single);
  const Layout point = layout_of(domain, arithmetic(single));
  assign(pair.sample, sample, "sample", {numbers_layout(numbers, single)}, answer);
  assign(pair.pdf, pdf, "pdf", {point}, answer);
  assign(pair.value, value, "value", {point}, answer);
  return pair;
}

/// A factor of the pdf, for the diagnosis.
void add_pair_suspect(SamplingPair& pair, const std::string& name, const py::object& value) {
  verify::Many<double(Triple)> function;
  assign(function, value, "suspect " + name,
         {layout_of(pair.domain, arithmetic(pair.epsilon > 0x1p-40))},
         answer_of(pair.domain, pair.epsilon > 0x1p-40));
  pair.suspects.push_back({name, [function](const Triple& x) { return function(x); }});
}

void bind_domain(py::module_& module) {
  py::class_<Domain>(module, "Domain", "Where a sampling pair lives, with the measure of its pdf.")
      .def_static("interval", &Domain::interval, py::arg("low") = 0.0, py::arg("high") = 1.0,
                  "[low, high]: points (n,), pdf per unit.")
      .def_static("discrete", &Domain::discrete, py::arg("size"),
                  "0, 1, …, size - 1: points (n,) of int64, a probability each.")
      .def_static("unit_square", &Domain::unit_square, "[0, 1]²: points (n, 2), pdf per area.")
      .def_static("disk", &Domain::disk, py::arg("radius") = 1.0,
                  "Around the origin: points (n, 2), pdf per area.")
      .def_static(
          "triangle", &Domain::triangle,
          "x, y >= 0, x + y <= 1: barycentric points (n, 2), pdf per their area (½ in all).")
      .def_static("sphere", &Domain::sphere, "Unit directions (n, 3), pdf per steradian.")
      .def_static("hemisphere", &Domain::hemisphere, py::arg("upper") = true,
                  "Unit directions (n, 3) with z >= 0 (upper) or z <= 0, pdf per steradian.")
      .def_static("equirectangular", &Domain::equirectangular, py::arg("columns"), py::arg("rows"),
                  py::arg("up") = Triple{0, 0, 1}, py::arg("start") = Triple{1, 0, 0},
                  "Unit directions (n, 3), pdf per steradian, with breaks at the pixels of a "
                  "latitude-longitude map.")
      .def_static("octahedral", &Domain::octahedral, py::arg("pixels_per_side"),
                  "Unit directions (n, 3), pdf per steradian, with breaks at the pixels of an "
                  "octahedral map.")
      .def("with_breaks", &Domain::with_breaks, py::arg("first"),
           py::arg("second") = std::vector<double>{},
           "The same with lines at which the pdf jumps or bends, in the chart's square.")
      .def_property_readonly("name", &Domain::name)
      .def_property_readonly("dimension", &Domain::dimension)
      .def("__repr__", [](const Domain& d) { return "<Domain " + d.name() + ">"; });
}

void bind_contract_options(py::module_& module) {
  py::class_<ContractOptions>(module, "ContractOptions")
      .def(py::init<>())
      .def_readwrite("seed", &ContractOptions::seed)
      .def_readwrite("points", &ContractOptions::points)
      .def_readwrite("jacobian_points", &ContractOptions::jacobian_points)
      .def_readwrite("mass_tolerance", &ContractOptions::mass_tolerance)
      .def_readwrite("evaluations", &ContractOptions::evaluations)
      .def_readwrite("first_look", &ContractOptions::first_look)
      .def_readwrite("samples", &ContractOptions::samples)
      .def_readwrite("finest_bins", &ContractOptions::finest_bins)
      .def_readwrite("deviation", &ContractOptions::deviation);
}

}  // namespace

void bind_pairs(py::module_& module) {
  bind_domain(module);
  bind_contract_options(module);
  py::class_<PairLobe>(module, "PairLobe")
      .def(py::init(&make_lobe), py::arg("domain"), py::arg("name"), py::arg("probability"),
           py::arg("sample"), py::arg("pdf"), py::arg("numbers"), py::arg("single"));
  py::class_<SamplingPair>(module, "SamplingPair")
      .def(py::init(&make_pair), py::arg("name"), py::arg("domain"), py::arg("sample"),
           py::arg("pdf"), py::arg("value"), py::arg("numbers"), py::arg("single"))
      .def("add_lobe", [](SamplingPair& p, const PairLobe& lobe) { p.lobes.push_back(lobe); })
      .def("add_atom",
           [](SamplingPair& p, const Triple& x, double mass) {
             p.atoms.push_back({x, mass});
           })
      .def("add_suspect", &add_pair_suspect)
      .def_readwrite("many_to_one", &SamplingPair::many_to_one);
  module.def("check_pair", &verify::check_pair, py::arg("pair"), py::arg("options"));
}

}  // namespace plumbline::python
