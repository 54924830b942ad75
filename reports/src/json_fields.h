#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <plumbline/reports/errors.h>

#include "json.h"

/// Each record names its fields once, in a function `visit_fields(visitor, record)`; the two
/// visitors below write and read them, so that the two directions cannot drift apart.
namespace plumbline::reports::detail {

/// NaN as null and ±∞ as text: JSON has no number for them.
Json json_from_double(double value);
/// @throws FormatError for anything that json_from_double does not make
double double_from_json(const Json& value);

/// The words for the values of an enumeration: a specialisation holds `kWords`, pairs of value and
/// word, or both functions, `word` of a value and `value` (or nullopt) of a word.
template <class Enum>
struct EnumWords;

template <class Record>
Json record_to_json(const Record& record);
template <class Record>
Record record_from_json(const Json& json);

class FieldWriter {
 public:
  explicit FieldWriter(Json& json) : json_(json) {}

  /// Of a field that records may lack, older ones among them.
  bool wants(const char*, bool is_set) const { return is_set; }

  template <class T>
  void operator()(const char* name, const T& value) {
    json_[name] = to_value(value);
  }

 private:
  template <class T>
  static Json to_value(const T& value) {
    if constexpr (std::is_floating_point_v<T>) {
      return json_from_double(value);
    } else if constexpr (std::is_same_v<T, std::optional<double>>) {
      return value ? json_from_double(*value) : Json();
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      return value;
    } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
      return value.generic_string();
    } else if constexpr (std::is_enum_v<T>) {
      return word(value);
    } else {
      return record_to_json(value);
    }
  }
  template <class Enum>
  static std::string word(Enum value) {
    if constexpr (requires { EnumWords<Enum>::word(value); }) {
      return std::string(EnumWords<Enum>::word(value));
    } else {
      for (const auto& [candidate, text] : EnumWords<Enum>::kWords) {
        if (candidate == value) return text;
      }
      throw FormatError("a value of an enumeration that has no word");
    }
  }
  template <class T>
  static Json to_value(const std::vector<T>& values) {
    Json list = Json::array();
    for (const T& value : values) list.push_back(to_value(value));
    return list;
  }
  template <std::size_t n>
  static Json to_value(const std::array<double, n>& values) {
    return to_value(std::vector<double>(values.begin(), values.end()));
  }
  template <class T>
  static Json to_value(const std::map<std::string, T>& values) {
    Json object = Json::object();
    for (const auto& [key, value] : values) object[key] = to_value(value);
    return object;
  }
  static Json to_value(const std::vector<std::pair<std::string, double>>& values) {
    Json list = Json::array();
    for (const auto& [key, value] : values) {
      list.push_back(Json::array({key, json_from_double(value)}));
    }
    return list;
  }

  Json& json_;
};

class FieldReader {
 public:
  explicit FieldReader(const Json& json) : json_(json) {}

  bool wants(const char* name, bool) const { return json_.find(name) != nullptr; }

  template <class T>
  void operator()(const char* name, T& value) {
    const Json* field = json_.find(name);
    if (field == nullptr) throw FormatError("field \"" + std::string(name) + "\" is missing");
    try {
      from_value(*field, value);
    } catch (const FormatError& error) {
      throw FormatError("field \"" + std::string(name) + "\": " + error.what());
    }
  }

 private:
  static void from_value(const Json& json, double& value) { value = double_from_json(json); }
  static void from_value(const Json& json, std::optional<double>& value) {
    value = json.is_null() ? std::nullopt : std::optional(double_from_json(json));
  }
  static void from_value(const Json& json, bool& value) {
    if (!json.is_bool()) throw FormatError("not true or false");
    value = json.as_bool();
  }
  static void from_value(const Json& json, std::uint64_t& value) {
    if (!json.is_unsigned()) throw FormatError("not a whole number >= 0");
    value = json.as_uint64();
  }
  static void from_value(const Json& json, int& value) {
    const bool in_range =
        json.is_unsigned()
            ? json.as_uint64() <= std::numeric_limits<int>::max()
            : json.is_integer() && json.as_int64() >= std::numeric_limits<int>::min();
    if (!in_range) throw FormatError("not a whole number of 32 bits");
    value = static_cast<int>(json.as_int64());
  }
  static void from_value(const Json& json, std::string& value) {
    if (!json.is_string()) throw FormatError("not a text");
    value = json.as_string();
  }
  template <class T>
  static void from_value(const Json& json, std::vector<T>& values) {
    if (!json.is_array()) throw FormatError("not a list");
    values.clear();
    for (const Json& element : json.elements()) from_value(element, values.emplace_back());
  }
  template <std::size_t n>
  static void from_value(const Json& json, std::array<double, n>& values) {
    if (!json.is_array() || json.elements().size() != n) {
      throw FormatError("not a list of " + std::to_string(n) + " numbers");
    }
    for (std::size_t i = 0; i < n; ++i) values[i] = double_from_json(json[i]);
  }
  template <class T>
  static void from_value(const Json& json, std::map<std::string, T>& values) {
    if (!json.is_object()) throw FormatError("not an object");
    values.clear();
    for (const auto& [key, element] : json.members()) from_value(element, values[key]);
  }
  static void from_value(const Json& json, std::pair<std::string, double>& value) {
    if (!json.is_array() || json.elements().size() != 2) {
      throw FormatError("not a pair of name and number");
    }
    from_value(json[0], value.first);
    value.second = double_from_json(json[1]);
  }
  static void from_value(const Json& json, std::filesystem::path& value) {
    std::string text;
    from_value(json, text);
    value = text;
  }
  template <class T>
  static void from_value(const Json& json, T& value) {
    if constexpr (std::is_enum_v<T>) {
      value = enum_from_word<T>(json);
    } else {
      value = record_from_json<T>(json);
    }
  }
  template <class Enum>
  static Enum enum_from_word(const Json& json) {
    if constexpr (requires(std::string_view text) { EnumWords<Enum>::value(text); }) {
      const auto value = EnumWords<Enum>::value(json.is_string() ? json.as_string() : "");
      if (value) return *value;
    } else {
      for (const auto& [value, word] : EnumWords<Enum>::kWords) {
        if (json == word) return value;
      }
    }
    throw FormatError("unknown word " + json.dump());
  }

  const Json& json_;
};

template <class Record>
Json record_to_json(const Record& record) {
  Json json = Json::object();
  FieldWriter writer(json);
  visit_fields(writer, record);
  return json;
}

template <class Record>
Record record_from_json(const Json& json) {
  if (!json.is_object()) throw FormatError("not an object");
  Record record;
  FieldReader reader(json);
  visit_fields(reader, record);
  return record;
}

/// One line of JSON that states its format first. Text that is not UTF-8 gets replacement
/// characters.
template <class Record>
std::string document(const char* format, const Record& record) {
  Json json = Json::object();
  json["format"] = format;
  FieldWriter writer(json);
  visit_fields(writer, record);
  return json.dump();
}

/// The "format" of a document; empty where it states none.
std::string format_of(const Json& json);

/// @throws FormatError unless the document states this format
void require_format(const Json& json, std::string_view format);

template <class Record>
Record parse_document(const char* format, std::string_view text) {
  const Json json = Json::parse(text);
  require_format(json, format);
  return record_from_json<Record>(json);
}

}  // namespace plumbline::reports::detail
