#include "files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include <plumbline/reports/budgets.h>
#include <plumbline/reports/errors.h>

namespace plumbline::reports::detail {
namespace {

[[noreturn]] void throw_errno(const std::filesystem::path& path) {
  throw std::system_error(errno, std::generic_category(), path.string());
}

/// Writes all of `text`, in as many calls as it takes, and closes the file also on failure.
bool write_and_close(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int reason = errno;
      ::close(file);
      errno = reason;
      return false;
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::close(file) == 0;
}

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0 || !write_and_close(file, text)) throw_errno(path);
}

std::string read_file(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw_errno(path);
  std::error_code ignored;  // pipes have no size
  const std::uintmax_t bytes = std::filesystem::file_size(path, ignored);
  if (!ignored && bytes > kMaxResultsFileBytes) {
    throw BudgetError("has " + std::to_string(bytes) + " bytes, more than the " +
                      std::to_string(kMaxResultsFileBytes) +
                      " that a file of results may have: split it, or remove it");
  }
  std::string text(ignored ? 0 : static_cast<std::size_t>(bytes), '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  text.append(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  if (file.bad()) throw_errno(path);
  return text;
}

}  // namespace plumbline::reports::detail
