#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <ios>
#include <map>
#include <optional>
#include <system_error>
#include <thread>

#include "child_process.h"
#include "transport.h"

namespace plumbline::exchange {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr const char* kQueryFile = "query.json";
constexpr const char* kAnswerFile = "answer.json";

std::ofstream open_to_write(const fs::path& path) {
  std::ofstream file(path, std::ios::binary);
  if (!file) throw TransportError(path.string() + " cannot be written");
  return file;
}

void close_written(std::ofstream& file, const fs::path& path) {
  file.close();
  if (!file) throw TransportError(path.string() + " cannot be written; is the disk full?");
}

/// An array of an answer in a file of its own.
class ArrayFile : public ByteSource {
 public:
  explicit ArrayFile(const fs::path& path) : path_(path), file_(path, std::ios::binary) {
    if (!file_) throw TransportError("its answer has no file " + path.string());
  }

  void read(std::byte* to, std::size_t count) override {
    file_.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count));
    if (!file_) throw TransportError("its file " + path_.string() + " ends too early");
  }

  void require_end() {
    if (file_.peek() != std::ifstream::traits_type::eof()) {
      throw TransportError("its file " + path_.string() + " is longer than its header says");
    }
  }

 private:
  fs::path path_;
  std::ifstream file_;
};

/// A folder for each query, which a run of the command, or somebody else, puts the answer into.
class FolderTransport : public Transport {
 public:
  explicit FolderTransport(const AnswererOptions& options)
      : command_(options.command), seconds_(options.timeout), root_(fs::absolute(options.folder)) {
    fs::create_directories(root_);
    fs::remove(root_ / "done");
  }

  std::string hello() override {
    send({0, reports::query_line(0, "hello", 0), {}});
    const std::string line = answer_line();
    end_answer();
    return line;
  }

  void send(const OutgoingQuery& query) override {
    here_ = root_ / ("query-" + std::to_string(query.number));
    fs::remove_all(here_);  // of a run before that was cut short
    fs::create_directories(here_);
    for (const OutgoingArray& array : query.arrays) {
      const fs::path path = here_ / (array.name + ".npy");
      std::ofstream file = open_to_write(path);
      file << array.header;
      file.write(reinterpret_cast<const char*>(array.data.data()),
                 static_cast<std::streamsize>(array.data.size()));
      close_written(file, path);
    }
    // Last, and at once: who sees it finds the query whole.
    const fs::path draft = here_ / "query.part";
    std::ofstream file = open_to_write(draft);
    file << query.line << '\n';
    close_written(file, draft);
    fs::rename(draft, here_ / kQueryFile);
    deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(seconds_));
    process_.reset();
    if (command_.empty()) return;
    process_.emplace(command_, ChildProcess::Streams::none,
                     std::map<std::string, std::string>{{"PLUMBLINE_EXCHANGE", here_.string()}});
  }

  std::string answer_line() override {
    if (process_) {
      wait_for_command();
    } else {
      wait_for_file();
    }
    std::string line = *answer();
    line.pop_back();
    return line;
  }

  ByteSource& array(const std::string& name) override {
    if (array_) array_->require_end();
    return array_.emplace(here_ / (name + ".npy"));
  }

  void end_answer() override {
    if (array_) array_->require_end();
    array_.reset();
    fs::remove_all(here_);
  }

  /// Who watches the folder sees that this was all.
  std::string finish() override {
    const fs::path path = root_ / "done";
    std::ofstream file = open_to_write(path);
    close_written(file, path);
    return {};
  }

 private:
  /// The answer's line with its end, once it is there.
  std::optional<std::string> answer() const {
    std::ifstream file(here_ / kAnswerFile, std::ios::binary);
    std::string text(kLongestLine + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    if (text.size() > kLongestLine) {
      throw TransportError("its file " + std::string(kAnswerFile) + " is longer than a line");
    }
    if (text.empty() || text.back() != '\n') return std::nullopt;
    return text;
  }

  [[noreturn]] void too_late() const {
    throw TransportError("there is no answer in " + here_.string() + " within " +
                         seconds_text(seconds_) + "; allow it more with --timeout");
  }

  void wait_for_command() {
    if (!process_->ended(deadline_)) too_late();
    const std::string failure = process_->failure();
    if (!failure.empty()) throw TransportError("the program " + failure);
    if (!answer()) {
      throw TransportError("the program ended without a file " + (here_ / kAnswerFile).string() +
                           " of one whole line");
    }
  }

  void wait_for_file() {
    while (!answer()) {
      if (Clock::now() >= deadline_) too_late();
      std::this_thread::sleep_for(1ms);
    }
  }

  std::string command_;
  double seconds_;
  fs::path root_, here_;
  std::optional<ChildProcess> process_;
  Clock::time_point deadline_;
  std::optional<ArrayFile> array_;
};

}  // namespace

std::unique_ptr<Transport> make_folder_transport(const AnswererOptions& options) {
  return std::make_unique<FolderTransport>(options);
}

}  // namespace plumbline::exchange
