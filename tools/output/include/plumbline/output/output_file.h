#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace plumbline::output {

class TemporaryFile;

/// Which file a path leads to, links followed: by its name, and by its inode where it is there.
struct FileIdentity {
  std::filesystem::path name;  ///< canonical but for what is not there yet
  unsigned long long device = 0, inode = 0;
  bool exists = false;
  bool is_regular = false;  ///< or not there; else a device, a pipe, a directory

  bool operator==(const FileIdentity& other) const {
    return name == other.name ||
           (exists && other.exists && device == other.device && inode == other.inode);
  }
};

/// @throws renderer::InputError for a loop of links, a missing folder, a name that is too long
FileIdentity identity_of(const std::filesystem::path& path);

/// Where a command writes a file that must appear whole or not at all: made as a temporary file
/// before the work starts, so that a path that cannot be written to costs no render, and put in its
/// place when it is written. A link stays, and what it leads to is replaced.
///
/// A device or pipe (/dev/null) cannot be replaced: the file is made elsewhere and copied into it.
/// So is /dev/stdout; what the command says goes to the standard error from then on.
class OutputFile {
 public:
  /// @param synced  what it holds must outlive a power failure too
  /// @throws renderer::InputError, renderer::MachineError where the path cannot be written to
  explicit OutputFile(const std::filesystem::path& path, bool synced = false);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Calls the function with the path that it is to write to: a file that is there, and empty.
  ///
  /// @throws renderer::InputError, renderer::MachineError for what it throws, with the name that
  /// the
  ///         user knows in the message
  void fill(const std::function<void(const std::filesystem::path& path)>& write);

  bool is_filled() const { return is_filled_; }

  /// As the user called it.
  const std::filesystem::path& target() const { return given_; }

  const FileIdentity& identity() const { return identity_; }

  bool is_device() const { return !identity_.is_regular || stream_ >= 0; }

  /// To be called once, when the file is written.
  /// @throws renderer::InputError, renderer::MachineError where it cannot come to its place
  void finish();

 private:
  void copy_to_device() const;

  std::filesystem::path given_;
  FileIdentity identity_;
  bool synced_;
  bool is_filled_ = false;
  int stream_ = -1;  // the standard output, where that is meant
  std::unique_ptr<TemporaryFile> temporary_;
};

/// All files that one command reads and writes: none may be two of them.
class Files {
 public:
  /// A file that the command reads; one that is not there is no matter.
  /// @throws renderer::InputError where it is written too
  void reads(const std::filesystem::path& path);

  /// The same for a file that may be read and then written by the same name: a checkpoint.
  /// @throws renderer::InputError where it is written already
  void reads_first(const std::filesystem::path& path) const;

  /// @param option  what the user calls it: "--json"
  /// @throws renderer::InputError where it is read or written already, or cannot be written to;
  ///         renderer::MachineError
  OutputFile& writes(const std::string& option, const std::filesystem::path& path);

  /// Puts those that are filled in their places; the others leave what was there.
  void finish();

 private:
  struct Written {
    std::string option;
    std::unique_ptr<OutputFile> file;
  };

  std::vector<FileIdentity> read_;
  std::vector<Written> written_;
};

}  // namespace plumbline::output
