#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include <plumbline/output/failure.h>

namespace plumbline::tools {
namespace {

constexpr double kInterval = 0.1;  // [s] between updates: fast for the eye, free for the renderer
constexpr const char* kClearLine = "\r\x1b[K";

}  // namespace

Progress::Progress(double seconds, bool has_samples)
    : shown_(isatty(STDERR_FILENO) == 1), has_samples_(has_samples), limit_(seconds) {}

Progress::~Progress() {
  if (shown_) output::tell(kClearLine);
}

void Progress::update(double done) {
  const Clock::time_point now = Clock::now();
  if (!shown_ || std::chrono::duration<double>(now - last_).count() < kInterval) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  double share = has_samples_ ? done : 0;
  if (limit_ > 0) share = std::max(share, elapsed / limit_);
  if (share > 0) {
    share = std::min(share, 1.0);
    output::tell(fmt::format("{}{:5.1f} %  {:.0f} s left", kClearLine, 100 * share,
                             elapsed * (1 - share) / share));
  } else {
    output::tell(fmt::format("{}{:.0f} s so far", kClearLine, elapsed));
  }
}

}  // namespace plumbline::tools
