#include <plumbline/reports/environment.h>

#include <stdlib.h>
#include <sys/utsname.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>

#include "build_stamp.h"

namespace plumbline::reports {
namespace {

#if defined(__clang__)
constexpr const char* kCompiler = "clang " __clang_version__;
#elif defined(__GNUC__)
constexpr const char* kCompiler = "g++ " __VERSION__;
#else
constexpr const char* kCompiler = "unknown";
#endif

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  std::string line;
  while (std::getline(info, line)) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
      return line.substr(colon + 2);
  }
  return "unknown";
}

std::string system_name() {
  utsname system{};
  if (::uname(&system) != 0) return "unknown";
  return std::string(system.sysname) + " " + system.release + " " + system.machine;
}

double load_of_last_minute() {
  double load = 0;
  return ::getloadavg(&load, 1) == 1 ? load : 0;
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32];
  return std::string(text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc));
}

}  // namespace

bool RunEnvironment::same_build(const RunEnvironment& other) const {
  return version == other.version && commit == other.commit && dirty == other.dirty &&
         compiler == other.compiler && flags == other.flags && cpu == other.cpu &&
         cores == other.cores && system == other.system;
}

RunEnvironment current_environment() {
  RunEnvironment environment;
  environment.version = PLUMBLINE_VERSION;
  environment.commit = PLUMBLINE_COMMIT;
  environment.dirty = PLUMBLINE_DIRTY;
  environment.compiler = kCompiler;
  environment.flags = PLUMBLINE_FLAGS;
  environment.cpu = cpu_model();
  environment.cores = static_cast<int>(std::thread::hardware_concurrency());
  environment.system = system_name();
  environment.load_average = load_of_last_minute();
  environment.time = utc_now();
  return environment;
}

}  // namespace plumbline::reports
