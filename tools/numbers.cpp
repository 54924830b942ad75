#include "numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

namespace plumbline::tools {
namespace {

template <class T>
bool parses_whole(const std::string& text, T& value) {
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  return parsed.ec == std::errc() && parsed.ptr == end;
}

}  // namespace

CLI::Validator whole_number(std::int64_t smallest, std::int64_t largest) {
  return CLI::Validator(
      [=](const std::string& text) {
        std::int64_t value = 0;
        if (parses_whole(text, value) && value >= smallest && value <= largest) {
          return std::string();
        }
        return fmt::format("{} is not a whole number from {} to {}", text, smallest, largest);
      },
      "");
}

CLI::Validator positive_number() {
  return CLI::Validator(
      [](const std::string& text) {
        double value = 0;
        if (parses_whole(text, value) && std::isfinite(value) && value > 0) return std::string();
        return fmt::format("{} is not a positive number", text);
      },
      "");
}

}  // namespace plumbline::tools
