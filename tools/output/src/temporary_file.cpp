#include "temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include <plumbline/output/failure.h>
#include <plumbline/output/stop.h>

#include "hash.h"

namespace plumbline::output {
namespace {

namespace fs = std::filesystem;

/// The same for the same target, and short: a name of 255 bytes has room for no more.
std::string prefix_of(const fs::path& target) {
  Hash hash;
  hash.add(target.filename().string());
  return fmt::format(".plumbline-{:016x}-", hash.value());
}

bool is_still_at(int file, const fs::path& path) {
  struct stat held {
  }, named{};
  return fstat(file, &held) == 0 && lstat(path.c_str(), &named) == 0 &&
         held.st_dev == named.st_dev && held.st_ino == named.st_ino;
}

/// The file of a process that was killed; that of one that lives is locked.
void remove_if_left(const fs::path& path) {
  const int file = open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return;
  if (flock(file, LOCK_EX | LOCK_NB) == 0 && is_still_at(file, path)) unlink(path.c_str());
  close(file);
}

void remove_left_files(const fs::path& folder, const std::string& prefix) {
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
    if (ignored) return;
    const std::string name = entry->path().filename().string();
    if (name.compare(0, prefix.size(), prefix) == 0) remove_if_left(entry->path());
  }
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& folder, const fs::path& target) {
  static std::atomic<unsigned> made = 0;
  const std::string prefix = prefix_of(target);
  remove_left_files(folder, prefix);
  do {
    path_ = folder / fmt::format("{}{}-{}", prefix, getpid(), made++);
  } while (!make(path_));
}

/// @return false where the name is taken, or another process took the file for one that was left
bool TemporaryFile::make(const fs::path& path) {
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file_ < 0 && errno == EEXIST) return false;
  if (file_ < 0) throw_errno(path.parent_path().string(), "cannot make a file there", errno);
  slot_ = remove_on_signal(path.c_str());
  // Some file systems have no locks: there nothing takes it for a file that was left, either.
  const bool is_ours = flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  if (is_ours && is_still_at(file_, path)) return true;
  forget_on_signal(slot_);
  close(file_);
  file_ = -1;
  return false;
}

TemporaryFile::~TemporaryFile() {
  if (!path_.empty()) unlink(path_.c_str());
  forget_on_signal(slot_);
  if (file_ >= 0) close(file_);
}

void TemporaryFile::move_to(const fs::path& target, bool synced) {
  if (synced && fsync(file_) != 0) throw_errno(target.string(), "cannot be written", errno);
  if (std::rename(path_.c_str(), target.c_str()) != 0) {
    throw_errno(target.string(), "cannot be put in its place", errno);
  }
  path_.clear();
}

}  // namespace plumbline::output
