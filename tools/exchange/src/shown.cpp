#include "shown.h"

namespace plumbline::exchange {

std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 60;
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text.substr(0, kMost)) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code < 0x7f) {
      result += c;
    } else {
      result += "\\x";
      result += kDigits[code >> 4];
      result += kDigits[code & 15];
    }
  }
  return result + (text.size() > kMost ? "…\"" : "\"");
}

}  // namespace plumbline::exchange
