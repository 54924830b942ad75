#include <plumbline/output/output_file.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <fstream>
#include <new>
#include <string_view>
#include <system_error>

#include <plumbline/output/failure.h>
#include <plumbline/renderer/core/errors.h>

#include "temporary_file.h"

namespace plumbline::output {
namespace {

namespace fs = std::filesystem;

bool is_standard_output(const fs::path& path) {
  return path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

/// A copy of the standard output, for a file. What is printed goes to the standard error from then
/// on, not between its bytes.
int take_standard_output() {
  static int taken = -1;
  if (taken >= 0) return taken;
  std::fflush(stdout);
  taken = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (taken < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
    throw_errno("/dev/stdout", "cannot be written to", errno);
  }
  return taken;
}

void write_all(int file, std::string_view bytes, const std::string& name) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      throw renderer::MachineError(
          fmt::format("{}: cannot be written; is it full? {}", name,
                      std::error_code(errno, std::generic_category()).message()));
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// A file descriptor that is closed, but for one that is kept.
class Descriptor {
 public:
  Descriptor(int file, bool keep) : file_(file), keep_(keep) {}
  ~Descriptor() {
    if (!keep_) close(file_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return file_; }

 private:
  int file_;
  bool keep_;
};

/// The name with what it must not be.
renderer::InputError two_of(const std::string& option, const fs::path& path,
                            const std::string& why) {
  return renderer::InputError(
      fmt::format("{} {}: is {}; nothing was written", option, path.string(), why));
}

}  // namespace

OutputFile::OutputFile(const fs::path& path, bool synced) : given_(path), synced_(synced) {
  if (is_standard_output(path)) {
    stream_ = take_standard_output();
    identity_.name = path;
  } else {
    identity_ = identity_of(path);
  }
  std::error_code ignored;
  if (!identity_.is_regular && fs::is_directory(path, ignored)) {
    throw renderer::InputError(path.string() + ": is a directory");
  }
  const fs::path folder = is_device() ? fs::temp_directory_path() : identity_.name.parent_path();
  try {
    temporary_ = std::make_unique<TemporaryFile>(folder, identity_.name);
  } catch (const renderer::InputError& error) {
    throw renderer::InputError(
        fmt::format("{}: cannot write to its directory: {}", path.string(), error.what()));
  }
}

OutputFile::~OutputFile() = default;

void OutputFile::fill(const std::function<void(const fs::path&)>& write) {
  const std::string written = temporary_->path().string();
  try {
    write(temporary_->path());
    is_filled_ = true;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    Failure failure = failure_of(std::current_exception());
    const std::size_t at = failure.what.find(written);
    if (at != std::string::npos) failure.what.replace(at, written.size(), given_.string());
    if (failure.exit_code == kExitBadInput) throw renderer::InputError(failure.what);
    throw renderer::MachineError(failure.what);
  }
}

void OutputFile::finish() {
  if (is_device()) {
    copy_to_device();
  } else {
    temporary_->move_to(identity_.name, synced_);
  }
}

void OutputFile::copy_to_device() const {
  const int file = stream_ >= 0 ? stream_ : open(given_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (file < 0) throw_errno(given_.string(), "cannot be opened", errno);
  const Descriptor out(file, stream_ >= 0);
  const fs::path& written = temporary_->path();
  std::ifstream in(written, std::ios::binary);
  std::array<char, 1 << 16> buffer;
  while (in.read(buffer.data(), buffer.size()), in.gcount() > 0) {
    write_all(out.get(), {buffer.data(), static_cast<std::size_t>(in.gcount())}, given_.string());
  }
  if (in.bad()) throw renderer::MachineError(written.string() + ": cannot be read back");
}

void Files::reads_first(const fs::path& path) const {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return;
  const FileIdentity identity = identity_of(path);
  for (const Written& written : written_) {
    if (written.file->is_device() || !(written.file->identity() == identity)) continue;
    throw two_of(written.option, written.file->target(),
                 fmt::format("the same file as {}, which is read", path.string()));
  }
}

void Files::reads(const fs::path& path) {
  reads_first(path);
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) read_.push_back(identity_of(path));
}

OutputFile& Files::writes(const std::string& option, const fs::path& path) {
  auto file = std::make_unique<OutputFile>(path);
  const FileIdentity& identity = file->identity();
  for (const FileIdentity& read : read_) {
    if (file->is_device() || !(read == identity)) continue;
    throw two_of(option, path,
                 fmt::format("the same file as {}, which is read", read.name.string()));
  }
  for (const Written& other : written_) {
    if (file->is_device() || other.file->is_device() || !(other.file->identity() == identity)) {
      continue;
    }
    throw two_of(
        option, path,
        fmt::format("the same file as {} {}", other.option, other.file->target().string()));
  }
  written_.push_back({option, std::move(file)});
  return *written_.back().file;
}

void Files::finish() {
  for (const Written& written : written_) {
    if (written.file->is_filled()) written.file->finish();
  }
}

}  // namespace plumbline::output
