#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace plumbline::reports::detail {

/// Writes `text`, over what is there. Who needs the file whole or not at all writes it elsewhere
/// and renames it: tools' output_file.h.
///
/// @throws std::system_error naming the path
void write_file(const std::filesystem::path& path, std::string_view text);

/// @throws std::system_error naming the path; BudgetError for a file larger than budgets.h says,
///         before it is read
std::string read_file(const std::filesystem::path& path);

}  // namespace plumbline::reports::detail
