#include <plumbline/mpi/ranks.h>

#include <exception>
#include <utility>

#include <plumbline/output/failure.h>

#include "nap.h"

namespace plumbline::mpi {
namespace {

/// As one message: "3", a line end, and the words; empty where all is well.
std::string packed(const output::Failure& failure) {
  return std::to_string(failure.exit_code) + "\n" + failure.what;
}

AgreedFailure unpacked(const std::string& message) {
  const std::size_t end = message.find('\n');
  return {std::stoi(message.substr(0, end)), message.substr(end + 1)};
}

}  // namespace

void Ranks::send(int to, const std::string& bytes) {
  for (Nap nap; !post(to, bytes); nap.sleep()) {
  }
}

Message Ranks::receive(int from) {
  for (Nap nap;; nap.sleep()) {
    if (std::optional<Message> message = take(from)) return std::move(*message);
  }
}

std::vector<std::string> gather(Ranks& ranks, const std::string& bytes) {
  if (!ranks.is_first()) {
    ranks.send(0, bytes);
    return {};
  }
  std::vector<std::string> all = {bytes};
  for (int rank = 1; rank < ranks.count(); ++rank) all.push_back(ranks.receive(rank).bytes);
  return all;
}

void agree(Ranks& ranks, const std::function<void()>& work) {
  std::string failure;
  try {
    work();
  } catch (...) {
    output::Failure thrown = output::failure_of(std::current_exception());
    if (!ranks.is_first()) thrown.what = ranks.name() + ": " + thrown.what;
    failure = packed(thrown);
  }
  AgreedFailure first{0, {}};
  for (const std::string& message : gather(ranks, failure)) {
    if (message.empty()) continue;
    first = unpacked(message);
    break;
  }
  first.exit_code = static_cast<int>(ranks.first_says(static_cast<std::uint64_t>(first.exit_code)));
  if (first.exit_code != output::kExitFine) throw AgreedFailure(std::move(first));
}

int run_in_ranks(double timeout, const std::function<int(Ranks& ranks)>& work) {
  const std::unique_ptr<Ranks> ranks = start_ranks(timeout);
  try {
    return work(*ranks);
  } catch (const AgreedFailure& failure) {
    if (ranks->is_first()) output::tell("plumbline: " + failure.what + "\n");
    return failure.exit_code;
  } catch (...) {
    const output::Failure failure = output::failure_of(std::current_exception());
    ranks->abort(failure.exit_code, failure.what);
    return failure.exit_code;  // which no rank comes to
  }
}

}  // namespace plumbline::mpi
