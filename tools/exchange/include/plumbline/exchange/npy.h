#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

/// Sampling code in another program: queries go there, answers come back, by the protocol of
/// docs/protocol.md.
namespace plumbline::exchange {

/// Where the bytes of an array come from: a pipe, a file, a text in memory.
class ByteSource {
 public:
  virtual ~ByteSource() = default;

  /// Exactly that many bytes.
  /// @throws std::runtime_error where they do not come
  virtual void read(std::byte* to, std::size_t count) = 0;
};

/// A header that is not one, or of an array that the protocol has no use for. `what()` says what is
/// wrong with it as the end of a sentence that names the array.
class NpyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the protocol's arrays are made of, all little endian: "<f4", "<f8", "|b1".
enum class NpyType { float32, float64, boolean };

constexpr std::size_t size_of(NpyType type) {
  return type == NpyType::float32 ? 4 : type == NpyType::float64 ? 8 : 1;
}

/// "<f4"
const char* descr(NpyType type);

/// Type and shape of an array of one or two dimensions in C order.
struct NpyHeader {
  NpyType type = NpyType::float64;
  int dimensions = 1;
  std::size_t rows = 0;
  std::size_t columns = 1;  ///< 1 where there is one dimension

  friend bool operator==(const NpyHeader&, const NpyHeader&) = default;
};

/// "(1000, 3)", as NumPy writes it.
std::string shape_text(const NpyHeader& header);

inline constexpr std::size_t kNpyHeaderSize = 128;  ///< of those that we write

/// Magic, version 1.0 and dictionary, padded with spaces to 128 bytes, so that a reader without a
/// parser can skip it.
/// @source NumPy, numpy.lib.format, "Format Version 1.0"
std::string npy_header(const NpyHeader& header);

/// Takes the header, of version 1.0, 2.0 or 3.0, off the source, which stands at the data then.
/// Allocates 4 KiB at most; the numbers of rows and columns are what the header says, unchecked.
/// @throws NpyError, and what the source throws
NpyHeader read_npy_header(ByteSource& source);

}  // namespace plumbline::exchange
