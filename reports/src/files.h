#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace plumbline::reports::detail {

/// Writes `text` beside `path` and renames it into place: the file appears whole or not at all.
///
/// @throws std::system_error naming the path
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

/// @throws std::system_error naming the path; BudgetError for a file larger than budgets.h says,
///         before it is read
std::string read_file(const std::filesystem::path& path);

}  // namespace plumbline::reports::detail
