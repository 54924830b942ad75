#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/reports/exchange_messages.h>
#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/pair.h>

namespace plumbline::exchange {

class ReceivedArray;
class Transport;
struct ArrayWanted;
struct OutgoingQuery;

/// The other program did not do as the protocol says: it died, hung, or answered what is no answer.
/// `what()` names the query, says what was wrong, and what to do.
class AnswererError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Values in one query at most. Longer spans become several queries.
inline constexpr std::size_t kMostValues = 1'000'000;

/// Where the other program is.
struct AnswererOptions {
  /// Given to /bin/sh -c. May be empty where there is a folder: somebody else answers there.
  std::string command;

  /// Of queries and answers as files, for programs that cannot talk while they run: the command is
  /// run once for each query. Empty: pipes. Made if it is missing.
  std::filesystem::path folder;

  double timeout = 60;  ///< of the first line and of each query [s], > 0
};

/// A program that answers queries. Not for several threads at once.
class Answerer {
 public:
  /// Starts the program and reads what it says of itself.
  /// @throws AnswererError; std::system_error where no process or pipe is to be had
  explicit Answerer(const AnswererOptions& options);

  /// Ends the program with all that it has started, by force if need be.
  ~Answerer();
  Answerer(const Answerer&) = delete;
  Answerer& operator=(const Answerer&) = delete;

  const reports::AnswererHello& hello() const { return hello_; }

  /// Numbers per point of the domain: 3 for directions.
  /// @throws std::invalid_argument unless from 1 to 3
  void set_dimensions(std::size_t coordinates);

  // Each asks for as many values as `out` has room for.
  //
  // @param wo  given directions; empty where the domain is not that of a BSDF
  // @throws AnswererError; from then on the program is ended and each call throws the same

  void sample(std::span<const verify::Vec3> wo, std::span<const verify::Uniforms> u,
              std::span<std::optional<verify::SampleRecord>> out);
  void pdf(std::span<const verify::Vec3> wo, std::span<const verify::Vec3> x,
           std::span<double> out);
  void eval(std::span<const verify::Vec3> wo, std::span<const verify::Vec3> x,
            std::span<verify::Channels> out);

  /// Tells the program that this was all and waits, as long as for a query, until it has ended.
  /// @return what was wrong with its end, as a sentence; empty if nothing was
  std::string finish();

  std::uint64_t queries() const { return queries_; }
  std::uint64_t values() const { return values_; }  ///< that were asked for, in all queries

 private:
  struct Query;

  /// Asks for consecutive parts, each of one query.
  template <class Ask>
  void in_batches(std::span<const verify::Vec3> wo, std::span<const verify::Vec3> points,
                  const Ask& ask);

  /// One query; `exchange` reads the arrays of its answer.
  template <class Exchange>
  void attempt(const Query& query, const Exchange& exchange);

  void send(const Query& query);
  void read_answer_line();
  ReceivedArray read(const ArrayWanted& wanted, std::vector<std::byte>& bytes);
  void read_samples(const char* points, std::span<std::optional<verify::SampleRecord>> out);

  reports::AnswererHello hello_;
  std::size_t coordinates_ = 3;
  std::uint64_t queries_ = 0, values_ = 0;
  std::string broken_;           // what was wrong, once something was
  std::vector<std::byte> sent_;  // kept, as the next, to be used again
  std::array<std::vector<std::byte>, 5> received_;
  std::unique_ptr<OutgoingQuery> outgoing_;
  std::unique_ptr<Transport> transport_;
};

using SharedAnswerer = std::shared_ptr<Answerer>;

/// The program as a BSDF, in spans. Without `eval` where it has none.
verify::ErasedBsdf as_bsdf(const SharedAnswerer& answerer,
                           const verify::BsdfConventions& conventions = {});

/// The program as a sampling pair over a domain.
verify::SamplingPair as_pair(const SharedAnswerer& answerer, const std::string& name,
                             const verify::Domain& domain);

/// How many coordinates a point of the domain has in the protocol's arrays.
std::size_t coordinates_of(const verify::Domain& domain);

}  // namespace plumbline::exchange
