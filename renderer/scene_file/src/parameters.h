#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plumbline::renderer {

/// The file's <default> parameters with the values in force, and the text that $name stands for.
class Parameters {
 public:
  explicit Parameters(std::map<std::string, std::string> overrides)
      : overrides_(std::move(overrides)) {}

  /// What a <default> does: its value holds unless overridden.
  /// @return false if the name was declared before
  bool declare(const std::string& name, const std::string& value);

  /// The text with every $name replaced. The values put in are not looked at again.
  /// @throws std::invalid_argument with the reason, for a $ without a declared name behind it
  std::string substitute(std::string_view text) const;

  /// @param declared  names of all <default> elements of the file
  /// @throws std::invalid_argument if an override names none of them
  void check_names(const std::vector<std::string>& declared) const;

  /// To be called when the file has been read.
  /// @throws std::invalid_argument if an override changed a parameter that nothing uses
  void check_used() const;

  const std::map<std::string, std::string>& values() const { return values_; }

  /// Letters, digits and '_', not starting with a digit.
  static bool is_name(std::string_view text);

 private:
  std::map<std::string, std::string> overrides_;
  std::map<std::string, std::string> values_;
  mutable std::set<std::string> used_;
};

}  // namespace plumbline::renderer
