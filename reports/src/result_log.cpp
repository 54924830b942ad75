#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include <plumbline/reports/results.h>

#include "files.h"

namespace plumbline::reports {
namespace {

int open_for_append(const std::filesystem::path& path, int extra_flags) {
  return ::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | extra_flags, 0666);
}

void write_line(int file, std::string line, const std::filesystem::path& path) {
  line += '\n';
  ssize_t written = 0;
  do {
    errno = 0;
    written = ::write(file, line.data(), line.size());
  } while (written < 0 && errno == EINTR);
  if (written == static_cast<ssize_t>(line.size())) return;
  // A short write means a full disk or a quota; a second write() could land behind another's line.
  throw std::system_error(errno != 0 ? errno : ENOSPC, std::generic_category(), path.string());
}

/// Whether a process died in the middle of its last line.
bool ends_torn(int file) {
  const off_t size = ::lseek(file, 0, SEEK_END);
  char last = '\n';
  return size > 0 && ::pread(file, &last, 1, size - 1) == 1 && last != '\n';
}

}  // namespace

ResultLog::ResultLog(const std::filesystem::path& directory, std::string_view name)
    : path_(directory / (std::string(name) + ".jsonl")) {
  std::filesystem::create_directories(directory);
  file_ = open_for_append(path_, O_EXCL);
  const bool is_new = file_ >= 0;
  if (!is_new) file_ = open_for_append(path_, 0);
  if (file_ < 0) throw std::system_error(errno, std::generic_category(), path_.string());
  try {
    if (is_new) append(current_environment());
    if (ends_torn(file_)) append_line("");  // or the next record would be lost with the torn one
  } catch (...) {
    ::close(file_);
    throw;
  }
}

ResultLog::~ResultLog() { ::close(file_); }

void ResultLog::append_line(std::string line) { write_line(file_, std::move(line), path_); }

void write_checks(const std::filesystem::path& path,
                  const std::vector<verify::CheckResult>& results) {
  std::string text = to_json(current_environment()) + "\n";
  for (const verify::CheckResult& result : results) text += to_json(result) + "\n";
  detail::write_file(path, text);
}

}  // namespace plumbline::reports
