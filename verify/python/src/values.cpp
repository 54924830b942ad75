#include "values.h"

#include <cstdint>

namespace plumbline::python {

namespace {

std::string text_of(py::handle object) { return py::cast<std::string>(py::str(object)); }

std::string shape_of(const py::array& array) { return text_of(array.attr("shape")); }

std::string dtype_of(const py::array& array) { return text_of(array.dtype()); }

[[noreturn]] void refuse(const std::string& message) { throw py::value_error(message); }

py::array as_array(const py::object& object, const Source& source) {
  if (py::isinstance<py::array>(object)) return py::reinterpret_borrow<py::array>(object);
  py::array array = py::array::ensure(object);
  if (!array || array.dtype().kind() == 'O') {
    refuse(source.name() + " is a " + text_of(py::type::of(object).attr("__name__")) +
           ", not an array");
  }
  return array;
}

// py::object where there may be none: a py::array that is made by default is an array.

// Rows from which on an array comes from the system, page by page.
constexpr std::size_t kLarge = 4096;

/// Whether an array can be filled again: nobody holds it, or a view of it, and it is as it was
/// made.
template <class T>
bool is_free(const py::object& object, std::size_t rows, const Layout& layout) {
  if (!object || object.ref_count() != 1) return false;
  if (!py::isinstance<py::array_t<T, py::array::c_style>>(object)) return false;
  const auto array = py::reinterpret_borrow<py::array>(object);
  return array.writeable() && array.ndim() == (layout.flat ? 1 : 2) &&
         array.shape(0) == static_cast<py::ssize_t>(rows) &&
         (layout.flat || array.shape(1) == layout.columns);
}

template <class T>
py::array_t<T> fresh(std::size_t rows, const Layout& layout) {
  const auto n = static_cast<py::ssize_t>(rows);
  if (layout.flat) return py::array_t<T>(n);
  return py::array_t<T>({n, py::ssize_t{layout.columns}});
}

template <class T>
void fill(std::span<const Triple> rows, const Layout& layout, py::object& object) {
  if (rows.size() < kLarge || !is_free<T>(object, rows.size(), layout)) {
    object = fresh<T>(rows.size(), layout);
  }
  T* out = static_cast<T*>(py::reinterpret_borrow<py::array>(object).mutable_data());
  const auto columns = static_cast<std::size_t>(layout.columns);
  for (const Triple& row : rows) {
    for (std::size_t c = 0; c < columns; ++c) *out++ = static_cast<T>(row[c]);
  }
}

bool in_native_order(const py::dtype& type) {
  return type.byteorder() == '=' || type.byteorder() == '|';
}

}  // namespace

void to_array(std::span<const Triple> rows, const Layout& layout, py::object& array) {
  switch (layout.number) {
    case Number::float32:
      return fill<float>(rows, layout, array);
    case Number::int64:
      return fill<std::int64_t>(rows, layout, array);
    case Number::float64:
      return fill<double>(rows, layout, array);
  }
}

Values::Values(const py::object& object, const Source& source, std::size_t rows, Rows kind,
               std::size_t columns)
    : array_(as_array(object, source)) {
  check_shape(source, rows, kind, columns);
  check_numbers(source);
  data_ = static_cast<const char*>(array_.data());
  row_stride_ = array_.strides(0);
  if (array_.ndim() == 2) {
    column_stride_ = array_.strides(1);
    columns_ = static_cast<std::size_t>(array_.shape(1));
  }
}

void Values::check_shape(const Source& source, std::size_t rows, Rows kind, std::size_t columns) {
  const auto n = static_cast<py::ssize_t>(rows);
  const bool matrix = array_.ndim() == 2 && array_.shape(0) == n;
  const bool vector = array_.ndim() == 1 && array_.shape(0) == n;
  const std::string count = "(" + std::to_string(rows);
  if (kind == Rows::as_columns) {
    if (matrix && array_.shape(1) == static_cast<py::ssize_t>(columns)) return;
    refuse(source.name() + " has shape " + shape_of(array_) + ", wanted " + count + ", " +
           std::to_string(columns) + ")");
  }
  if (vector) return;
  if (kind == Rows::some && matrix && array_.shape(1) > 0) return;
  refuse(source.name() + " has shape " + shape_of(array_) + ", wanted " + count + ",)" +
         (kind == Rows::some ? " or " + count + ", channels)" : ""));
}

void Values::check_numbers(const Source& source) {
  const py::dtype type = array_.dtype();
  const bool real = type.kind() == 'f' || type.kind() == 'i' || type.kind() == 'u';
  if (!real) refuse(source.name() + " has dtype " + dtype_of(array_) + ", wanted real numbers");
  const py::ssize_t least = source.single ? 4 : 8;
  if (type.kind() == 'f' && type.itemsize() < least) {
    refuse(source.name() + " has dtype " + dtype_of(array_) + ", wanted float" +
           (source.single ? "32" : "64, as dtype= says: state the arithmetic of the code there"));
  }
  single_ = type.kind() == 'f' && type.itemsize() == 4 && in_native_order(type);
  const bool as_it_is = type.kind() == 'f' && type.itemsize() == 8 && in_native_order(type);
  if (!single_ && !as_it_is) array_ = py::array_t<double, py::array::forcecast>::ensure(array_);
}

Flags::Flags(const py::object& object, const Source& source, std::size_t rows)
    : array_(as_array(object, source)) {
  if (array_.dtype().kind() != 'b') {
    refuse(source.name() + " has dtype " + dtype_of(array_) + ", wanted bool");
  }
  if (array_.ndim() != 1 || array_.shape(0) != static_cast<py::ssize_t>(rows)) {
    refuse(source.name() + " has shape " + shape_of(array_) + ", wanted (" + std::to_string(rows) +
           ",)");
  }
  data_ = static_cast<const char*>(array_.data());
  stride_ = array_.strides(0);
}

}  // namespace plumbline::python
