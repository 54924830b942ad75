#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/image.h>
#include <plumbline/verify/mean.h>
#include <plumbline/verify/ratio.h>

#include "bindings.h"
#include "values.h"
#include "words.h"

namespace plumbline::python {

namespace {

using verify::CheckResult;
using verify::Image;
using verify::ImageOptions;
using verify::MeanOptions;
using verify::Moments;
using verify::MomentSampler;
using verify::ProportionOptions;
using verify::VarianceRatioOptions;

using Release = py::call_guard<py::gil_scoped_release>;

// Samples that are worth a call, as `Many::kInSpans`.
constexpr std::uint64_t kMostPerCall = 1 << 16;

/// Numbers of the caller's, in whatever arithmetic they came about.
Source given(std::string_view name) { return {name, "the caller", true}; }

Moments moments_of(const Values& values, std::size_t first, std::size_t count) {
  Moments moments;
  for (std::size_t i = first; i < first + count; ++i) moments.add(values(i));
  return moments;
}

MomentSampler from_array(const py::array& samples, const char* name) {
  const auto n = static_cast<std::size_t>(samples.size());
  const auto values = std::make_shared<const Values>(samples, given(name), n, Values::Rows::one);
  return [values](std::uint64_t first, std::uint64_t count) {
    return moments_of(*values, first, count);
  };
}

MomentSampler from_function(const py::object& sampler, std::string name) {
  return [sampler, name = std::move(name)](std::uint64_t first, std::uint64_t count) {
    Moments moments;
    for (std::uint64_t done = 0; done < count;) {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      const std::uint64_t n = std::min(count - done, kMostPerCall);
      const py::object answer = sampler(first + done, n);
      moments.merge(moments_of({answer, {"the array", name, true}, n, Values::Rows::one}, 0, n));
      done += n;
    }
    return moments;
  };
}

/// Samples are an array, of which a check takes as many as it needs, or a function that draws them.
MomentSampler sampler_of(const py::object& samples, MeanOptions& options, const char* name) {
  if (!py::isinstance<py::array>(samples)) return from_function(samples, name);
  const auto array = py::reinterpret_borrow<py::array>(samples);
  options.max_samples = std::min(options.max_samples, static_cast<std::uint64_t>(array.size()));
  return from_array(array, name);
}

CheckResult check_mean_of(MeanOptions options, const py::object& samples) {
  const MomentSampler sampler = sampler_of(samples, options, "samples");
  return verify::check_mean(options, sampler);
}

CheckResult check_agreement_of(MeanOptions options, const py::object& a, const py::object& b) {
  const MomentSampler sampler_a = sampler_of(a, options, "a");
  const MomentSampler sampler_b = sampler_of(b, options, "b");
  return check_agreement(options, sampler_a, sampler_b);
}

std::vector<double> statistics_of(const py::array& array, const char* name) {
  const auto n = static_cast<std::size_t>(array.size());
  const Values values(array, given(name), n, Values::Rows::one);
  std::vector<double> out(n);
  for (std::size_t i = 0; i < n; ++i) out[i] = values(i);
  return out;
}

std::vector<Moments> batches_of(const py::array& array, const char* name) {
  const auto batches = static_cast<std::size_t>(array.shape(0));
  const Values values(array, given(name), batches, Values::Rows::some);
  std::vector<Moments> out(batches);
  for (std::size_t i = 0; i < batches; ++i) {
    for (std::size_t j = 0; j < values.columns(); ++j) out[i].add(values(i, j));
  }
  return out;
}

CheckResult check_variance_ratio_of(const VarianceRatioOptions& options, const py::array& a,
                                    const py::array& b) {
  if (a.ndim() == 1 && b.ndim() == 1) {
    return check_variance_ratio(options, statistics_of(a, "a"), statistics_of(b, "b"));
  }
  if (a.ndim() != 2 || b.ndim() != 2) {
    throw py::value_error("a and b are both (batches, samples), or both (batches,)");
  }
  const std::vector<Moments> of_a = batches_of(a, "a"), of_b = batches_of(b, "b");
  return check_variance_ratio(options, std::span(of_a), std::span(of_b));
}

std::vector<double> pixels_of(const py::object& layer, const char* name, int height, int width) {
  if (layer.is_none()) return {};
  const auto rows = static_cast<std::size_t>(height), columns = static_cast<std::size_t>(width);
  const Values values(layer, given(name), rows, Values::Rows::as_columns, columns);
  std::vector<double> out;
  out.reserve(rows * columns);
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) out.push_back(values(y, x));
  }
  return out;
}

Image make_image(const py::array& mean, const py::object& variance, const py::object& count) {
  if (mean.ndim() != 2) throw py::value_error("the mean layer is not (height, width)");
  Image image;
  image.height = static_cast<int>(mean.shape(0));
  image.width = static_cast<int>(mean.shape(1));
  image.mean = pixels_of(mean, "mean layer", image.height, image.width);
  image.variance = pixels_of(variance, "variance layer", image.height, image.width);
  image.count = pixels_of(count, "count layer", image.height, image.width);
  return image;
}

/// What the options of all of these have.
template <class Options>
auto options_class(py::module_& module, const char* name) {
  return py::class_<Options>(module, name)
      .def(py::init<>())
      .def_readwrite("subject", &Options::subject)
      .def_readwrite("seed", &Options::seed)
      .def("set_expected",
           [](Options& o, std::string_view word) { o.expected = verdict_of(word); });
}

void bind_options(py::module_& module) {
  options_class<MeanOptions>(module, "MeanOptions")
      .def_readwrite("reference", &MeanOptions::reference)
      .def_readwrite("tolerance", &MeanOptions::tolerance)
      .def_readwrite("relative", &MeanOptions::relative)
      .def_readwrite("rounding_allowance", &MeanOptions::rounding_allowance)
      .def_readwrite("exact_variance", &MeanOptions::exact_variance)
      .def_readwrite("n0", &MeanOptions::n0)
      .def_readwrite("max_samples", &MeanOptions::max_samples);
  options_class<VarianceRatioOptions>(module, "VarianceRatioOptions")
      .def_readwrite("at_least", &VarianceRatioOptions::at_least)
      .def_readwrite("at_most", &VarianceRatioOptions::at_most);
  options_class<ProportionOptions>(module, "ProportionOptions")
      .def_readwrite("at_least", &ProportionOptions::at_least)
      .def_readwrite("at_most", &ProportionOptions::at_most);
  options_class<ImageOptions>(module, "ImageOptions")
      .def_readwrite("tolerance", &ImageOptions::tolerance)
      .def_readwrite("rounding_allowance", &ImageOptions::rounding_allowance)
      .def_readwrite("non_finite", &ImageOptions::non_finite);
}

}  // namespace

void bind_estimates(py::module_& module) {
  bind_options(module);
  py::class_<Image>(module, "ImageChannel")
      .def(py::init(&make_image), py::arg("mean"), py::arg("variance"), py::arg("count"));
  module.def("check_mean", &check_mean_of, py::arg("options"), py::arg("samples"));
  module.def("check_agreement", &check_agreement_of, py::arg("options"), py::arg("a"),
             py::arg("b"));
  module.def("check_variance_ratio", &check_variance_ratio_of, py::arg("options"), py::arg("a"),
             py::arg("b"));
  module.def("check_proportion", &verify::check_proportion, py::arg("options"), py::arg("hits"),
             py::arg("trials"));
  module.def("check_image", &verify::check_image, py::arg("options"), py::arg("image"),
             py::arg("reference"), Release());
}

}  // namespace plumbline::python
