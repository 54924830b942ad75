#pragma once

#include <mpi.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

namespace plumbline::mpi {

/// Says why, and ends the whole job.
[[noreturn]] void end_job(std::mutex& calls, int exit_code, const std::string& why);

/// Each rank hears from the one before it, in a ring, that it lives: what this costs does not
/// depend on the number of ranks, and the first rank is watched as any other. A thread of its own
/// does it, however long the rank computes. Signals that ask to stop go round too, so that a job
/// stops where one of its ranks alone was told.
class Ring {
 public:
  /// @param calls    held by whoever calls MPI
  /// @param name     of this rank
  /// @param timeout  [s] the silence of the rank before that ends the job
  Ring(std::mutex& calls, int rank, int count, const std::string& name, double timeout);

  /// Says farewell, and waits for that of the rank before.
  ~Ring();
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

 private:
  using Clock = std::chrono::steady_clock;

  std::string exchanged(const std::string& name) const;
  void run();
  void beat(Clock::time_point now);
  void listen(Clock::time_point now);
  [[noreturn]] void end_for_silence();

  std::mutex& calls_;
  MPI_Comm comm_ = MPI_COMM_NULL;
  int before_, after_;
  std::string name_before_;
  std::chrono::duration<double> timeout_;
  Clock::time_point beaten_, heard_;
  int sent_ = 0;  // the last beat
  MPI_Request request_ = MPI_REQUEST_NULL;
  bool is_watching_ = true;
  std::atomic<bool> leaves_ = false;
  std::thread thread_;
};

}  // namespace plumbline::mpi
