#include "text.h"

#include <cmath>
#include <cstdio>

namespace plumbline::verify {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string number(std::uint64_t value) { return std::to_string(value); }

std::string percent(double share) { return number(std::round(1e3 * share) / 10) + " %"; }

std::string place(const Vec3& x) {
  std::string text = "(";
  text += number(x[0]) + ", " + number(x[1]) + ", " + number(x[2]) + ")";
  return text;
}

}  // namespace plumbline::verify
