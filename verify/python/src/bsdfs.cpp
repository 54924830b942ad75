#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/conventions.h>

#include "bindings.h"
#include "function.h"

namespace plumbline::python {

namespace {

using verify::BsdfLobe;
using verify::BsdfOptions;
using verify::ErasedBsdf;
using verify::Many;

/// Directions and numbers in the arithmetic of the code under test.
struct Arithmetic {
  Layout direction, numbers;

  Arithmetic(bool single, int numbers_per_sample)
      : direction{3, false, single ? Number::float32 : Number::float64},
        numbers{numbers_per_sample, false, direction.number} {}
};

ErasedBsdf make_bsdf(const py::object& sample, const py::object& pdf, const py::object& eval,
                     int numbers, bool single) {
  const Arithmetic a(single, numbers);
  ErasedBsdf bsdf;
  bsdf.epsilon = single ? 0x1p-24 : 0x1p-53;
  bsdf.numbers = numbers;
  assign(bsdf.sample, sample, "sample", {a.direction, a.numbers}, a.direction);
  assign(bsdf.pdf, pdf, "pdf", {a.direction, a.direction}, a.direction);
  assign(bsdf.eval, eval, "eval", {a.direction, a.direction}, a.direction);
  return bsdf;
}

/// A function of wo alone, which `verify` asks for one direction at a time.
auto of_given(const py::object& f, std::string name, const Layout& direction) {
  Many<double(Triple)> function;
  assign(function, f, std::move(name), {direction}, direction);
  return [function](const Triple& wo) { return function(wo); };
}

void add_bsdf_lobe(ErasedBsdf& bsdf, const py::object& probability, const py::object& sample,
                   const py::object& pdf, int numbers) {
  const Arithmetic a(bsdf.epsilon > 0x1p-40, numbers);
  const std::string of = " of lobe " + std::to_string(bsdf.lobes.size());
  BsdfLobe lobe;
  lobe.numbers = numbers;
  lobe.probability = of_given(probability, "probability" + of, a.direction);
  assign(lobe.sample, sample, "sample" + of, {a.direction, a.numbers}, a.direction);
  assign(lobe.pdf, pdf, "pdf" + of, {a.direction, a.direction}, a.direction);
  bsdf.lobes.push_back(std::move(lobe));
}

// `albedo` and `suspects` are not translated by conventions: they take the checks' directions.

void set_albedo(BsdfOptions& options, const py::object& albedo, bool single) {
  options.albedo = of_given(albedo, "albedo", Arithmetic(single, 2).direction);
}

void add_bsdf_suspect(BsdfOptions& options, const std::string& name, const py::object& value,
                      bool single) {
  const Layout direction = Arithmetic(single, 2).direction;
  Many<double(Triple, Triple)> f;
  assign(f, value, "suspect " + name, {direction, direction}, direction);
  options.suspects.push_back({name, [f](const Triple& wo, const Triple& wi) { return f(wo, wi); }});
}

py::dict convention_words() {
  py::dict words;
  for (const verify::conventions::Word& known : verify::conventions::words()) {
    words[py::str(std::string(known.word))] = std::string(known.meaning);
  }
  words["normal:X,Y,Z"] = "directions are in world space, around that normal";
  return words;
}

void bind_bsdf_options(py::module_& module) {
  py::class_<BsdfOptions>(module, "BsdfOptions")
      .def(py::init<>())
      .def_readwrite("contract", &BsdfOptions::contract)
      .def_readwrite("angles", &BsdfOptions::angles)
      .def_readwrite("random_directions", &BsdfOptions::random_directions)
      .def_readwrite("front", &BsdfOptions::front)
      .def_readwrite("back", &BsdfOptions::back)
      .def_readwrite("eta", &BsdfOptions::eta)
      .def_readwrite("reciprocal", &BsdfOptions::reciprocal)
      .def_readwrite("conserves_energy", &BsdfOptions::conserves_energy)
      .def_readwrite("energy_tolerance", &BsdfOptions::energy_tolerance)
      .def("set_albedo", &set_albedo)
      .def("add_suspect", &add_bsdf_suspect);
}

}  // namespace

void bind_bsdfs(py::module_& module) {
  module.attr("CONVENTIONS") = convention_words();
  bind_bsdf_options(module);
  py::class_<ErasedBsdf>(module, "Bsdf")
      .def(py::init(&make_bsdf), py::arg("sample"), py::arg("pdf"), py::arg("eval"),
           py::arg("numbers"), py::arg("single"))
      .def("add_lobe", &add_bsdf_lobe);
  module.def(
      "check_bsdf",
      [](const std::string& name, const ErasedBsdf& bsdf, const std::vector<std::string>& words,
         const BsdfOptions& options) {
        const verify::BsdfConventions conventions = verify::conventions::from_words(words);
        return verify::check_bsdf(name, apply_conventions(bsdf, conventions), options);
      },
      py::arg("name"), py::arg("bsdf"), py::arg("conventions"), py::arg("options"));
}

}  // namespace plumbline::python
