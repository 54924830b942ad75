#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace plumbline::renderer {

/// The value that the command line calls `text`.
///
/// @param values  of an enumeration with a function name(Value), all of them: kStrategies,
/// kSamplers
/// @return        nullopt for a name that none of them has
template <class Value, std::size_t N>
constexpr std::optional<Value> from_name(const std::array<Value, N>& values,
                                         std::string_view text) {
  for (const Value value : values) {
    if (name(value) == text) return value;
  }
  return std::nullopt;
}

}  // namespace plumbline::renderer
