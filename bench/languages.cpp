#include "languages.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/reports/table.h>
#include <plumbline/verify/bsdf.h>

#include "statistics.h"

namespace plumbline::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kDegrees = 60, kAlbedo = 0.8, kPi = std::numbers::pi;

/// As the examples write it.
struct Lambertian {
  struct Record {
    verify::Vec3 wi;
    double weight, pdf;
  };

  double pdf(const verify::Vec3& wo, const verify::Vec3& wi) const {
    return wo[2] > 0 && wi[2] > 0 ? wi[2] / kPi : 0;
  }
  double eval(const verify::Vec3& wo, const verify::Vec3& wi) const {
    return wo[2] > 0 && wi[2] > 0 ? kAlbedo / kPi : 0;
  }
  std::optional<Record> sample(const verify::Vec3& wo, double u, double v) const {
    if (wo[2] <= 0) return std::nullopt;
    const double r = std::sqrt(u), phi = 2 * kPi * v;
    const verify::Vec3 wi{r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)};
    return Record{wi, kAlbedo, pdf(wo, wi)};
  }
};

/// The battery in Python, which prints its seconds, and those that NumPy takes in the functions.
constexpr const char* kPython = R"(
import time, numpy as np, plumbline
own = 0.0
def timed(f):
    def g(*a):
        global own
        start = time.perf_counter()
        result = f(*a)
        own += time.perf_counter() - start
        return result
    return g
@timed
def pdf(wo, wi):
    return np.where((wo[:, 2] > 0) & (wi[:, 2] > 0), wi[:, 2] / np.pi, 0)
@timed
def f(wo, wi):
    return np.where((wo[:, 2] > 0) & (wi[:, 2] > 0), 0.8 / np.pi, 0)
@timed
def sample(wo, u):
    r, phi = np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
    wi = np.stack([r * np.cos(phi), r * np.sin(phi), np.sqrt(1 - u[:, 0])], axis=1)
    density = np.where((wo[:, 2] > 0) & (wi[:, 2] > 0), wi[:, 2] / np.pi, 0)
    return wi, density, np.full(len(u), 0.8), density > 0
start = time.perf_counter()
report = plumbline.check_bsdf("lambertian", sample=sample, pdf=pdf, eval=f, angles=[60],
                              random_directions=0, back=False)
total = time.perf_counter() - start
assert report.ok, report
print(total, own)
)";

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Seconds {
  double battery = 0;
  double own = 0;  ///< of that in the functions under test, where it is known
};

std::optional<Seconds> in_cpp() {
  verify::BsdfOptions options;
  options.angles = {kDegrees};
  options.random_directions = 0;
  options.back = false;
  const auto start = std::chrono::steady_clock::now();
  const verify::Report report = verify::check_bsdf("lambertian", Lambertian(), options);
  if (!report.ok()) return std::nullopt;
  return Seconds{seconds_since(start), 0};
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 256> part{};
  while (pipe && fgets(part.data(), part.size(), pipe.get()) != nullptr) text += part.data();
  return text;
}

std::optional<Seconds> in_python() {
  const std::string script =
      fmt::format("PYTHONPATH='{}/verify/python' '{}' - 2>/dev/null <<'END'\n{}END\n",
                  PLUMBLINE_BUILD, PLUMBLINE_INTERPRETER, kPython);
  Seconds seconds;
  if (std::sscanf(output_of(script).c_str(), "%lf %lf", &seconds.battery, &seconds.own) != 2) {
    return std::nullopt;
  }
  return seconds;
}

/// Starting the program is part of it.
std::optional<Seconds> over_pipes(const std::string& program) {
  const auto start = std::chrono::steady_clock::now();
  const std::string command =
      fmt::format("'{}' verify --exec '{}' --angles {} --faces front >/dev/null 2>&1",
                  PLUMBLINE_COMMAND, program, kDegrees);
  if (std::system(command.c_str()) != 0) return std::nullopt;
  return Seconds{seconds_since(start), 0};
}

struct Way {
  std::string name;
  std::function<std::optional<Seconds>()> run;
  std::vector<double> seconds = {}, of_cpp = {}, own = {};
};

/// What this build has made and this machine can run.
std::vector<Way> ways() {
  std::vector<Way> all;
  all.push_back({"C++, in the same program", in_cpp});
  if (fs::exists(fs::path(PLUMBLINE_BUILD) / "verify/python/plumbline/__init__.py")) {
    all.push_back({"Python (NumPy), in the same program", in_python});
  }
  const fs::path examples = PLUMBLINE_EXAMPLES, built = PLUMBLINE_BUILD;
  const auto add = [&](const char* name, const fs::path& needs, const std::string& program) {
    if (!fs::exists(needs)) return;
    all.push_back({name, [program] { return over_pipes(program); }});
  };
  const fs::path c = built / "tests/exchange/exchange_c_example";
  const fs::path go = built / "tests/exchange/go_example";
  const fs::path shader = built / "tests/shaders/lambertian.spv";
  add("C, over pipes", c, c.string());
  add("Go, over pipes", go, go.string());
  add("Python (NumPy), over pipes", examples / "python/lambertian.py",
      PLUMBLINE_INTERPRETER " " + (examples / "python/lambertian.py").string());
  add("JavaScript (node), over pipes", examples / "javascript/lambertian.js",
      "node " + (examples / "javascript/lambertian.js").string());
  add("GLSL (Vulkan), over pipes", shader,
      (built / "tests/shaders/shader_host").string() + " " + shader.string());
  return all;
}

std::vector<std::string> row_of(const Way& way) {
  const Estimate seconds = median_with_interval(way.seconds);
  const Estimate ratio = median_with_interval(way.of_cpp);
  const double own = way.own.empty() ? 0 : median_with_interval(way.own).value;
  return {way.name, fmt::format("{:.2f}", seconds.value), own > 0 ? fmt::format("{:.2f}", own) : "",
          fmt::format("{:.2f} [{:.2f}, {:.2f}]", ratio.value, ratio.low, ratio.high)};
}

}  // namespace

void measure_languages(reports::ResultLog& log, bool full) {
  const int rounds = full ? 5 : 1;
  std::vector<Way> all = ways();
  for (int round = 0; round < rounds; ++round) {
    double cpp = 0;
    for (Way& way : all) {
      const auto seconds = way.run();
      if (!seconds) continue;
      if (cpp == 0) cpp = seconds->battery;
      way.seconds.push_back(seconds->battery);
      way.of_cpp.push_back(seconds->battery / cpp);
      way.own.push_back(seconds->own);
    }
  }
  reports::Table table;
  table.group = "Languages";
  table.title = "Seconds of a battery";
  table.caption = fmt::format(
      "check_bsdf on the same Lambertian BSDF from one direction at {}°, about 5.6 million values, "
      "all "
      "checks passing. Wall time, median and range of {} rounds in turns; over pipes it includes "
      "the "
      "start of both programs. Of Python's seconds, those that NumPy takes stand apart.",
      kDegrees, rounds);
  table.columns = {"written in", "battery [s]", "of that in the BSDF [s]", "over C++"};
  for (const Way& way : all) {
    if (way.seconds.empty()) continue;  // its interpreter is not there
    table.rows.push_back(row_of(way));
    fmt::print("{:<36} {:>8} s  {}\n", table.rows.back()[0], table.rows.back()[1],
               table.rows.back()[3]);
  }
  log.append(table);
}

}  // namespace plumbline::bench
