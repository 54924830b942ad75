#include "bindings.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <plumbline/verify/detail/report.h>
#include <plumbline/verify/detail/result.h>
#include <plumbline/verify/image.h>
#include <plumbline/verify/waiver.h>

#include "words.h"

namespace plumbline::python {

namespace {

namespace py = pybind11;
using verify::CheckResult;
using verify::ImageResult;
using verify::Report;

std::optional<std::pair<double, double>> interval_of(const CheckResult& r) {
  if (!r.interval) return std::nullopt;
  return std::pair{r.interval->low, r.interval->high};
}

/// One line, of which pytest shows no more than 240 characters.
std::string line_of(const Report& report) {
  const std::string summary = report.summary();
  const std::size_t first = summary.find('\n');
  std::string line = "<Report: " + summary.substr(0, first);
  if (!report.cause.empty()) line += "; " + report.cause;
  return line + ">";
}

/// (x0, x1, y0, y1, expected, error of that, observed) of each.
std::vector<std::array<double, 7>> bins_of(const CheckResult& r) {
  std::vector<std::array<double, 7>> bins;
  for (const verify::Bin& b : r.bins) {
    bins.push_back(
        {b.x.low, b.x.high, b.y.low, b.y.high, b.expected, b.expected_error, b.observed});
  }
  return bins;
}

py::dict figures_of(const CheckResult& r) {
  py::dict figures;
  for (const verify::FigureValue& f : r.figures) {
    figures[py::str(std::string(f.name()))] = f.value;
  }
  return figures;
}

void bind_result(py::module_& module) {
  py::class_<CheckResult>(module, "CheckResult", "The outcome of one check.")
      .def_property_readonly("kind", [](const CheckResult& r) { return to_string(r.kind); })
      .def_readonly("subject", &CheckResult::subject)
      .def_property_readonly("verdict", [](const CheckResult& r) { return to_string(r.verdict); })
      .def_property_readonly("expected", [](const CheckResult& r) { return to_string(r.expected); })
      .def_readonly("estimate", &CheckResult::estimate)
      .def_readonly("reference", &CheckResult::reference)
      .def_readonly("tolerance", &CheckResult::tolerance)
      .def_readonly("bound", &CheckResult::bound)
      .def_readonly("detectable", &CheckResult::detectable)
      .def_readonly("p_value", &CheckResult::p_value)
      .def_property_readonly("interval", &interval_of)
      .def_readonly("samples", &CheckResult::samples)
      .def_readonly("seconds", &CheckResult::seconds)
      .def_readonly("leaned_on", &CheckResult::leaned_on)
      .def_readonly("reason", &CheckResult::reason)
      .def_readonly("advice", &CheckResult::advice)
      .def_readonly("waived", &CheckResult::waived)
      .def_readonly("diagnosis", &CheckResult::diagnosis)
      .def_property_readonly("cause", [](const CheckResult& r) { return cause_word(r.cause); })
      .def_readonly("seed", &CheckResult::seed)
      .def_readonly("replay", &CheckResult::replay)
      .def_property_readonly("figures", &figures_of)
      .def_property_readonly("bins", &bins_of)
      .def_property_readonly("ok", &CheckResult::ok)
      .def_property_readonly("as_expected", &CheckResult::as_expected)
      .def("__str__", [](const CheckResult& r) { return describe(r); })
      .def("__repr__", [](const CheckResult& r) {
        return "<CheckResult " + r.subject + ": " + std::string(to_string(r.verdict)) + ">";
      });
}

void bind_report(py::module_& module) {
  py::class_<Report>(module, "Report", py::dynamic_attr(), "What several checks found.")
      .def(py::init<std::vector<CheckResult>>(), py::arg("results") = std::vector<CheckResult>{})
      .def_property_readonly("ok", &Report::ok)
      .def("__bool__", &Report::ok)
      .def_property_readonly("as_expected", &Report::as_expected)
      .def_property_readonly("verdict", [](const Report& r) { return to_string(r.verdict()); })
      .def_readonly("results", &Report::results)
      .def_readonly("cause", &Report::cause)
      .def_readonly("second_cause", &Report::second_cause)
      .def_property_readonly("cause_kind", [](const Report& r) { return cause_word(r.cause_kind); })
      .def_readwrite("replay", &Report::replay)
      .def("append", &Report::append, py::arg("other"))
      .def("summary", &Report::summary)
      .def("__str__", &Report::summary)
      .def("__repr__", &line_of);
  module.def(
      "waive",
      [](const Report& report,
         const std::vector<std::tuple<std::string, std::string, std::string>>& given) {
        std::vector<verify::Waiver> waivers;
        for (const auto& [check, reason, until] : given) {
          waivers.push_back({check, reason, verify::parse_day(until)});
        }
        return verify::waive(report, waivers);
      },
      py::arg("report"), py::arg("waivers"));
}

py::array_t<double> map_of(const ImageResult& r) {
  const std::vector<py::ssize_t> shape = {r.map_height, r.map_width};
  return py::array_t<double>(shape, r.p_map.data());
}

void bind_image_result(py::module_& module) {
  py::class_<ImageResult>(module, "ImageResult", "The outcome of the check of one channel.")
      .def_readonly("check", &ImageResult::check)
      .def_readonly("tile", &ImageResult::tile)
      .def_property_readonly("p_map", &map_of)
      .def_readonly("histogram", &ImageResult::histogram);
}

}  // namespace

void bind_results(py::module_& module) {
  bind_result(module);
  bind_report(module);
  bind_image_result(module);
}

}  // namespace plumbline::python
