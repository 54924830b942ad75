#include <plumbline/exchange/npy.h>

#include <cctype>
#include <cstdint>
#include <limits>
#include <string_view>

#include "shown.h"

namespace plumbline::exchange {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kLongestDictionary = 4096;

/// The dictionary of a header: a literal of Python with three members in any order.
class Dictionary {
 public:
  explicit Dictionary(std::string_view text) : text_(text) {}

  NpyHeader parse() {
    expect('{');
    while (peek() != '}') {
      take_member(quoted());
      if (peek() != '}') expect(',');
    }
    expect('}');
    if (skip_space(); !text_.empty()) wrong();
    if (!has_type_ || !has_order_ || !has_shape_) {
      throw NpyError("has a header without \"descr\", \"fortran_order\" or \"shape\"");
    }
    return header_;
  }

 private:
  [[noreturn]] void wrong() const {
    throw NpyError("has a header that is not understood from " +
                   shown(text_.empty() ? "its end" : text_) + " on");
  }

  void skip_space() {
    while (!text_.empty() && std::isspace(static_cast<unsigned char>(text_.front())) != 0) {
      text_.remove_prefix(1);
    }
  }

  char peek() {
    skip_space();
    return text_.empty() ? '\0' : text_.front();
  }

  void expect(char c) {
    if (peek() != c) wrong();
    text_.remove_prefix(1);
  }

  bool skip_word(std::string_view word) {
    skip_space();
    if (text_.substr(0, word.size()) != word) return false;
    text_.remove_prefix(word.size());
    return true;
  }

  std::string_view quoted() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') wrong();
    const std::size_t end = text_.find(quote, 1);
    if (end == std::string_view::npos) wrong();
    const std::string_view inside = text_.substr(1, end - 1);
    text_.remove_prefix(end + 1);
    return inside;
  }

  void once(bool& seen, std::string_view name) {
    if (seen) throw NpyError("has a header with two of " + shown(name));
    seen = true;
  }

  void take_member(std::string_view name) {
    expect(':');
    if (name == "descr") {
      once(has_type_, name);
      take_type();
    } else if (name == "fortran_order") {
      once(has_order_, name);
      if (skip_word("True")) {
        throw NpyError("is in Fortran's order; write it in C order (np.ascontiguousarray)");
      }
      if (!skip_word("False")) wrong();
    } else if (name == "shape") {
      once(has_shape_, name);
      take_shape();
    } else {
      throw NpyError("has a header with an unknown member " + shown(name));
    }
  }

  void take_type() {
    if (peek() == '[') throw NpyError("is an array of records; plain numbers are wanted");
    const std::string_view type = quoted();
    for (const NpyType known : {NpyType::float32, NpyType::float64, NpyType::boolean}) {
      if (type != descr(known)) continue;
      header_.type = known;
      return;
    }
    throw NpyError("holds values of type " + shown(type) +
                   "; understood are <f4, <f8 and |b1 (float32 and float64, little endian, bool)");
  }

  std::size_t whole_number() {
    constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
    if (std::isdigit(static_cast<unsigned char>(peek())) == 0) wrong();
    std::size_t value = 0;
    while (!text_.empty() && std::isdigit(static_cast<unsigned char>(text_.front())) != 0) {
      value = value * 10 + static_cast<std::size_t>(text_.front() - '0');
      if (value > kMost) throw NpyError("has a shape with more than 2^32 rows or columns");
      text_.remove_prefix(1);
    }
    return value;
  }

  void take_shape() {
    expect('(');
    header_.dimensions = 0;
    while (peek() != ')') {
      const std::size_t size = whole_number();
      if (++header_.dimensions > 2) break;
      (header_.dimensions == 1 ? header_.rows : header_.columns) = size;
      if (peek() != ')') expect(',');
    }
    if (header_.dimensions < 1 || header_.dimensions > 2) {
      throw NpyError("has a shape of " +
                     std::string(header_.dimensions == 0 ? "no" : "more than two") +
                     " dimensions; arrays have one or two");
    }
    expect(')');
  }

  std::string_view text_;
  NpyHeader header_;
  bool has_type_ = false, has_order_ = false, has_shape_ = false;
};

std::string read_text(ByteSource& source, std::size_t count) {
  std::string text(count, '\0');
  source.read(reinterpret_cast<std::byte*>(text.data()), count);
  return text;
}

/// Little endian.
std::size_t number_of(std::string_view bytes) {
  std::size_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) {
    value = value << 8 | static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

}  // namespace

const char* descr(NpyType type) {
  return type == NpyType::float32 ? "<f4" : type == NpyType::float64 ? "<f8" : "|b1";
}

std::string shape_text(const NpyHeader& header) {
  if (header.dimensions == 1) return "(" + std::to_string(header.rows) + ",)";
  return "(" + std::to_string(header.rows) + ", " + std::to_string(header.columns) + ")";
}

std::string npy_header(const NpyHeader& header) {
  constexpr std::size_t kBeforeDictionary = 10;
  std::string text(kMagic);
  text += {'\1', '\0', static_cast<char>(kNpyHeaderSize - kBeforeDictionary), '\0'};
  text += "{'descr': '" + std::string(descr(header.type)) +
          "', 'fortran_order': False, 'shape': " + shape_text(header) + ", }";
  text.resize(kNpyHeaderSize - 1, ' ');
  return text + '\n';
}

NpyHeader read_npy_header(ByteSource& source) {
  const std::string start = read_text(source, kMagic.size() + 2);
  if (std::string_view(start).substr(0, kMagic.size()) != kMagic) {
    throw NpyError("does not begin as an NPY array does, but with " + shown(start));
  }
  const auto version = static_cast<unsigned char>(start[kMagic.size()]);
  if (version < 1 || version > 3) throw NpyError("is of a version of NPY that is not 1, 2 or 3");
  const std::size_t size = number_of(read_text(source, version == 1 ? 2 : 4));
  if (size > kLongestDictionary) {
    throw NpyError("has a header of " + std::to_string(size) + " bytes; " +
                   std::to_string(kLongestDictionary) + " are the most");
  }
  const std::string dictionary = read_text(source, size);
  return Dictionary(dictionary).parse();
}

}  // namespace plumbline::exchange
