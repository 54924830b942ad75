#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plumbline/verify/detail/many.h>
#include <plumbline/verify/pair.h>

#include "values.h"

namespace plumbline::python {

/// A Python function of arrays, with what it is told and what it has to answer.
class Function {
 public:
  /// @param name       for messages
  /// @param arguments  how each is handed over
  /// @param answer     points that a sampler returns; `number` is the arithmetic of any function
  Function(py::object callable, std::string name, std::vector<Layout> arguments, Layout answer);

  /// Asks Python, which may raise anything, and reads a row for each of `out`.
  ///
  /// @throws py::value_error where the answer has a wrong shape or type
  /// @throws py::error_already_set what Python raised, and what a signal did
  template <class R>
  void operator()(std::initializer_list<std::span<const Triple>> rows, std::span<R> out) const {
    read(call(rows), out);
  }

 private:
  py::object call(std::initializer_list<std::span<const Triple>> rows) const;
  void read(const py::object& answer, std::span<double> out) const;
  void read(const py::object& answer, std::span<verify::Channels> out) const;
  void read(const py::object& answer, std::span<std::optional<verify::SampleRecord>> out) const;
  Source source(std::string_view part) const;

  py::object callable_;
  std::string name_;
  std::vector<Layout> arguments_;
  Layout answer_;
  mutable std::array<py::object, 2> used_;  ///< of the last call, for the next
};

/// Rows that are worth a call: what is asked and answered stays in the cache.
inline constexpr std::size_t kRowsAtOnce = std::size_t{1} << 13;

/// As `verify` wants it; empty where Python's is None.
template <class R, class... A>
void assign(verify::Many<R(A...)>& to, const py::object& callable, std::string name,
            std::vector<Layout> arguments, Layout answer) {
  if (callable.is_none()) return;
  const auto function =
      std::make_shared<const Function>(callable, std::move(name), std::move(arguments), answer);
  to = verify::Many<R(A...)>(
      [function](std::span<const A>... a, std::span<R> out) { (*function)({a...}, out); },
      kRowsAtOnce);
}

}  // namespace plumbline::python
