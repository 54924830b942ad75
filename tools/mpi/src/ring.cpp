#include "ring.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include <plumbline/output/failure.h>
#include <plumbline/output/stop.h>

namespace plumbline::mpi {
namespace {

/// A beat: 0, or the signal by which this rank was asked to stop, or that it beats no more.
constexpr int kLeaves = -1;
constexpr int kRingTag = 2;

constexpr std::chrono::duration<double> kLook(
    0.02);  // of a second in which signals are to be heard

}  // namespace

void end_job(std::mutex& calls, int exit_code, const std::string& why) {
  output::tell("plumbline: " + why + "; the job ends\n");
  const std::lock_guard lock(calls);
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

Ring::Ring(std::mutex& calls, int rank, int count, const std::string& name, double timeout)
    : calls_(calls),
      before_((rank + count - 1) % count),
      after_((rank + 1) % count),
      timeout_(timeout) {
  MPI_Comm_dup(MPI_COMM_WORLD, &comm_);
  name_before_ = exchanged(name);
  beaten_ = heard_ = Clock::now();
  thread_ = std::thread([this] { run(); });
}

Ring::~Ring() {
  leaves_ = true;
  thread_.join();
  MPI_Comm_free(&comm_);
}

/// @return  the name of the rank before
std::string Ring::exchanged(const std::string& name) const {
  std::array<char, 400> mine{}, theirs{};
  name.copy(mine.data(), mine.size() - 1);
  MPI_Sendrecv(mine.data(), static_cast<int>(mine.size()), MPI_CHAR, after_, kRingTag,
               theirs.data(), static_cast<int>(theirs.size()), MPI_CHAR, before_, kRingTag, comm_,
               MPI_STATUS_IGNORE);
  return theirs.data();
}

void Ring::run() {
  Clock::time_point looked = Clock::now();
  for (;;) {
    std::this_thread::sleep_for(std::min(kLook, timeout_ / 16));
    const Clock::time_point now = Clock::now();
    // Who stood still itself, as a job does that was suspended, knows nothing of others.
    if (now - looked > timeout_ / 2) heard_ += now - looked;
    looked = now;
    beat(now);
    listen(now);
    if (!is_watching_ && sent_ == kLeaves && request_ == MPI_REQUEST_NULL) return;
    if (is_watching_ && now - heard_ > timeout_) end_for_silence();
  }
}

void Ring::beat(Clock::time_point now) {
  const std::lock_guard lock(calls_);
  int is_sent = 0;
  MPI_Test(&request_, &is_sent, MPI_STATUS_IGNORE);
  if (is_sent == 0 || sent_ == kLeaves) return;
  const int news = leaves_ ? kLeaves : output::stop_signal();
  if (news == sent_ && now - beaten_ < timeout_ / 8) return;
  sent_ = news;
  beaten_ = now;
  MPI_Isend(&sent_, 1, MPI_INT, after_, kRingTag, comm_, &request_);
}

void Ring::listen(Clock::time_point now) {
  for (;;) {
    int beat = 0, is_there = 0;
    {
      const std::lock_guard lock(calls_);
      MPI_Iprobe(before_, kRingTag, comm_, &is_there, MPI_STATUS_IGNORE);
      if (is_there == 0) return;
      MPI_Recv(&beat, 1, MPI_INT, before_, kRingTag, comm_, MPI_STATUS_IGNORE);
    }
    heard_ = now;
    if (beat == kLeaves) is_watching_ = false;
    if (beat > 0) output::ask_to_stop(beat);
  }
}

/// Until the job has ended, the rank after this one would miss its beats.
void Ring::end_for_silence() {
  leaves_ = true;
  beat(Clock::now());
  end_job(calls_, output::kExitMachineFailed,
          name_before_ + ": has said nothing for " + fmt::format("{}", timeout_.count()) + " s");
}

}  // namespace plumbline::mpi
