#include <pybind11/embed.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include <plumbline/verify/pair.h>

#include "function.h"
#include "values.h"

/// What it costs to ask a Python function through the border of the module `plumbline`, beyond what
/// the function itself takes on arrays that are there already.
namespace plumbline::python {
namespace {

constexpr const char* kFunctions = R"(
import numpy as np

def pdf(wo, wi):
    return np.maximum(wi[:, 2], 0) * (1 / np.pi)

def eval(wo, wi):
    return np.full((len(wi), 3), 0.5 / np.pi, wi.dtype)

def sample(wo, u):
    radius, phi = np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
    wi = np.stack([radius * np.cos(phi), radius * np.sin(phi), np.sqrt(1 - u[:, 0])], axis=-1)
    return wi, pdf(wo, wi), np.full(len(u), 0.5, u.dtype), wo[:, 2] > 0
)";

double seconds_of(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The least of many runs: what the machine did besides is not of interest.
double least_seconds(std::size_t n, const auto& work) {
  const auto runs = std::max(std::size_t{60}, 20'000 / n);
  double least = seconds_of(work);
  for (std::size_t i = 0; i < runs; ++i) least = std::min(least, seconds_of(work));
  return least;
}

std::vector<Triple> rows_of(std::size_t n) {
  verify::Random random(1);
  std::vector<Triple> rows(n);
  for (Triple& row : rows) row = {random.uniform(), random.uniform(), random.uniform()};
  return rows;
}

template <class R>
void measure(const py::dict& functions, const char* name, std::size_t n, Number number,
             int second_columns) {
  const Layout first{3, false, number}, second{second_columns, false, number};
  const py::object function = functions[name];
  verify::Many<R(Triple, Triple)> asked;
  assign(asked, function, name, {first, second}, first);
  const std::vector<Triple> a = rows_of(n), b = rows_of(n);
  py::object array_a, array_b;
  to_array(a, first, array_a);
  to_array(b, second, array_b);
  std::vector<R> out(n);
  const double own = least_seconds(n, [&] { function(array_a, array_b); });
  const double all = least_seconds(n, [&] { asked(a, b, out); });
  const double count = static_cast<double>(n);
  std::printf("%-8s %-8s %8zu %10.1f %10.1f\n", name,
              number == Number::float32 ? "float32" : "float64", n, own / count * 1e9,
              (all - own) / count * 1e9);
}

void measure_all() {
  py::dict functions;
  py::exec(kFunctions, functions);
  std::printf("ns/row   dtype        rows   NumPy's     border's\n");
  for (const std::size_t n : std::initializer_list<std::size_t>{1, 1 << 12, 1 << 14, 1 << 16}) {
    for (const Number number : {Number::float64, Number::float32}) {
      measure<double>(functions, "pdf", n, number, 3);
      measure<verify::Channels>(functions, "eval", n, number, 3);
      measure<std::optional<verify::SampleRecord>>(functions, "sample", n, number, 2);
    }
  }
}

}  // namespace
}  // namespace plumbline::python

int main() {
  const pybind11::scoped_interpreter interpreter;
  plumbline::python::measure_all();
}
