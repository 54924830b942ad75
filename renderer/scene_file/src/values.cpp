#include "values.h"

#include <cmath>
#include <type_traits>

namespace plumbline::renderer {
namespace {

/// What tells lengths and angles apart from rounded ones: matrices are written with six digits.
constexpr double kShapeTolerance = 1e-5;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kWhite = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(kWhite), text.size()));
  return text.substr(0, text.find_last_not_of(kWhite) + 1);
}

/// Numbers separated by spaces, or by commas with or without spaces.
std::vector<double> parse_numbers(Node at, std::string_view text, const Range& range = {}) {
  // Numbers hold no spaces, so that without commas the spaces separate.
  std::vector<double> numbers;
  std::string_view rest = trimmed(text);
  while (true) {
    const std::size_t end = std::min(rest.find_first_of(", \t\r\n"), rest.size());
    numbers.push_back(parse_number<double>(at, rest.substr(0, end), range));
    rest = trimmed(rest.substr(end));
    if (rest.empty()) return numbers;
    if (rest[0] == ',') rest = trimmed(rest.substr(1));
  }
}

/// An element's `value`, or any of its `x`, `y`, `z` as the text of a vector.
///
/// @param absent  what a coordinate is that is not given
std::string vector_text(Node at, const char* absent) {
  const bool by_coordinate = at.attribute("x") || at.attribute("y") || at.attribute("z");
  if (by_coordinate == !at.attribute("value").empty()) {
    refuse(at, "{} needs either \"value\" or any of \"x\", \"y\" and \"z\"", label(at));
  }
  if (!by_coordinate) return attribute(at, "value");
  const auto coordinate = [&](const char* name) { return at.attribute(name).as_string(absent); };
  return fmt::format("{}, {}, {}", coordinate("x"), coordinate("y"), coordinate("z"));
}

Affine read_translate(Node at) {
  Affine result;
  result.origin = parse_vector(at, vector_text(at, "0"));
  return result;
}

Affine read_scale(Node at) {
  const Vec3d s = parse_vector(at, vector_text(at, "1"));
  return {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}};
}

/// Right-handed rotation about an axis through the origin (Rodrigues).
Affine read_rotate(Node at) {
  const Vec3d axis =
      unit_vector(at, parse_vector(at, vector_text(at, "0")), "the axis has no direction");
  const double angle = parse_number<double>(at, attribute(at, "angle")) * pi<double>() / 180;
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](const Vec3d& v) {
    return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
  };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), {}};
}

/// 3×3 or 4×4, row by row.
Affine read_matrix(Node at) {
  const std::vector<double> m = parse_numbers(at, attribute(at, "value"));
  if (m.size() == 9) return {{m[0], m[3], m[6]}, {m[1], m[4], m[7]}, {m[2], m[5], m[8]}, {}};
  if (m.size() != 16) refuse(at, "<matrix> needs 9 or 16 numbers, not {}", m.size());
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
    refuse(at, "<matrix> must have the last row 0 0 0 1: projections are not supported");
  }
  return {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
}

/// To world from a camera at `origin` that looks along +z towards `target`, +x to its left.
Affine read_lookat(Node at) {
  const auto three = [&](const char* name) -> Vec3d {
    const std::vector<double> n = parse_numbers(at, attribute(at, name));
    if (n.size() != 3) fail(at, "\"{}\" needs three numbers, not {}", name, n.size());
    return {n[0], n[1], n[2]};
  };
  const Vec3d origin = three("origin");
  const Vec3d forward =
      unit_vector(at, three("target") - origin, "\"target\" and \"origin\" are the same point");
  const Vec3d left = cross(unit_vector(at, three("up"), "\"up\" has no direction"), forward);
  if (!(length(left) > kShapeTolerance)) fail(at, "\"up\" points along the line of sight");
  return {normalize(left), cross(forward, normalize(left)), forward, origin};
}

struct Operation {
  std::vector<std::string> attributes;
  Affine (*read)(Node at);
};

const Named<Operation> kOperations = {
    {"translate", {{"x", "y", "z", "value"}, read_translate}},
    {"rotate", {{"x", "y", "z", "value", "angle"}, read_rotate}},
    {"scale", {{"x", "y", "z", "value"}, read_scale}},
    {"matrix", {{"value"}, read_matrix}},
    {"lookat", {{"origin", "target", "up"}, read_lookat}},
};

}  // namespace

void Range::check(Node at, double n) const {
  if (open ? n > low && n < high : n >= low && n <= high) return;
  if (high < Range{}.high) {
    fail(at, "must lie between {:g} and {:g}{}{}", low, high, more, open ? ", both excluded" : "");
  }
  if (open) fail(at, "must be positive");
  fail(at, "must be at least {:g}{}", low, more);
}

