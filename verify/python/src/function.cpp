#include "function.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace plumbline::python {

namespace {

using verify::Channels;
using verify::SampleRecord;

/// The parts of what a sampler returns; those that it leaves out are None.
struct Parts {
  py::object points, pdf = py::none(), weight = py::none(), accepted = py::none(),
                     mass = py::none();
};

Parts parts_of(const py::object& answer, const std::string& name) {
  Parts parts;
  if (!py::isinstance<py::tuple>(answer)) {
    parts.points = answer;
    return parts;
  }
  const auto tuple = py::reinterpret_borrow<py::tuple>(answer);
  const std::array<py::object*, 5> fields = {&parts.points, &parts.pdf, &parts.weight,
                                             &parts.accepted, &parts.mass};
  if (tuple.empty() || tuple.size() > fields.size()) {
    throw py::value_error(name + " returned a tuple of " + std::to_string(tuple.size()) +
                          ", wanted (points, pdf, weight, accepted, mass) or the first of these");
  }
  for (std::size_t i = 0; i < tuple.size(); ++i) *fields[i] = tuple[i];
  return parts;
}

/// A spectrum of more bands than `Channels` holds is thinned out, as that of a C++ record is.
Channels channels_of(const Values& values, std::size_t row) {
  Channels out;
  const std::size_t bands = values.columns();
  out.count = std::min(bands, Channels::kMost);
  for (std::size_t i = 0; i < out.count; ++i) {
    out.value[i] = values(row, bands == out.count ? i : i * bands / out.count);
  }
  return out;
}

}  // namespace

Function::Function(py::object callable, std::string name, std::vector<Layout> arguments,
                   Layout answer)
    : callable_(std::move(callable)),
      name_(std::move(name)),
      arguments_(std::move(arguments)),
      answer_(answer) {}

py::object Function::call(std::initializer_list<std::span<const Triple>> rows) const {
  // NumPy's own loops do not look whether somebody wants to stop.
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  std::array<py::object, 2> arrays;
  std::size_t given = 0;
  for (const std::span<const Triple> argument : rows) {
    arrays[given] = std::exchange(used_[given], {});
    to_array(argument, arguments_[given], arrays[given]);
    ++given;
  }
  py::object answer = given == 1 ? callable_(arrays[0]) : callable_(arrays[0], arrays[1]);
  used_ = std::move(arrays);
  return answer;
}

Source Function::source(std::string_view part) const {
  return {part, name_, answer_.number == Number::float32};
}

void Function::read(const py::object& answer, std::span<double> out) const {
  const Values values(answer, source("the array"), out.size(), Values::Rows::one);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = values(i);
}

void Function::read(const py::object& answer, std::span<Channels> out) const {
  const Values values(answer, source("the array"), out.size(), Values::Rows::some);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = channels_of(values, i);
}

void Function::read(const py::object& answer, std::span<std::optional<SampleRecord>> out) const {
  const std::size_t n = out.size();
  const Parts parts = parts_of(answer, name_);
  const auto columns = static_cast<std::size_t>(answer_.columns);
  const Values points(parts.points, source("points"), n,
                      answer_.flat ? Values::Rows::one : Values::Rows::as_columns, columns);
  std::optional<Values> pdf, weight, mass;
  std::optional<Flags> accepted;
  if (!parts.pdf.is_none()) {
    pdf.emplace(parts.pdf, source("pdf"), n, Values::Rows::one);
  }
  if (!parts.weight.is_none()) {
    weight.emplace(parts.weight, source("weight"), n, Values::Rows::some);
  }
  if (!parts.mass.is_none()) {
    mass.emplace(parts.mass, source("mass"), n, Values::Rows::one);
  }
  if (!parts.accepted.is_none()) accepted.emplace(parts.accepted, source("accepted"), n);
  for (std::size_t i = 0; i < n; ++i) {
    if (accepted && !(*accepted)[i]) {
      out[i].reset();
      continue;
    }
    SampleRecord& record = out[i].emplace();
    for (std::size_t c = 0; c < columns; ++c) record.x[c] = points(i, c);
    if (weight) record.weight = channels_of(*weight, i);
    if (mass) record.mass = (*mass)(i);
    // An atom has no density: what stands in its row of `pdf` is filling.
    if (pdf && !(record.mass > 0)) record.pdf = (*pdf)(i);
  }
}

}  // namespace plumbline::python
