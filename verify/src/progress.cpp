#include "progress.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace plumbline::verify {

namespace {

// Before, a person does not wait yet.
constexpr double kQuiet = 0.5;
constexpr std::size_t kWidth = 79;
constexpr const char* kWipeLine = "\r\x1b[K";

/// The first characters, none of them cut in two: UTF-8 continues with 10xxxxxx.
std::string first_characters(const std::string& text, std::size_t count) {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U;
    if (begins && seen++ == count) return text.substr(0, i);
  }
  return text;
}

}  // namespace

std::string line_of(const Standing& standing, std::size_t width) {
  std::string line = standing.name + ": " + std::to_string(standing.decided) + " decided";
  if (standing.unexpected > 0) {
    line += ", " + std::to_string(standing.unexpected) + " not as expected (" +
            standing.first_unexpected + ")";
  }
  if (!standing.looks_at.empty()) line += "; " + standing.looks_at;
  return first_characters(line, width);
}

Progress::Progress(std::string name, const ContractOptions& options)
    : options_(options), terminal_(isatty(STDERR_FILENO) == 1) {
  standing_.name = std::move(name);
}

Progress::~Progress() {
  if (!shown_) return;
  std::fputs(kWipeLine, stderr);
  std::fflush(stderr);
}

void Progress::looks_at(std::string what) {
  const std::lock_guard lock(mutex_);
  standing_.looks_at = std::move(what);
  show();
}

void Progress::decided(const CheckResult& result) {
  const std::lock_guard lock(mutex_);
  ++standing_.decided;
  if (!result.as_expected() && standing_.unexpected++ == 0) {
    standing_.first_unexpected = result.subject;
  }
  show();
  if (options_.decided) options_.decided(result);
}

void Progress::show() {
  if (!terminal_ || watch_.seconds() < kQuiet) return;
  shown_ = true;
  std::fputs((kWipeLine + line_of(standing_, kWidth)).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace plumbline::verify
