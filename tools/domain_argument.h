#pragma once

#include <optional>
#include <string>

#include <plumbline/verify/detail/domain.h>

namespace plumbline::tools {

/// The domain that --domain names: "disk", "disk:2", "discrete:5", "equirectangular:64x32";
/// nothing for "bsdf".
///
/// @throws renderer::InputError for what names none
std::optional<verify::Domain> parse_domain(const std::string& text);

}  // namespace plumbline::tools
