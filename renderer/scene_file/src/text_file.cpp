#include "text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <plumbline/renderer/core/errors.h>

namespace plumbline::renderer {
namespace {

/// Size of a file that is worth opening.
std::uintmax_t checked_size(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  const auto fail = [&](const std::string& why) {
    throw InputError(fmt::format("{}: {}", file.string(), why));
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) fail("there is no such file");
  if (error) fail(error.message());
  if (std::filesystem::is_directory(status)) fail("is a directory, not a file");
  if (!std::filesystem::is_regular_file(status)) fail("is not a regular file");
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error) fail(error.message());
  if (bytes == 0) fail("is empty");
  if (bytes > max_bytes) {
    fail(fmt::format("has {} bytes, more than the {} that such a file may have", bytes, max_bytes));
  }
  return bytes;
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  std::string text(checked_size(file, max_bytes), '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw InputError(fmt::format("{}: cannot be opened: {}", file.string(), std::strerror(errno)));
  }
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (static_cast<std::size_t>(in.gcount()) != text.size()) {
    throw InputError(fmt::format("{}: cannot be read to its end", file.string()));
  }
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {
    throw InputError(fmt::format("{}:{}: holds a zero byte, so it is not UTF-8 text", file.string(),
                                 line_at(text, zero)));
  }
  return text;
}

std::size_t line_at(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string shown(text.substr(0, kLongest));
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return fmt::format("\"{}{}\"", shown, text.size() > kLongest ? "…" : "");
}

}  // namespace plumbline::renderer
