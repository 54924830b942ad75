#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/reports/errors.h>
#include <plumbline/verify/waiver.h>

/// The lines of JSON that `plumbline verify` and a program that answers it exchange
/// (docs/protocol.md), and the files of its options and of known failures.
namespace plumbline::reports {

/// The version that is spoken: "plumbline/1".
inline constexpr std::string_view kExchangeProtocol = "plumbline/1";

/// What a program says of itself first.
struct AnswererHello {
  std::string name;        ///< in the names of results
  bool float64 = false;    ///< it calculates in double, and gets doubles; else float
  int numbers = 2;         ///< uniform numbers that a sample takes, 1 to 3
  bool has_eval = true;    ///< `sample` and `pdf` it must have
  bool has_atoms = false;  ///< samples come with the probability of the atom that they are
  std::string domain;      ///< as --domain has it; empty: not stated

  bool operator==(const AnswererHello&) const = default;
};

/// @throws FormatError for what is no such line, says another version, lacks a field or has one
///         that is not known
AnswererHello parse_answerer_hello(std::string_view line);

/// {"query": 7, "kind": "sample", "count": 1000}, exactly so.
std::string query_line(std::uint64_t query, std::string_view kind, std::size_t count);

/// What an answer begins with. The line of the query itself will do.
struct AnswerLine {
  std::uint64_t query = 0;
  std::string error;  ///< why the program cannot answer; empty if it does

  bool operator==(const AnswerLine&) const = default;
};

/// @throws FormatError
AnswerLine parse_answer_line(std::string_view line);

/// Options of `plumbline verify` as a file states them, by the names of the command line with _ for
/// -; what it does not state is empty.
struct VerifyOptionsFile {
  std::optional<std::string> exec, exchange, name, domain;
  std::optional<double> timeout, eta;
  std::optional<std::vector<double>> angles;  ///< degrees
  std::optional<std::vector<std::string>> conventions;
  std::optional<std::string> faces;  ///< "both", "front", "back"
  std::optional<bool> reciprocal, conserves_energy, quick;
  std::optional<std::uint64_t> samples, seed;

  bool operator==(const VerifyOptionsFile&) const = default;
};

/// @throws FormatError for what is no JSON object, and for a name or a value that is not understood
VerifyOptionsFile parse_verify_options(std::string_view text);

/// [{"check": "coat/*/energy", "reason": "…", "until": "2027-01-31"}]: what `verify::waive` takes.
///
/// @throws FormatError for what is no such list, with the number of the entry
std::vector<verify::Waiver> parse_waivers(std::string_view text);

}  // namespace plumbline::reports
