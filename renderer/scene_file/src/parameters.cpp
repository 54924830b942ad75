#include "parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include <plumbline/renderer/scene_file/nearest_name.h>

#include "text_file.h"

namespace plumbline::renderer {
namespace {

constexpr std::string_view kNameStart = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
constexpr std::string_view kNameCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";

/// Length of the parameter name that `text` starts with.
std::size_t name_length(std::string_view text) {
  if (text.empty() || kNameStart.find(text[0]) == std::string_view::npos) return 0;
  return std::min(text.find_first_not_of(kNameCharacters), text.size());
}

}  // namespace

bool Parameters::is_name(std::string_view text) {
  return !text.empty() && name_length(text) == text.size();
}

bool Parameters::declare(const std::string& name, const std::string& value) {
  const auto override = overrides_.find(name);
  return values_.emplace(name, override == overrides_.end() ? value : override->second).second;
}

std::string Parameters::substitute(std::string_view text) const {
  std::string result;
  for (std::size_t dollar = text.find('$'); dollar != std::string_view::npos;
       dollar = text.find('$')) {
    result.append(text.substr(0, dollar));
    text.remove_prefix(dollar + 1);
    const std::string name(text.substr(0, name_length(text)));
    if (name.empty()) throw std::invalid_argument("a $ must be followed by a parameter's name");
    const auto found = values_.find(name);
    if (found == values_.end()) {
      std::vector<std::string> known;
      for (const auto& [declared, value] : values_) known.push_back(declared);
      const std::string hint = name_hint(name, known);
      throw std::invalid_argument(fmt::format("no <default> before this line declares ${}{}{}",
                                              name, hint.empty() ? "" : "; ", hint));
    }
    used_.insert(name);
    result.append(found->second);
    text.remove_prefix(name.size());
  }
  return result.append(text);
}

void Parameters::check_names(const std::vector<std::string>& declared) const {
  for (const auto& [name, value] : overrides_) {
    if (std::find(declared.begin(), declared.end(), name) != declared.end()) continue;
    throw std::invalid_argument(
        declared.empty()
            ? fmt::format("has no <default> parameters, so {} cannot be set", in_quotes(name))
            : fmt::format("no parameter {}; {}", in_quotes(name), name_hint(name, declared)));
  }
}

void Parameters::check_used() const {
  for (const auto& [name, value] : overrides_) {
    if (used_.count(name) == 0) {
      throw std::invalid_argument(
          fmt::format("parameter {} is set, but nothing in the file uses it", in_quotes(name)));
    }
  }
}

}  // namespace plumbline::renderer
