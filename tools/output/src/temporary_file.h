#pragma once

#include <filesystem>

namespace plumbline::output {

/// An empty file beside the one that it is to become, with a short name. Removed by the destructor,
/// by a signal that ends the process, and where the process was killed (SIGKILL, power) by the next
/// one that makes a file for the same target: it holds a lock while its process lives.
class TemporaryFile {
 public:
  /// @param folder  where to make it
  /// @param target  what it is for: "out.exr"
  /// @throws renderer::InputError, renderer::MachineError where it cannot be made
  TemporaryFile(const std::filesystem::path& folder, const std::filesystem::path& target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Puts it in the place of the target, whatever is there.
  ///
  /// @param synced  what it holds must outlive a power failure too
  /// @throws renderer::InputError, renderer::MachineError
  void move_to(const std::filesystem::path& target, bool synced);

 private:
  bool make(const std::filesystem::path& path);

  std::filesystem::path path_;
  int file_ = -1;
  int slot_ = -1;  // of remove_on_signal
};

}  // namespace plumbline::output
