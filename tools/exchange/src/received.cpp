#include "received.h"

#include <algorithm>
#include <string>

namespace plumbline::exchange {
namespace {

std::string shape_wanted(const ArrayWanted& wanted) {
  const std::string rows = "(" + std::to_string(wanted.rows);
  std::string text;
  if (wanted.least_columns == 1) {
    text = rows + ",)";
    if (wanted.most_columns > 1) {
      text += " or " + rows + ", channels), at most " + std::to_string(wanted.most_columns) +
              " channels,";
    }
  } else {
    text = rows + ", " + std::to_string(wanted.least_columns) + ")";
  }
  if (wanted.may_be_empty) text += " (or (0,): not stated)";
  return text;
}

void require_shape(const NpyHeader& header, const ArrayWanted& wanted) {
  if (wanted.may_be_empty && header.rows == 0) return;
  if (header.rows == wanted.rows && header.columns >= wanted.least_columns &&
      header.columns <= wanted.most_columns) {
    return;
  }
  throw NpyError("has the shape " + shape_text(header) + "; " + shape_wanted(wanted) +
                 " is wanted");
}

void require_type(const NpyHeader& header, const ArrayWanted& wanted) {
  if ((header.type == NpyType::boolean) == wanted.flags) return;
  throw NpyError(std::string("holds values of type ") + descr(header.type) + "; " +
                 (wanted.flags ? "|b1 (bool)" : "<f4 or <f8 (float32 or float64)") + " is wanted");
}

}  // namespace

ReceivedArray read_array(ByteSource& source, const ArrayWanted& wanted,
                         std::vector<std::byte>& bytes) {
  const NpyHeader header = read_npy_header(source);
  require_type(header, wanted);
  require_shape(header, wanted);
  const std::size_t size = header.rows * header.columns * size_of(header.type);
  bytes.resize(std::max(bytes.size(), size));
  source.read(bytes.data(), size);
  if (wanted.flags) {
    const auto bad = std::find_if(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size),
                                  [](std::byte b) { return b > std::byte{1}; });
    if (bad != bytes.begin() + static_cast<std::ptrdiff_t>(size)) {
      throw NpyError("holds a bool that is neither 0 nor 1 but " +
                     std::to_string(std::to_integer<int>(*bad)));
    }
  }
  return {header, bytes.data()};
}

}  // namespace plumbline::exchange
