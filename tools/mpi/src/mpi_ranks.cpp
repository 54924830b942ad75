#include <mpi.h>
#include <plumbline/mpi/ranks.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include <plumbline/output/failure.h>
#include <plumbline/renderer/core/errors.h>

#include "nap.h"
#include "ring.h"

namespace plumbline::mpi {
namespace {

constexpr int kTag = 1;

std::string host() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown host";
}

/// A message as MPI sends it: its length, and its bytes in words of eight, of which MPI counts
/// 2^31.
std::vector<std::uint64_t> words_of(const std::string& bytes) {
  std::vector<std::uint64_t> words(1 + (bytes.size() + 7) / 8);
  if (words.size() > std::numeric_limits<int>::max()) {
    throw renderer::MachineError("a part of more than 16 GB is too large to be sent");
  }
  words[0] = bytes.size();
  std::memcpy(words.data() + 1, bytes.data(), bytes.size());
  return words;
}

std::string bytes_of(const std::vector<std::uint64_t>& words) {
  return {reinterpret_cast<const char*>(words.data() + 1), words[0]};
}

/// Calls to MPI never wait, and are made by one thread at a time: the ring's must go on whatever
/// happens.
class MpiRanks final : public Ranks {
 public:
  explicit MpiRanks(double timeout) {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    if (provided < MPI_THREAD_SERIALIZED) {
      throw renderer::MachineError(
          "this MPI knows no threads: it provides no MPI_THREAD_SERIALIZED");
    }
    MPI_Comm_dup(MPI_COMM_WORLD, &world_);
    MPI_Comm_rank(world_, &rank_);
    MPI_Comm_size(world_, &count_);
    name_ = "rank " + std::to_string(rank_) + " (process " + std::to_string(getpid()) + " on " +
            host() + ")";
    if (count_ == 1) return;
    ring_ = std::make_unique<Ring>(calls_, rank_, count_, name_, timeout);
  }

  /// Until all are done: a rank that ended with another exit code than 0 would end the others.
  ~MpiRanks() override {
    wait(outgoing_);
    wait_for_all();
    ring_.reset();
    MPI_Comm_free(&world_);
    MPI_Finalize();
  }

  int rank() const override { return rank_; }
  int count() const override { return count_; }
  std::string name() const override { return name_; }

  bool post(int to, const std::string& bytes) override {
    if (!is_done(outgoing_)) return false;
    sent_ = words_of(bytes);
    const std::lock_guard lock(calls_);
    MPI_Isend(sent_.data(), static_cast<int>(sent_.size()), MPI_UINT64_T, to, kTag, world_,
              &outgoing_);
    return true;
  }

  std::optional<Message> take(int from) override {
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status{};
    std::vector<std::uint64_t> words;
    MPI_Request request = MPI_REQUEST_NULL;
    {
      const std::lock_guard lock(calls_);
      int is_there = 0, size = 0;
      MPI_Improbe(from == kAnyRank ? MPI_ANY_SOURCE : from, kTag, world_, &is_there, &message,
                  &status);
      if (is_there == 0) return std::nullopt;
      MPI_Get_count(&status, MPI_UINT64_T, &size);
      words.resize(static_cast<std::size_t>(size));
      MPI_Imrecv(words.data(), size, MPI_UINT64_T, &message, &request);
    }
    wait(request);
    return Message{status.MPI_SOURCE, bytes_of(words)};
  }

  std::uint64_t first_says(std::uint64_t value) override {
    MPI_Request request = MPI_REQUEST_NULL;
    {
      const std::lock_guard lock(calls_);
      MPI_Ibcast(&value, 1, MPI_UINT64_T, 0, world_, &request);
    }
    wait(request);
    return value;
  }

  void abort(int exit_code, const std::string& why) override {
    end_job(calls_, exit_code, name_ + ": " + why);
  }

 private:
  bool is_done(MPI_Request& request) {
    const std::lock_guard lock(calls_);
    int done = 0;
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    return done != 0;
  }

  void wait(MPI_Request& request) {
    for (Nap nap; !is_done(request); nap.sleep()) {
    }
  }

  void wait_for_all() {
    MPI_Request request = MPI_REQUEST_NULL;
    {
      const std::lock_guard lock(calls_);
      MPI_Ibarrier(world_, &request);
    }
    wait(request);
  }

  std::mutex calls_;
  MPI_Comm world_ = MPI_COMM_NULL;
  MPI_Request outgoing_ = MPI_REQUEST_NULL;
  std::vector<std::uint64_t> sent_;  // until it has gone
  int rank_ = 0, count_ = 1;
  std::string name_;
  std::unique_ptr<Ring> ring_;
};

}  // namespace

std::unique_ptr<Ranks> start_ranks(double timeout) { return std::make_unique<MpiRanks>(timeout); }

}  // namespace plumbline::mpi
