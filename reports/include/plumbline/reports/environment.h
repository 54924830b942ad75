#pragma once

#include <map>
#include <string>
#include <string_view>

namespace plumbline::reports {

/// Where and from what a set of results was made. JSON format "plumbline.environment/1".
struct RunEnvironment {
  std::string version;  ///< of Plumbline, "0.1.0"
  std::string commit;   ///< full hash, or "unknown" outside a git tree
  bool dirty = false;   ///< the tree differed from the commit when it was built
  std::string compiler;
  std::string flags;  ///< build type and compiler options
  std::string cpu;    ///< model name
  int cores = 0;      ///< hardware threads
  std::string system;
  double load_average = 0;                       ///< of the last minute, when asked
  std::string time;                              ///< UTC, "2024-03-01T12:00:00Z"
  std::map<std::string, std::string> libraries;  ///< versions that matter, filled in by the caller

  /// Same build on the same machine: everything but load, time and libraries.
  bool same_build(const RunEnvironment& other) const;

  bool operator==(const RunEnvironment&) const = default;
};

/// This build, on this machine, now. Without /proc or git the fields concerned are "unknown".
RunEnvironment current_environment();

std::string to_json(const RunEnvironment& environment);

/// @throws FormatError
RunEnvironment parse_environment(std::string_view json);

}  // namespace plumbline::reports
