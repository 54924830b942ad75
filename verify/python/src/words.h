#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <plumbline/verify/detail/cause.h>
#include <plumbline/verify/detail/result.h>

/// Words for what has names of its own in C++. Each throws std::invalid_argument, in Python
/// ValueError, for a word that it does not know, and names those that it does.
namespace plumbline::python {

verify::Verdict verdict_of(std::string_view word);

/// None where nothing is named.
std::optional<std::string> cause_word(verify::CauseKind kind);

}  // namespace plumbline::python
