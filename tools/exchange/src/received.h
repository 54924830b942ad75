#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

#include <plumbline/exchange/npy.h>

namespace plumbline::exchange {

/// What an array of an answer must be.
struct ArrayWanted {
  const char* name;
  std::size_t rows;
  std::size_t least_columns, most_columns;
  bool may_be_empty = false;  ///< no rows: not stated
  bool flags = false;         ///< bool, not numbers
};

/// An array of an answer. Holds no bytes of its own.
class ReceivedArray {
 public:
  ReceivedArray() = default;
  ReceivedArray(const NpyHeader& header, const std::byte* data) : header_(header), data_(data) {}

  bool empty() const { return header_.rows == 0; }
  std::size_t columns() const { return header_.columns; }

  double at(std::size_t row, std::size_t column) const {
    const std::size_t index = row * header_.columns + column;
    return header_.type == NpyType::float32 ? static_cast<double>(value<float>(index))
                                            : value<double>(index);
  }

  bool flag(std::size_t row) const { return data_[row] != std::byte{0}; }

 private:
  template <class T>
  T value(std::size_t index) const {
    T v;
    std::memcpy(&v, data_ + index * sizeof v, sizeof v);
    return v;
  }

  NpyHeader header_;
  const std::byte* data_ = nullptr;
};

/// Reads an array into `bytes`, which grow only once its shape is what is wanted.
/// @throws NpyError where it is not, and what the source throws
ReceivedArray read_array(ByteSource& source, const ArrayWanted& wanted,
                         std::vector<std::byte>& bytes);

}  // namespace plumbline::exchange
