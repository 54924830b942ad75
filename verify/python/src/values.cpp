#include "values.h"

#include <cstdint>
#include <cstring>

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

template <class T>
py::array filled(std::span<const Triple> rows, const Layout& layout) {
  const auto n = static_cast<py::ssize_t>(rows.size());
  const auto columns = static_cast<std::size_t>(layout.columns);
  py::array_t<T> array =
      layout.flat ? py::array_t<T>(n) : py::array_t<T>({n, py::ssize_t{layout.columns}});
  T* out = array.mutable_data();
  for (const Triple& row : rows) {
    for (std::size_t c = 0; c < columns; ++c) *out++ = static_cast<T>(row[c]);
  }
  return array;
}

bool in_native_order(const py::dtype& type) {
  return type.byteorder() == '=' || type.byteorder() == '|';
}

}  // namespace

std::string Layout::shape(std::size_t n) const {
  const std::string count = std::to_string(n);
  return flat ? "(" + count + ",)" : "(" + count + ", " + std::to_string(columns) + ")";
}

py::array to_array(std::span<const Triple> rows, const Layout& layout) {
  switch (layout.number) {
    case Number::float32:
      return filled<float>(rows, layout);
    case Number::int64:
      return filled<std::int64_t>(rows, layout);
    case Number::float64:
      break;
  }
  return filled<double>(rows, layout);
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

double Values::operator()(std::size_t row, std::size_t column) const {
  const char* at = data_ + static_cast<py::ssize_t>(row) * row_stride_ +
                   static_cast<py::ssize_t>(column) * column_stride_;
  // Copied, because NumPy's arrays need not be aligned.
  if (single_) {
    float value;
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
  }
  double value;
  std::memcpy(&value, at, sizeof value);
  return value;
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
}

bool Flags::operator[](std::size_t row) const {
  return static_cast<const char*>(
             array_.data())[static_cast<py::ssize_t>(row) * array_.strides(0)] != 0;
}

}  // namespace plumbline::python
