#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/reports/errors.h>

namespace plumbline::tests {

/// A directory in memory that goes with the process: readers take files, not bytes.
class FuzzFolder {
 public:
  FuzzFolder()
      : path_(std::filesystem::path("/dev/shm") /
              ("plumbline_fuzz_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~FuzzFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FuzzFolder(const FuzzFolder&) = delete;
  FuzzFolder& operator=(const FuzzFolder&) = delete;

  std::filesystem::path write(std::string_view name, std::string_view bytes) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline const FuzzFolder& folder() {
  static const FuzzFolder one;
  return one;
}

/// Calls a reader that may refuse its input.
template <class Read>
void may_refuse(const Read& read) {
  try {
    read();
  } catch (const renderer::InputError&) {
  } catch (const reports::FormatError&) {
  } catch (const reports::ResultsError&) {
  }
}

}  // namespace plumbline::tests
