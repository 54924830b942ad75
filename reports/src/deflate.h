#pragma once

#include <string>
#include <string_view>

namespace plumbline::reports::detail {

/// Bytes made smaller, in the format that browsers call "deflate": RFC 1951 in the wrapping of RFC
/// 1950, with a check sum.
std::string deflate(std::string_view bytes);

}  // namespace plumbline::reports::detail
