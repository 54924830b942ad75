#pragma once

#include <string>
#include <string_view>

namespace plumbline::exchange {

/// What a program wrote as a person is to see it: in quotes, the first 60 bytes, those that are not
/// printable as \x07.
std::string shown(std::string_view text);

}  // namespace plumbline::exchange
