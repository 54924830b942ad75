#pragma once

#include <string>

namespace plumbline::analytic {

/// Three channels: linear RGB with Rec. 709 primaries, or one number that is the same in all of
/// them. Light in one channel knows nothing of the others: an answer is worked out channel by
/// channel.
struct Colour {
  double r = 0, g = 0, b = 0;

  constexpr Colour() = default;
  constexpr Colour(double grey) : r(grey), g(grey), b(grey) {}
  constexpr Colour(double red, double green, double blue) : r(red), g(green), b(blue) {}

  friend constexpr bool operator==(const Colour&, const Colour&) = default;

  constexpr bool is_grey() const { return r == g && g == b; }
};

constexpr Colour operator+(const Colour& a, const Colour& b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
constexpr Colour operator-(const Colour& a, const Colour& b) {
  return {a.r - b.r, a.g - b.g, a.b - b.b};
}
constexpr Colour operator*(const Colour& a, const Colour& b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}
constexpr Colour operator/(const Colour& a, const Colour& b) {
  return {a.r / b.r, a.g / b.g, a.b / b.b};
}

/// f of each channel of its arguments.
template <class F, class... Colours>
constexpr Colour by_channel(const F& f, const Colours&... c) {
  return {f(c.r...), f(c.g...), f(c.b...)};
}

/// Whether the condition holds in each channel.
template <class Condition, class... Colours>
constexpr bool in_every_channel(const Condition& condition, const Colours&... c) {
  return condition(c.r...) && condition(c.g...) && condition(c.b...);
}

/// As a scene file and the command take it: "0.5" where it is grey, else "0.9,0.75,0.4"; with as
/// many digits as tell it from all others.
std::string to_text(const Colour& colour);

}  // namespace plumbline::analytic
