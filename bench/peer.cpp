#include "peer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/image_io/exr.h>

namespace plumbline::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Words as a shell splits them: blanks part, quotes and backslashes keep together.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  bool in_word = false;
  char quote = 0;
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (quote == 0 && std::isspace(static_cast<unsigned char>(c)) != 0) {
      in_word = false;
      continue;
    }
    if (!std::exchange(in_word, true)) words.emplace_back();
    if (c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '"' || c == '\'')) {
      quote = c;
    } else if (c == '\\' && quote != '\'' && i + 1 < command.size()) {
      words.back() += command[++i];
    } else {
      words.back() += c;
    }
  }
  if (quote != 0) {
    throw std::invalid_argument(fmt::format("--peer: a quote {} is not closed", quote));
  }
  return words;
}

using Values = std::map<std::string, std::string>;

/// The word with its {names} replaced.
/// @throws std::invalid_argument for a name that is none
std::string filled_in(const std::string& word, const Values& values) {
  std::string filled;
  std::string_view rest = word;
  for (std::size_t open = rest.find('{'); open != std::string_view::npos; open = rest.find('{')) {
    const std::size_t close = rest.find('}', open);
    const std::string name(rest.substr(open + 1, close - open - 1));
    const auto value = values.find(name);
    if (close == std::string_view::npos || value == values.end()) {
      std::vector<std::string> known;
      for (const auto& [known_name, of_it] : values) known.push_back("{" + known_name + "}");
      throw std::invalid_argument(fmt::format("--peer: \"{}\" holds {{ of none of the names {}",
                                              word, fmt::join(known, ", ")));
    }
    filled.append(rest.substr(0, open)).append(value->second);
    rest.remove_prefix(close + 1);
  }
  return filled.append(rest);
}

Values values_of(const PeerJob& job, const fs::path& picture) {
  fs::path twin = job.scene;
  twin.replace_extension(".pbrt");
  return {{"scene", twin.string()},           {"xml", job.scene.string()},
          {"out", picture.string()},          {"spp", std::to_string(job.samples_per_pixel)},
          {"seed", std::to_string(job.seed)}, {"threads", std::to_string(job.threads)}};
}

/// A directory that is gone with it.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (fs::temp_directory_path() / "plumbline-peer-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), name);
    }
    path_ = name;
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// In a process group of its own, what it says in a file.
pid_t started(std::vector<std::string> words, const fs::path& log) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, arguments[0], &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw std::system_error(error, std::generic_category(), words[0]);
  return child;
}

struct Ending {
  int status = 0;  // as wait4 gives it
  rusage usage{};
};

/// Nothing where it lasts longer: all of it is killed then.
std::optional<Ending> ending_of(pid_t child, Clock::time_point deadline) {
  Ending ending;
  for (;;) {
    const pid_t ended = wait4(child, &ending.status, WNOHANG, &ending.usage);
    if (ended == child) return ending;
    if (ended < 0) throw std::system_error(errno, std::generic_category(), "wait4");
    if (Clock::now() > deadline) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  kill(-child, SIGKILL);
  wait4(child, &ending.status, 0, nullptr);
  return std::nullopt;
}

double in_seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::string last_lines(const fs::path& log) {
  std::ifstream file(log, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  while (!text.empty() && text.back() == '\n') text.pop_back();
  constexpr std::size_t kMost = 600;
  if (text.size() > kMost) text = "…" + text.substr(text.size() - kMost);
  return text.empty() ? "it said nothing" : "it said:\n" + text;
}

std::vector<double> luminance_of(const fs::path& picture, const PeerJob& job) {
  const renderer::Image image = renderer::read_exr(picture);
  if (image.width != job.width || image.height != job.height) {
    throw std::runtime_error(fmt::format("its picture has {}x{} pixels, the scene {}x{}",
                                         image.width, image.height, job.width, job.height));
  }
  std::vector<double> all;
  for (const renderer::Rgbf& pixel : image.pixels) {
    all.push_back(static_cast<double>(luminance(pixel)));
  }
  return all;
}

}  // namespace

Peer::Peer(std::string command) : command_(std::move(command)), words_(words_of(command_)) {
  if (words_.empty()) throw std::invalid_argument("--peer: there is no command");
  const Values names = values_of({}, {});
  for (const std::string& word : words_) filled_in(word, names);
  const auto has = [&](std::string_view name) {
    return command_.find("{" + std::string(name) + "}") != std::string::npos;
  };
  for (const char* needed : {"out", "spp", "seed"}) {
    if (!has(needed)) throw std::invalid_argument(fmt::format("--peer: {{{}}} is missing", needed));
  }
  if (!has("scene") && !has("xml")) {
    throw std::invalid_argument("--peer: {scene}, a .pbrt file, or {xml}, Mitsuba's, is missing");
  }
}

PeerPicture Peer::render(const PeerJob& job, std::chrono::duration<double> limit) const {
  const TemporaryDirectory directory;
  const fs::path picture = directory.path() / "out.exr", log = directory.path() / "log";
  std::vector<std::string> words;
  for (const std::string& word : words_) words.push_back(filled_in(word, values_of(job, picture)));
  const auto refuse = [&](const std::string& what) {
    throw std::runtime_error(
        fmt::format("{}: {}; {}", fmt::join(words, " "), what, last_lines(log)));
  };
  const Clock::time_point start = Clock::now();
  const auto deadline = start + std::chrono::duration_cast<Clock::duration>(limit);
  const std::optional<Ending> ending = ending_of(started(words, log), deadline);
  PeerPicture result;
  result.wall_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (!ending) refuse(fmt::format("is killed after {} s", limit.count()));
  if (WIFSIGNALED(ending->status)) {
    refuse(fmt::format("was ended by signal {}", WTERMSIG(ending->status)));
  }
  if (WEXITSTATUS(ending->status) != 0) {
    refuse(fmt::format("ended with exit status {}", WEXITSTATUS(ending->status)));
  }
  result.cpu_seconds = in_seconds(ending->usage.ru_utime) + in_seconds(ending->usage.ru_stime);
  try {
    result.luminance = luminance_of(picture, job);
  } catch (const std::exception& error) {
    refuse(error.what());
  }
  return result;
}

}  // namespace plumbline::bench
