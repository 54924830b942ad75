#pragma once

#include <span>
#include <string>

namespace plumbline::reports::detail {

/// 32-bit floats, little-endian, as base64 (RFC 4648, section 4).
std::string base64_of_floats(std::span<const float> values);

}  // namespace plumbline::reports::detail
