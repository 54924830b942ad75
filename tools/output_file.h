#pragma once

#include <filesystem>

namespace plumbline::tools {

/// Where a command writes a file that must appear whole or not at all. Asked for before the work
/// starts, so that a path that cannot be written to costs no render.
///
/// A device or pipe (/dev/null, /dev/stdout) cannot be replaced: the file is made elsewhere and
/// copied into it.
class OutputFile {
 public:
  /// @throws renderer::InputError where the path cannot be written to
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Where to write.
  const std::filesystem::path& path() const { return path_; }

  bool is_device() const { return !device_.empty(); }

  /// To be called when the file is written.
  /// @throws renderer::MachineError where a device does not take it
  void finish() const;

 private:
  std::filesystem::path path_;
  std::filesystem::path device_;  // empty for an ordinary file
};

}  // namespace plumbline::tools
