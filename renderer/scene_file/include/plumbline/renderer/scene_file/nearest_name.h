#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumbline::renderer {

/// What to tell somebody who wrote a name that is not known.
///
/// @param known  the names that would have been right
/// @return       `did you mean "radius"?` for the known name with the smallest edit distance, if
///               that is at most half the length of `name`; else `supported: a, b, c`; empty if
///               nothing is known
std::string name_hint(std::string_view name, const std::vector<std::string>& known);

}  // namespace plumbline::renderer
