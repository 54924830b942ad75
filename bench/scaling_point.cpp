#include "scaling_point.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include "clock.h"
#include "made_scenes.h"
#include "scaling.h"
#include "scenes.h"
#include "statistics.h"

namespace plumbline::bench {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A scene with the work that a point asks of it.
struct ScalingWork {
  renderer::SceneDescription scene;
  renderer::RenderOptions options;
  int renders = 3;
};

void set_size(renderer::SceneDescription& scene, int width) {
  scene.camera.width = width;
  scene.camera.height = width;
}

ScalingWork work_at(const std::string& axis, std::uint64_t value) {
  const int number = static_cast<int>(value);
  ScalingWork work;
  work.options.samples_per_pixel = 4;
  work.options.sampler = renderer::SamplerType::sobol;
  work.options.threads = 1;
  if (axis == "triangles") {
    work.scene = displaced_sphere(value);
  } else if (axis == "lights") {
    work.scene = many_lights(value);
  } else {
    work.scene = load_at_size("cornell", 128, 128);
  }
  if (axis == "triangles" || axis == "lights") {
    set_size(work.scene, 128);
  } else if (axis == "samples") {
    work.options.samples_per_pixel = static_cast<std::uint32_t>(value);
  } else if (axis == "pixels") {
    set_size(work.scene, number);
  } else if (axis == "image") {
    set_size(work.scene, number);
    work.options.samples_per_pixel = 1;
    work.options.threads = 0;
    work.renders = 1;
  } else if (axis == "depth") {
    work.scene.integrator = {number, renderer::kNoRoulette};
  } else {
    throw std::invalid_argument("no axis '" + axis + "'");
  }
  work.options.path.max_depth = work.scene.integrator.max_depth;
  work.options.path.rr_depth = work.scene.integrator.rr_depth;
  return work;
}

/// Peak resident set of this program, not of the one that it was started from.
double peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0;
    if (word == "VmHWM:" && status >> kilobytes) return 1024 * kilobytes;
  }
  throw std::runtime_error("/proc/self/status does not tell the peak memory");
}

/// All that a child writes.
std::string read_all(int file) {
  std::string text;
  char buffer[256];
  for (ssize_t n = 0; (n = read(file, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(n));
  }
  return text;
}

}  // namespace

void measure_scaling_point(const std::string& point) {
  const std::size_t equals = point.find('=');
  if (equals == std::string::npos) throw std::invalid_argument("a point is axis=value");
  ScalingWork work = work_at(point.substr(0, equals), std::stoull(point.substr(equals + 1)));
  const Clock::time_point start = Clock::now();
  const renderer::Scene scene = renderer::make_scene(work.scene);
  const double build = since(start);
  work.scene = {};
  std::vector<double> seconds;
  for (int i = 0; i < work.renders; ++i) {
    seconds.push_back(seconds_of([&] { render(scene, work.options); }));
  }
  fmt::print("{} {} {}\n", build, median_with_interval(std::move(seconds)).value, peak_bytes());
}

PointCost run_scaling_point(const std::string& axis, std::uint64_t value) {
  const std::string point = fmt::format("{}={}", axis, value);
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe for a measuring process");
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    execl("/proc/self/exe", "plumbline_bench", "--scaling-point", point.c_str(), nullptr);
    _exit(127);
  }
  close(ends[1]);
  std::istringstream answer(child > 0 ? read_all(ends[0]) : "");
  close(ends[0]);
  int status = 0;
  if (child > 0) waitpid(child, &status, 0);
  PointCost cost;
  if (child < 0 || status != 0 ||
      !(answer >> cost.build_seconds >> cost.render_seconds >> cost.peak_bytes)) {
    throw std::runtime_error("the measuring process of " + point + " failed");
  }
  return cost;
}

double first_picture_seconds() {
  const std::filesystem::path image =
      std::filesystem::temp_directory_path() / fmt::format("plumbline_first_{}.exr", getpid());
  const std::string scene = std::string(PLUMBLINE_BENCH_SCENES) + "/cornell.xml";
  const Clock::time_point start = Clock::now();
  const pid_t child = fork();
  if (child == 0) {
    if (std::freopen("/dev/null", "w", stdout) == nullptr) _exit(127);
    execl(PLUMBLINE_COMMAND, PLUMBLINE_COMMAND, "render", scene.c_str(), "--size", "64x64", "--spp",
          "1", "-o", image.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  if (child > 0) waitpid(child, &status, 0);
  const double seconds = since(start);
  if (child < 0 || status != 0 || !std::filesystem::remove(image)) {
    throw std::runtime_error(std::string(PLUMBLINE_COMMAND) + " render failed");
  }
  return seconds;
}

}  // namespace plumbline::bench
