#include "output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <plumbline/renderer/core/errors.h>

namespace plumbline::tools {

namespace fs = std::filesystem;

OutputFile::OutputFile(const fs::path& path) : path_(path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) {
    throw renderer::InputError(path.string() + ": is a directory");
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    device_ = path;
    path_ = fs::temp_directory_path() /
            fmt::format("plumbline-{}{}", getpid(), path.filename().string());
    return;
  }
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) {
    throw renderer::InputError(
        fmt::format("{}: there is no directory {}", path.string(), folder.string()));
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw renderer::InputError(
        fmt::format("{}: cannot write to its directory: {}", path.string(), std::strerror(errno)));
  }
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!device_.empty()) fs::remove(path_, ignored);
}

void OutputFile::finish() const {
  if (device_.empty()) return;
  std::ifstream in(path_, std::ios::binary);
  std::ofstream out(device_, std::ios::binary);
  out << in.rdbuf();
  out.close();
  if (!out) throw renderer::MachineError(device_.string() + ": cannot be written; is it full?");
}

}  // namespace plumbline::tools
