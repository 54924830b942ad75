#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/exchange/answerer.h>
#include <plumbline/exchange/npy.h>

namespace plumbline::exchange {

/// What went wrong between the program and us, as a sentence about "the program" or "its" answer.
class TransportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The longest line of JSON that is read.
inline constexpr std::size_t kLongestLine = 4096;

struct OutgoingArray {
  std::string name;
  std::string header;
  std::span<const std::byte> data;
};

struct OutgoingQuery {
  std::uint64_t number = 0;
  std::string line;  ///< without its end
  std::vector<OutgoingArray> arrays;
};

/// Carries queries to the program and its answers back. All but the destructor throw
/// TransportError, also where the program takes longer than it has, and std::system_error.
class Transport {
 public:
  virtual ~Transport() = default;

  /// What the program says of itself.
  virtual std::string hello() = 0;

  /// The query must live until `end_answer`.
  virtual void send(const OutgoingQuery& query) = 0;

  virtual std::string answer_line() = 0;

  /// Stands at the beginning of an array of the answer. To be asked for in the protocol's order.
  virtual ByteSource& array(const std::string& name) = 0;

  /// The answer has been read.
  virtual void end_answer() = 0;

  /// @return what was wrong with the program's end; empty if nothing was
  virtual std::string finish() = 0;
};

std::unique_ptr<Transport> make_pipe_transport(const AnswererOptions& options);
std::unique_ptr<Transport> make_folder_transport(const AnswererOptions& options);

/// "0.25 s"
std::string seconds_text(double seconds);

}  // namespace plumbline::exchange
