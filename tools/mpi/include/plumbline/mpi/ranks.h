#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Many processes, on one machine or on many, that work on one job: the ranks of an `mpirun`.
namespace plumbline::mpi {

inline constexpr int kAnyRank = -1;

struct Message {
  int from = 0;
  std::string bytes;
};

/// This process among those of the job. All functions are called by one thread; those that wait
/// sleep meanwhile. Messages of one rank to another arrive in the order in which they were sent.
class Ranks {
 public:
  Ranks() = default;
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  virtual int rank() const = 0;  ///< from 0
  virtual int count() const = 0;
  bool is_first() const { return rank() == 0; }

  /// For messages: "rank 3 (process 4711 on node7)".
  virtual std::string name() const = 0;

  /// Sends without waiting.
  /// @return false, and nothing is sent, while the message before is on its way
  virtual bool post(int to, const std::string& bytes) = 0;

  /// Sends, and waits until it is on its way or taken.
  void send(int to, const std::string& bytes);

  /// A message that has come, if one has. Waits for no message, but for all of one that is there.
  virtual std::optional<Message> take(int from) = 0;

  /// Waits for a message.
  Message receive(int from);

  /// The value of the first rank, in all: to be called by all.
  virtual std::uint64_t first_says(std::uint64_t value) = 0;

  /// Ends the whole job at once, and says why, with the name of this rank.
  virtual void abort(int exit_code, const std::string& why) = 0;
};

/// Ends all ranks with the same exit code, when all have come so far. The first one has the words.
struct AgreedFailure {
  int exit_code;
  std::string what;
};

/// The bytes of all ranks, in their order, in the first one; elsewhere nothing.
std::vector<std::string> gather(Ranks& ranks, const std::string& bytes);

/// Does work in all ranks, and goes on if all could: what is wrong with what the user asks for is
/// said once, though every rank meets it.
///
/// @throws AgreedFailure in all ranks, with what was thrown in the first rank where something was
void agree(Ranks& ranks, const std::function<void()>& work);

/// The ranks that this process was started with: one, where it was started by itself.
///
/// @param timeout  [s] a rank that has said nothing for so long ends the job, with its name; > 0
/// @throws renderer::InputError in a build without MPI
std::unique_ptr<Ranks> start_ranks(double timeout);

/// Starts the ranks, does the work in each, and waits until all have. An exception in one ends the
/// job with the exit code of output::failure_of and the name of the rank.
///
/// @return what the work returns: an exit code
/// @throws renderer::InputError in a build without MPI
int run_in_ranks(double timeout, const std::function<int(Ranks& ranks)>& work);

}  // namespace plumbline::mpi
