#pragma once

#include <cstddef>
#include <mutex>
#include <string>

#include <plumbline/verify/detail/stopwatch.h>
#include <plumbline/verify/pair.h>

namespace plumbline::verify {

/// What has been decided so far, and what runs.
struct Standing {
  std::string name;
  std::size_t decided = 0, unexpected = 0;
  std::string first_unexpected;  ///< subject of the first result that is not as expected
  std::string looks_at;
};

/// One line for a person who waits, cut to the width.
///
/// @param width  characters
std::string line_of(const Standing& standing, std::size_t width);

/// Tells of a battery while it runs: each result to the options' `decided` and, where standard
/// error is a terminal and the battery has taken half a second, one line there that is wiped in the
/// end. May be used from several threads.
class Progress {
 public:
  /// @param options  kept by the caller
  Progress(std::string name, const ContractOptions& options);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void looks_at(std::string what);
  void decided(const CheckResult& result);

 private:
  void show();

  const ContractOptions& options_;
  const bool terminal_;
  const Stopwatch watch_;
  std::mutex mutex_;
  Standing standing_;
  bool shown_ = false;
};

}  // namespace plumbline::verify
