#include "json.h"

#include <algorithm>
#include <ostream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include <plumbline/reports/budgets.h>
#include <plumbline/reports/errors.h>

namespace plumbline::reports::detail {
namespace {

using Library = nlohmann::json;

void keep_within(std::size_t most, std::size_t count, const char* of_what) {
  if (count <= most) return;
  throw BudgetError("a record of more than " + std::to_string(most) + " " + of_what +
                    ": remove it, or what is not of Plumbline from the directory");
}

/// A leaf as the library writes it.
template <class T>
std::string leaf(const T& value) {
  return Library(value).dump(-1, ' ', false, Library::error_handler_t::replace);
}

/// Puts together what the library's parser finds.
class Builder : public Library::json_sax_t {
 public:
  explicit Builder(Json& root) : root_(root) {}

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(std::int64_t value) override { return put(value); }
  bool number_unsigned(std::uint64_t value) override { return put(value); }
  bool number_float(double value, const std::string&) override { return put(value); }
  bool string(std::string& value) override { return put(std::move(value)); }
  bool binary(Library::binary_t&) override { return false; }  // not in text
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(std::string& name) override {
    keep_within(kMaxMembers, open_.back()->members().size() + 1, "members in one object");
    name_ = std::move(name);
    return true;
  }
  bool parse_error(std::size_t, const std::string&,
                   const nlohmann::detail::exception& error) override {
    const std::string_view what =
        error.what();  // "[json.exception.parse_error.101] parse error at …"
    throw FormatError("not JSON, or only a part of it: " +
                      std::string(what.substr(std::min(what.find("] ") + 2, what.size()))));
  }

 private:
  bool put(Json value) {
    place(std::move(value));
    return true;
  }

  Json& place(Json value) {
    keep_within(kMaxRecordValues, ++values_, "values");
    if (open_.empty()) return root_ = std::move(value);
    Json& parent = *open_.back();
    if (parent.is_object()) return parent[name_] = std::move(value);
    parent.push_back(std::move(value));
    return parent[parent.elements().size() - 1];
  }

  bool open(Json container) {
    keep_within(kMaxJsonNesting, open_.size() + 1, "levels");
    open_.push_back(&place(std::move(container)));
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  Json& root_;
  std::vector<Json*> open_;  // each the last of the one before, which does not move meanwhile
  std::string name_;
  std::size_t values_ = 0;
};

}  // namespace

Json::Json(const Json& other) = default;
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(const Json& other) = default;
Json& Json::operator=(Json&& other) noexcept = default;
Json::~Json() = default;

Json Json::array(std::initializer_list<Json> elements) {
  Json json;
  json.value_ = Array(elements);
  return json;
}

Json Json::object(std::initializer_list<Member> members) {
  Json json;
  json.value_ = Object(members);
  return json;
}

Json Json::parse(std::string_view text) {
  keep_within(kMaxRecordBytes, text.size(), "bytes");
  Json json;
  Builder builder(json);
  Library::sax_parse(text, &builder);
  return json;
}

std::string Json::dump() const {
  std::string text;
  append_to(text);
  return text;
}

void Json::append_to(std::string& text) const {
  const char* separator = "";
  if (is_array()) {
    text += '[';
    for (const Json& element : elements()) {
      text += std::exchange(separator, ",");
      element.append_to(text);
    }
    text += ']';
  } else if (is_object()) {
    text += '{';
    for (const auto& [name, member] : members()) {
      text += std::exchange(separator, ",");
      text += leaf(name) + ':';
      member.append_to(text);
    }
    text += '}';
  } else if (is_string()) {
    text += leaf(as_string());
  } else if (is_unsigned()) {
    text += std::to_string(as_uint64());
  } else if (is_integer()) {
    text += std::to_string(as_int64());
  } else if (is_number()) {
    text += leaf(as_double());
  } else if (is_bool()) {
    text += as_bool() ? "true" : "false";
  } else {
    text += "null";
  }
}

double Json::as_double() const {
  if (const auto* whole = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*whole);
  if (const auto* whole = std::get_if<std::uint64_t>(&value_)) return static_cast<double>(*whole);
  return std::get<double>(value_);
}

std::int64_t Json::as_int64() const {
  if (const auto* whole = std::get_if<std::uint64_t>(&value_)) {
    return static_cast<std::int64_t>(*whole);
  }
  return std::get<std::int64_t>(value_);
}

std::uint64_t Json::as_uint64() const {
  if (const auto* whole = std::get_if<std::int64_t>(&value_)) {
    return static_cast<std::uint64_t>(*whole);
  }
  return std::get<std::uint64_t>(value_);
}

const Json* Json::find(std::string_view name) const {
  if (!is_object()) return nullptr;
  for (const auto& [key, member] : members()) {
    if (key == name) return &member;
  }
  return nullptr;
}

Json& Json::operator[](std::string_view name) {
  auto& members = std::get<Object>(value_);
  const auto found = std::find_if(members.begin(), members.end(),
                                  [&](const Member& m) { return m.first == name; });
  if (found != members.end()) return found->second;
  return members.emplace_back(name, nullptr).second;
}

const Json& Json::operator[](std::string_view name) const {
  if (const Json* member = find(name)) return *member;
  throw std::out_of_range("no member \"" + std::string(name) + "\"");
}

void Json::erase(std::string_view name) {
  std::erase_if(std::get<Object>(value_), [&](const Member& m) { return m.first == name; });
}

bool Json::equal(const Json& a, const Json& b) {
  if (!a.is_number() || !b.is_number()) return a.value_ == b.value_;
  if (!a.is_integer() || !b.is_integer()) return a.as_double() == b.as_double();
  const auto negative = [](const Json& json) { return !json.is_unsigned() && json.as_int64() < 0; };
  return negative(a) == negative(b) && a.as_uint64() == b.as_uint64();
}

std::ostream& Json::print(std::ostream& out, const Json& json) { return out << json.dump(); }

}  // namespace plumbline::reports::detail
