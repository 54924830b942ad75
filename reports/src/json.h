#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace plumbline::reports::detail {

/// A JSON value, the members of an object in their order. The library that reads and writes the
/// text stands in json.cpp alone: it takes seconds to compile.
class Json {
 public:
  using Member = std::pair<std::string, Json>;

  Json() = default;  ///< null
  Json(std::nullptr_t) {}
  Json(std::same_as<bool> auto value) : value_(value) {}
  Json(std::signed_integral auto value) : value_(std::int64_t{value}) {}
  Json(std::unsigned_integral auto value) requires(!std::same_as<decltype(value), bool>)
      : value_(std::uint64_t{value}) {}
  Json(double value) : value_(value) {}
  Json(std::string value) : value_(std::move(value)) {}
  Json(std::string_view value) : value_(std::string(value)) {}
  Json(const char* value) : value_(std::string(value)) {}
  static Json array(std::initializer_list<Json> elements = {});
  static Json object(std::initializer_list<Member> members = {});

  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(const Json& other);
  Json& operator=(Json&& other) noexcept;
  ~Json();

  /// @throws FormatError for a text that is not JSON; BudgetError for one that is longer, or has
  ///         more in it, than budgets.h says
  static Json parse(std::string_view text);

  /// On one line. Text that is not UTF-8 gets replacement characters; what is not finite is null.
  std::string dump() const;

  bool is_null() const { return holds<std::nullptr_t>(); }
  bool is_bool() const { return holds<bool>(); }
  bool is_number() const { return holds<double>() || is_integer(); }
  bool is_integer() const { return holds<std::int64_t>() || is_unsigned(); }
  bool is_unsigned() const { return holds<std::uint64_t>(); }  ///< what was read as whole and ≥ 0
  bool is_string() const { return holds<std::string>(); }
  bool is_array() const { return holds<Array>(); }
  bool is_object() const { return holds<Object>(); }

  // What the value is not, throws std::bad_variant_access.

  bool as_bool() const { return std::get<bool>(value_); }
  const std::string& as_string() const { return std::get<std::string>(value_); }
  double as_double() const;
  std::int64_t as_int64() const;    ///< cut to 64 bits
  std::uint64_t as_uint64() const;  ///< cut to 64 bits

  const std::vector<Json>& elements() const { return std::get<Array>(value_); }
  const std::vector<Member>& members() const { return std::get<Object>(value_); }
  void push_back(Json element) { std::get<Array>(value_).push_back(std::move(element)); }

  /// The member of an object, or nullptr, of what is no object too.
  const Json* find(std::string_view name) const;

  /// The member of an object, added if it is missing: a null then.
  Json& operator[](std::string_view name);
  Json& operator[](std::size_t index) { return std::get<Array>(value_).at(index); }

  /// @throws std::out_of_range for a member or an element that is missing
  const Json& operator[](std::string_view name) const;
  const Json& operator[](std::size_t index) const { return elements().at(index); }

  void erase(std::string_view name);

  /// Numbers are compared by value, whole or not.
  friend bool operator==(const Json& a, const Json& b) { return equal(a, b); }
  friend std::ostream& operator<<(std::ostream& out, const Json& json) { return print(out, json); }

 private:
  using Array = std::vector<Json>;
  using Object = std::vector<Member>;

  template <class T>
  bool holds() const {
    return std::holds_alternative<T>(value_);
  }
  void append_to(std::string& text) const;
  static bool equal(const Json& a, const Json& b);
  static std::ostream& print(std::ostream& out, const Json& json);

  std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string, Array,
               Object>
      value_;
};

}  // namespace plumbline::reports::detail
