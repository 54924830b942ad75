#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

/// What a number on the command line must be. CLI11 alone takes -1 for an unsigned number, and
/// "nan" for a positive one.
namespace plumbline::tools {

CLI::Validator whole_number(std::int64_t smallest, std::int64_t largest);
CLI::Validator positive_number();

}  // namespace plumbline::tools
