#include "property.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "named.h"
#include "text_file.h"
#include "values.h"

namespace plumbline::renderer {
namespace {

/// What an index may be named, with the values of the table in Mitsuba 3's ior.h.
const Named<double> kRefractiveIndices = {
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.5750},      {"diamond", 2.419},
};

/// The spectra of Mitsuba's data files as linear RGB, relative to air.
const Named<ConductorFresnel> kMetals = {
    {"Ag", {{0.155265f, 0.116723f, 0.138381f}, {4.82834f, 3.12225f, 2.14695f}}},
    {"Al", {{1.65746f, 0.880369f, 0.521229f}, {9.22387f, 6.26952f, 4.83700f}}},
    {"Au", {{0.143119f, 0.374957f, 1.44248f}, {3.98316f, 2.38572f, 1.60322f}}},
    {"Cr", {{4.36968f, 2.91670f, 1.65470f}, {5.20643f, 4.23136f, 3.75495f}}},
    {"Cu", {{0.200438f, 0.924033f, 1.10221f}, {3.91295f, 2.45285f, 2.14219f}}},
    {"none", {}},
};

[[noreturn]] void fail(const Element& element, const std::string& message) {
  element.fail(fmt::format("{}: {}", element.label(), message));
}

std::vector<std::string> names_of(const Range& range) {
  return {range.choices.begin(), std::find(range.choices.begin(), range.choices.end(), nullptr)};
}

template <class T>
const T& look_up(const Named<T>& table, const Element& element, const std::string& name) {
  if (const T* found = table.find(name)) return *found;
  fail(element, fmt::format("{} is not known; {}", in_quotes(name), table.hint(name)));
}

bool parse_boolean(const Element& element, const std::string& text) {
  if (text != "true" && text != "false") {
    fail(element, fmt::format("{} is neither \"true\" nor \"false\"", in_quotes(text)));
  }
  return text == "true";
}

std::string parse_string(const Element&, const std::string& text) { return text; }

ConductorFresnel parse_metal(const Element& element, const std::string& text) {
  return look_up(kMetals, element, text);
}

/// A default, which stands at the object, is a name.
double parse_index(const Element& element, const std::string& text) {
  return element.tag() == "float" ? parse_number(element, text)
                                  : look_up(kRefractiveIndices, element, text);
}

std::filesystem::path parse_file(const Element& element, const std::string& text) {
  if (text.empty()) fail(element, "names no file");
  return element.file().path().parent_path() / text;
}

Affine identity(const Element&, const std::string&) { return {}; }

std::vector<Element> no_objects(const Element&, const std::string&) { return {}; }

using ParseText = Value(const Element& at, const std::string& text);

/// What there is to know of a kind.
struct KindRow {
  std::vector<std::string> tags;  ///< of the elements that give one
  ParseText* parse;               ///< its text, or a default: that one stands at the object
};

template <Kind K, auto parse>
Value parsed(const Element& at, const std::string& text) {
  return Value(std::in_place_index<static_cast<std::size_t>(K)>, parse(at, text));
}

const KindRow& row_of(Kind kind) {
  static const std::map<Kind, KindRow> rows = {
      {Kind::number, {{"float"}, parsed<Kind::number, parse_number>}},
      {Kind::integer, {{"integer"}, parsed<Kind::integer, parse_integer>}},
      {Kind::boolean, {{"boolean"}, parsed<Kind::boolean, parse_boolean>}},
      {Kind::string, {{"string"}, parsed<Kind::string, parse_string>}},
      {Kind::rgb, {{"rgb"}, parsed<Kind::rgb, parse_rgb>}},
      {Kind::point, {{"point"}, parsed<Kind::point, parse_vector>}},
      {Kind::vector, {{"vector"}, parsed<Kind::vector, parse_vector>}},
      {Kind::transform, {{"transform"}, parsed<Kind::transform, identity>}},
      {Kind::index, {{"float", "string"}, parsed<Kind::index, parse_index>}},
      {Kind::metal, {{"string"}, parsed<Kind::metal, parse_metal>}},
      {Kind::file, {{"string"}, parsed<Kind::file, parse_file>}},
      {Kind::nested, {{}, parsed<Kind::nested, no_objects>}},
  };
  return rows.at(kind);
}

/// Points and vectors may have coordinates in place of a text.
Value parse_element(Kind kind, const Element& element) {
  if (kind == Kind::transform) {
    element.allow_attributes({"name"});
    return read_transform(element);
  }
  element.allow_no_children();
  if (kind != Kind::point && kind != Kind::vector) {
    element.allow_attributes({"name", "value"});
    return row_of(kind).parse(element, element.text("value"));
  }
  element.allow_attributes({"name", "x", "y", "z", "value"});
  constexpr auto xyz = [](const Element& at, const std::string&) { return parse_xyz(at, 0); };
  return (kind == Kind::point ? parsed<Kind::point, xyz> : parsed<Kind::vector, xyz>)(element, {});
}

/// What of a value has to lie between the bounds.
struct Numbers {
  std::vector<double> operator()(double v) const { return {v}; }
  std::vector<double> operator()(int v) const { return {static_cast<double>(v)}; }
  std::vector<double> operator()(const Rgbd& v) const { return {v.r, v.g, v.b}; }
  std::vector<double> operator()(const Vec3d& v) const { return {v.x, v.y, v.z}; }
  template <class T>
  std::vector<double> operator()(const T&) const {
    return {};
  }
};

void check(const Range& range, const Element& element, const Value& v) {
  const std::vector<std::string> choices = names_of(range);
  if (!choices.empty()) {
    const auto& name = std::get<std::string>(v);
    if (std::find(choices.begin(), choices.end(), name) == choices.end()) {
      fail(element, fmt::format("{} is not supported; supported: {}", in_quotes(name),
                                fmt::join(choices, ", ")));
    }
  }
  for (const double n : std::visit(Numbers{}, v)) {
    if (range.open ? n > range.low && n < range.high : n >= range.low && n <= range.high) continue;
    if (range.high < Range{}.high) {
      fail(element, fmt::format("must lie between {:g} and {:g}{}{}", range.low, range.high,
                                range.more, range.open ? ", both excluded" : ""));
    }
    fail(element, range.open ? "must be positive"
                             : fmt::format("must be at least {:g}{}", range.low, range.more));
  }
}

}  // namespace

std::vector<std::string> PropertyRow::tags() const {
  if (kind != Kind::nested) return row_of(kind).tags;
  return name == std::string("bsdf") ? std::vector<std::string>{"bsdf", "ref"}
                                     : std::vector<std::string>{name};
}

std::string PropertyRow::range_text() const {
  const std::vector<std::string> names = kind == Kind::metal ? kMetals.names() : names_of(range);
  if (!names.empty()) return fmt::format("{}", fmt::join(names, ", "));
  if (range.low == -Range{}.high) return {};
  if (range.high == Range{}.high) {
    return fmt::format("{} {:g}", range.open ? ">" : "≥", range.low);
  }
  if (range.low == range.high) return fmt::format("{:g}", range.low);
  return fmt::format("{:g} to {:g}{}", range.low, range.high, range.open ? ", excluded" : "");
}

Value parse_property(const PropertyRow& row, const Element& element) {
  Value result = parse_element(row.kind, element);
  check(row.range, element, result);
  return result;
}

Value absent_property(const PropertyRow& row, const Element& object) {
  return row_of(row.kind).parse(object, row.absent);
}

}  // namespace plumbline::renderer
