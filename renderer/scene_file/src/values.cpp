#include "values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include "text_file.h"

namespace plumbline::renderer {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// @param kind  "a number", "a whole number": for the message
template <class T>
T parse(const Element& element, std::string_view text, std::string_view kind) {
  const std::string_view digits = trimmed(text);
  T value{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    element.fail(fmt::format("{}: {} is out of range", element.label(), in_quotes(digits)));
  }
  if (error != std::errc() || end != digits.data() + digits.size()) {
    element.fail(fmt::format("{}: {} is not {}", element.label(), in_quotes(digits), kind));
  }
  return value;
}

}  // namespace

double parse_number(const Element& element, std::string_view text) {
  const auto value = parse<double>(element, text, "a number");
  if (!std::isfinite(value)) {
    element.fail(fmt::format("{}: {} is not finite", element.label(), in_quotes(trimmed(text))));
  }
  return value;
}

int parse_integer(const Element& element, std::string_view text) {
  return parse<int>(element, text, "a whole number");
}

std::vector<double> parse_numbers(const Element& element, std::string_view text) {
  // Numbers hold no spaces, so that without commas the spaces separate.
  std::vector<double> numbers;
  std::string_view rest = trimmed(text);
  while (true) {
    const std::size_t end = std::min(rest.find_first_of(", \t\r\n"), rest.size());
    numbers.push_back(parse_number(element, rest.substr(0, end)));
    rest = trimmed(rest.substr(end));
    if (rest.empty()) return numbers;
    if (rest[0] == ',') rest = trimmed(rest.substr(1));
  }
}

Vec3d parse_vector(const Element& element, std::string_view text) {
  const std::vector<double> n = parse_numbers(element, text);
  if (n.size() == 1) return {n[0], n[0], n[0]};
  if (n.size() == 3) return {n[0], n[1], n[2]};
  element.fail(fmt::format("{} needs one or three numbers, not {}", element.label(), n.size()));
}

Vec3d parse_xyz(const Element& element, double absent) {
  const bool by_coordinate = element.has("x") || element.has("y") || element.has("z");
  if (by_coordinate == element.has("value")) {
    element.fail(
        fmt::format("{} needs either \"value\" or any of \"x\", \"y\" and \"z\"", element.label()));
  }
  if (by_coordinate) {
    const auto coordinate = [&](const char* name) {
      return element.has(name) ? parse_number(element, element.text(name)) : absent;
    };
    return {coordinate("x"), coordinate("y"), coordinate("z")};
  }
  return parse_vector(element, element.text("value"));
}

Vec3d parse_triple(const Element& element, const char* attribute) {
  const std::vector<double> n = parse_numbers(element, element.text(attribute));
  if (n.size() != 3) {
    element.fail(fmt::format("{}: \"{}\" needs three numbers, not {}", element.label(), attribute,
                             n.size()));
  }
  return {n[0], n[1], n[2]};
}

Rgbd parse_rgb(const Element& element, std::string_view text) {
  const Vec3d v = parse_vector(element, text);
  return {v.x, v.y, v.z};
}

}  // namespace plumbline::renderer
