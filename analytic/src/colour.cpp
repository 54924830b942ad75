#include <plumbline/analytic/colour.h>

#include <array>
#include <charconv>

namespace plumbline::analytic {
namespace {

std::string shortest(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

}  // namespace

std::string to_text(const Colour& colour) {
  std::string text = shortest(colour.r);
  if (colour.is_grey()) return text;
  return text.append(",").append(shortest(colour.g)).append(",").append(shortest(colour.b));
}

}  // namespace plumbline::analytic
