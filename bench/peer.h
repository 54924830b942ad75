#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::bench {

/// A picture that a peer is asked for.
struct PeerJob {
  std::filesystem::path scene;  ///< Mitsuba's XML; the .pbrt twin lies beside it
  int width = 0, height = 0;    ///< of the picture that comes, else it is refused
  std::uint32_t samples_per_pixel = 1;
  std::uint64_t seed = 0;
  int threads = 1;
};

struct PeerPicture {
  std::vector<double> luminance;  ///< row by row from the top
  double cpu_seconds = 0;         ///< user and system, of the process and those it waited for
  double wall_seconds = 0;
};

/// Another renderer, as a command that is run for each picture.
class Peer {
 public:
  /// @param command  words as a shell reads them, by blanks, quotes and backslashes and nothing
  ///                 else, in which {scene} stands for the .pbrt twin, {xml} for Mitsuba's file,
  ///                 {out} for the OpenEXR file to be written, {spp}, {seed}, {threads}
  /// @throws std::invalid_argument with what is missing, unknown or not closed
  explicit Peer(std::string command);

  const std::string& command() const { return command_; }

  /// @param limit  after which it is killed, with all that it has started
  /// @throws std::runtime_error with the command and the last that it said, where it fails, lasts
  ///         too long, or leaves no picture of that size
  PeerPicture render(const PeerJob& job,
                     std::chrono::duration<double> limit = std::chrono::minutes(10)) const;

 private:
  std::string command_;
  std::vector<std::string> words_;
};

}  // namespace plumbline::bench
