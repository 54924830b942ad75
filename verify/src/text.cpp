#include "text.h"

#include <cstdio>

namespace plumbline::verify {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string number(std::uint64_t value) { return std::to_string(value); }

}  // namespace plumbline::verify
