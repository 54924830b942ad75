#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <system_error>

#include <plumbline/output/failure.h>
#include <plumbline/output/output_file.h>
#include <plumbline/renderer/core/errors.h>

namespace plumbline::output {
namespace {

namespace fs = std::filesystem;

/// The path that links lead to, which need not be there yet.
fs::path followed(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as the kernel has it
  fs::path at = path;
  std::error_code error;
  for (int i = 0; fs::is_symlink(fs::symlink_status(at, error)); ++i) {
    if (i == kMostLinks) throw_errno(path.string(), "cannot be followed", ELOOP);
    const fs::path to = fs::read_symlink(at, error);
    if (error) throw_errno(path.string(), "cannot be followed", error.value());
    at = to.is_absolute() ? to : at.parent_path() / to;
  }
  return at;
}

/// The folder of a file by the one name that it has.
fs::path canonical_folder(const fs::path& path, const fs::path& given) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  const fs::path canonical = fs::canonical(folder, error);
  if (error == std::errc::no_such_file_or_directory || (!error && !fs::is_directory(canonical))) {
    throw renderer::InputError(
        fmt::format("{}: there is no directory {}", given.string(), folder.string()));
  }
  if (error) throw_errno(given.string(), "cannot be reached", error.value());
  return canonical;
}

}  // namespace

FileIdentity identity_of(const fs::path& path) {
  FileIdentity identity;
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) {
    identity.exists = true;
    identity.is_regular = S_ISREG(status.st_mode);
    identity.device = status.st_dev;
    identity.inode = status.st_ino;
    // /dev/stdout leads to a pipe that has no name.
    if (!identity.is_regular) {
      identity.name = fs::absolute(path);
      return identity;
    }
  } else if (errno == ENOENT || errno == ENOTDIR) {
    identity.is_regular = true;
  } else {
    throw_errno(path.string(), "cannot be reached", errno);
  }
  const fs::path target = followed(path);
  if (target.filename().empty()) {
    throw renderer::InputError(fmt::format("\"{}\" names no file", path.string()));
  }
  identity.name = canonical_folder(target, path) / target.filename();
  return identity;
}

}  // namespace plumbline::output
