#pragma once

#include <string>
#include <string_view>

namespace plumbline::reports::detail {

/// Bytes as base64 (RFC 4648, section 4).
std::string base64_of(std::string_view bytes);

}  // namespace plumbline::reports::detail
