#include "node.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <plumbline/renderer/scene_file/nearest_name.h>

namespace plumbline::renderer {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
  return text.substr(0, text.find_last_not_of(kSpace) + 1);
}

}  // namespace

std::string label(Node node) {
  for (const char* key : {"name", "type", "id"}) {
    if (const pugi::xml_attribute found = node.attribute(key)) {
      return fmt::format("<{:.60} {}={}>", node.name(), key, in_quotes(found.value()));
    }
  }
  return tag_of(node);
}

void refuse_name(Node at, const std::string& message, std::string_view name,
                 const std::vector<std::string>& known) {
  refuse(at, "{}{}{}", message, known.empty() ? "" : "; ", name_hint(name, known));
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string shown(text.substr(0, kLongest));
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  std::replace_if(shown.begin(), shown.end(), is_control, '?');
  return fmt::format("\"{}{}\"", shown, text.size() > kLongest ? "…" : "");
}

std::string tag_of(Node node) { return fmt::format("<{:.60}>", node.name()); }

std::string attribute(Node node, const char* name) {
  const pugi::xml_attribute found = node.attribute(name);
  if (!found) refuse(node, "{} needs the attribute \"{}\"", label(node), name);
  return found.value();
}

void allow_attributes(Node node, const std::vector<std::string>& allowed) {
  for (const pugi::xml_attribute given : node.attributes()) {
    const std::string name = given.name();
    if (std::find(allowed.begin(), allowed.end(), name) != allowed.end()) continue;
    refuse_name(node, fmt::format("{} has no attribute {}", label(node), in_quotes(name)), name,
                allowed);
  }
}

void allow_only_attributes(Node node, const std::vector<std::string>& allowed) {
  allow_attributes(node, allowed);
  if (const Node child = node.first_child()) refuse(child, "{} may hold nothing", label(node));
}

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
  if (known.empty() || std::find(known.begin(), known.end(), text) != known.end()) {
    return std::string(text);
  }
  fail(at, "{} is not supported; supported: {}", in_quotes(text), range.text());
}

std::vector<double> parse_numbers(Node at, std::string_view text, const Range& range) {
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

Vec3d parse_vector(Node at, std::string_view text, const Range& range) {
  const std::vector<double> n = parse_numbers(at, text, range);
  if (n.size() == 1) return {n[0], n[0], n[0]};
  if (n.size() != 3) refuse(at, "{} needs one or three numbers, not {}", label(at), n.size());
  return {n[0], n[1], n[2]};
}

Rgbd parse_rgb(Node at, std::string_view text, const Range& range) {
  const Vec3d v = parse_vector(at, text, range);
  return {v.x, v.y, v.z};
}

std::string vector_text(Node at, const char* absent) {
  const bool by_coordinate = at.attribute("x") || at.attribute("y") || at.attribute("z");
  if (by_coordinate == !at.attribute("value").empty()) {
    refuse(at, "{} needs either \"value\" or any of \"x\", \"y\" and \"z\"", label(at));
  }
  if (!by_coordinate) return attribute(at, "value");
  const auto coordinate = [&](const char* name) { return at.attribute(name).as_string(absent); };
  return fmt::format("{}, {}, {}", coordinate("x"), coordinate("y"), coordinate("z"));
}

Vec3d unit_vector(Node at, const Vec3d& v, const char* why) {
  const double norm = length(v);
  if (!(norm > 0 && std::isfinite(norm))) fail(at, "{}", why);
  return v / norm;
}

}  // namespace plumbline::renderer
