#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace plumbline::python {

namespace py = pybind11;

/// A point, a direction, or the random numbers of one sample: `verify` keeps all of them like this.
using Triple = std::array<double, 3>;

enum class Number { float32, float64, int64 };

/// How triples become an array.
struct Layout {
  int columns = 3;    ///< of the triples, the first ones
  bool flat = false;  ///< shape (n,) instead of (n, 1)
  Number number = Number::float64;
};

/// Puts rows into an array that is large and that nobody else holds, if `array` is such a one, or
/// into a new one: fresh pages cost more than all else. Python may keep it.
void to_array(std::span<const Triple> rows, const Layout& layout, py::object& array);

/// What an array is: "weight returned by sample". Put together only where it is wrong.
struct Source {
  std::string_view part, function;
  bool single = false;  ///< float32 is precise enough

  std::string name() const { return std::string(part) + " returned by " + std::string(function); }
};

/// Real numbers that Python returned, read where they lie: one for each row, or several.
class Values {
 public:
  /// How many numbers a row has.
  enum class Rows {
    one,         ///< shape (n,)
    some,        ///< (n,) or (n, c)
    as_columns,  ///< (n, columns)
  };

  /// @throws py::value_error unless the shape is as asked for, and the numbers are real and not of
  ///         less precision than was promised
  Values(const py::object& object, const Source& source, std::size_t rows, Rows kind,
         std::size_t columns = 1);

  std::size_t columns() const { return columns_; }

  double operator()(std::size_t row, std::size_t column = 0) const {
    const char* at = data_ + static_cast<py::ssize_t>(row) * row_stride_ +
                     static_cast<py::ssize_t>(column) * column_stride_;
    return single_ ? static_cast<double>(read<float>(at)) : read<double>(at);
  }

 private:
  /// NumPy's arrays need not be aligned.
  template <class T>
  static T read(const char* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }

  void check_shape(const Source& source, std::size_t rows, Rows kind, std::size_t columns);
  void check_numbers(const Source& source);

  py::array array_;
  const char* data_ = nullptr;
  py::ssize_t row_stride_ = 0, column_stride_ = 0;
  std::size_t columns_ = 1;
  bool single_ = false;
};

/// Truths that Python returned, one for each row.
class Flags {
 public:
  /// @throws py::value_error unless it is an array of bool of shape (rows,)
  Flags(const py::object& object, const Source& source, std::size_t rows);

  bool operator[](std::size_t row) const {
    return data_[static_cast<py::ssize_t>(row) * stride_] != 0;
  }

 private:
  py::array array_;
  const char* data_ = nullptr;
  py::ssize_t stride_ = 0;
};

}  // namespace plumbline::python
