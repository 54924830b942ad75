#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace plumbline::renderer {

/// The whole of a regular text file. Pipes and devices are refused: they may never end.
///
/// @throws InputError "file: why" where it is missing, not a regular file, not readable, empty,
///         larger than `max_bytes`, or holds a zero byte
std::string read_text_file(const std::filesystem::path& file, std::uintmax_t max_bytes);

/// @return line that holds the offset, counted from 1
std::size_t line_at(std::string_view text, std::size_t offset);

/// The text in quotes for a message: cut where it is long, control characters shown as '?'.
std::string in_quotes(std::string_view text);

}  // namespace plumbline::renderer