std::string Range::text() const {
  if (!choices.empty()) return fmt::format("{}", fmt::join(choices, ", "));
  if (low == -Range{}.high) return {};
  if (high == Range{}.high) return fmt::format("{} {:g}", open ? ">" : "≥", low);
  if (low == high) return fmt::format("{:g}", low);
  return fmt::format("{:g} to {:g}{}", low, high, open ? ", excluded" : "");
}

bool perpendicular(const Vec3d& a, const Vec3d& b) {
  return std::abs(dot(a, b)) <= kShapeTolerance * length(a) * length(b);
}

bool same_length(const Vec3d& a, const Vec3d& b) {
  return std::abs(length(a) - length(b)) <= kShapeTolerance * length(a);
}

bool is_orthogonal(const Affine& m) {
  return perpendicular(m.x, m.y) && perpendicular(m.y, m.z) && perpendicular(m.z, m.x);
}

bool is_rigid(const Affine& m) {
  const Vec3d unit{1, 0, 0};
  return is_orthogonal(m) && same_length(unit, m.x) && same_length(unit, m.y) &&
         same_length(unit, m.z);
}

Vec3d unit_vector(Node at, const Vec3d& v, const char* why) {
  const double norm = length(v);
  if (!(norm > 0 && std::isfinite(norm))) fail(at, "{}", why);
  return v / norm;
}

std::string text_of(Node property) {
  const std::string_view tag = property.name();
  if (tag == "transform") {  // holds operations
    allow_attributes(property, {"name"});
    return {};
  }
  if (tag == "point" || tag == "vector") {
    allow_only_attributes(property, {"name", "x", "y", "z", "value"});
    return vector_text(property, "0");
  }
  allow_only_attributes(property, {"name", "value"});
  return attribute(property, "value");
}

template <class T>
T parse_number(Node at, std::string_view text, const Range& range) {
  constexpr const char* kKind = std::is_integral_v<T> ? "a whole number" : "a number";
  const std::string_view digits = trimmed(text);
  T value{};
  const std::errc error = parse_whole(digits, value);
  if (error == std::errc::result_out_of_range) fail(at, "{} is out of range", in_quotes(digits));
  if (error != std::errc()) fail(at, "{} is not {}", in_quotes(digits), kKind);
  if (!std::isfinite(static_cast<double>(value))) fail(at, "{} is not finite", in_quotes(digits));
  range.check(at, value);
  return value;
}

template double parse_number(Node at, std::string_view text, const Range& range);
template int parse_number(Node at, std::string_view text, const Range& range);

bool parse_boolean(Node at, std::string_view text, const Range& /*range*/) {
  if (text == "true" || text == "false") return text == "true";
  fail(at, "{} is neither \"true\" nor \"false\"", in_quotes(text));
}

std::string parse_string(Node at, std::string_view text, const Range& range) {
  const std::vector<std::string>& known = range.choices;
  if (known.empty() || contains(known, text)) return std::string(text);
  const std::string advice = advice_for(text);
  fail(at, "{} is not supported; {}", in_quotes(text),
       advice.empty() ? "supported: " + range.text() : advice);
}

Vec3d parse_vector(Node at, std::string_view text, const Range& range) {
  const std::vector<double> n = parse_numbers(at, text, range);
  if (n.size() == 1) return {n[0], n[0], n[0]};
  if (n.size() != 3) refuse(at, "{} needs one or three numbers, not {}", label(at), n.size());
  return {n[0], n[1], n[2]};
}

Rgbd parse_rgb(Node at, std::string_view text, const Range& range) {
  if (text.find('#') != std::string_view::npos) {
    fail(at, "{} is not a number: write linear ones, each (c / 255)^2.2 or so of the sRGB byte c",
         in_quotes(text));
  }
  const bool is_constant = trimmed(text).find_first_of(":, \t\r\n") == std::string_view::npos;
  if (at.name() == std::string_view("spectrum") && !is_constant) {
    fail(at, "only one number, which is grey, is supported: write <rgb> with the linear colour");
  }
  const Vec3d v = parse_vector(at, text, range);
  return {v.x, v.y, v.z};
}

Affine parse_transform(Node at, std::string_view text, const Range& /*range*/) {
  if (!text.empty()) return {};  // the default
  Affine result;
  for (const Node node : at.children()) {
    const Operation& operation =
        look_up(kOperations, node.name(), node, tag_of(node) + " is not a transform operation");
    allow_only_attributes(node, operation.attributes);
    result = operation.read(node) * result;
  }
  const auto& [x, y, z] = result.origin;
  const double determinant = result.determinant();  // not finite if a column is not
  if (!std::isfinite(determinant) || !std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
    refuse(at, "{} overflows", label(at));
  }
  // Relative to the longest that the columns allow (Hadamard): free of the scene's scale.
  const double largest = length(result.x) * length(result.y) * length(result.z);
  if (!(std::abs(determinant) > 1e-12 * largest)) {
    refuse(at, "{} is singular: it flattens space", label(at));
  }
  return result;
}

}  // namespace plumbline::renderer
