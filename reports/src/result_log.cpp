#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include <plumbline/reports/results.h>

namespace plumbline::reports {
namespace {

constexpr const char* kEnvironmentFile = "environment.jsonl";

int open_for_append(const std::filesystem::path& path, int extra_flags) {
  return ::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | extra_flags, 0666);
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

/// Of all processes that log into a directory, the first one notes the environment.
void note_environment_once(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / kEnvironmentFile;
  const int file = open_for_append(path, O_EXCL);
  if (file < 0) {
    if (errno == EEXIST) return;
    throw std::system_error(errno, std::generic_category(), path.string());
  }
  try {
    write_line(file, to_json(current_environment()), path);
  } catch (...) {
    ::close(file);
    throw;
  }
  ::close(file);
}

}  // namespace

ResultLog::ResultLog(const std::filesystem::path& directory, std::string_view name)
    : path_(directory / (std::string(name) + ".jsonl")) {
  std::filesystem::create_directories(directory);
  note_environment_once(directory);
  file_ = open_for_append(path_, 0);
  if (file_ < 0) throw std::system_error(errno, std::generic_category(), path_.string());
}

ResultLog::~ResultLog() { ::close(file_); }

void ResultLog::append_line(std::string line) { write_line(file_, std::move(line), path_); }

}  // namespace plumbline::reports
