#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <plumbline/exchange/answerer.h>
#include <plumbline/reports/exchange_messages.h>
#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/pair.h>

/// One program checked once.
namespace plumbline::tools {

/// @throws renderer::InputError for values that no program can be asked with
exchange::AnswererOptions answerer_options(const reports::VerifyOptionsFile& given);

/// The domain asked for, else the one that the program states; nothing: a BSDF.
/// @throws renderer::InputError where they are two
std::optional<verify::Domain> domain_of(const std::optional<std::string>& asked,
                                        const reports::AnswererHello& hello);

struct CheckedProgram {
  verify::Report report;  ///< with the command that repeats it
  std::string left_out;   ///< a line of what is not checked; may be empty
  std::string end;        ///< what was wrong with it at its end; may be empty
  std::uint64_t values = 0, queries = 0;
  double seconds = 0;
};

/// Starts the program, checks it and ends it.
///
/// @throws renderer::InputError for options that do not go together, exchange::AnswererError for a
///         program that does not do as the protocol says
CheckedProgram check_program(const reports::VerifyOptionsFile& given);

/// Notes in each result the command that repeats it.
void note_replay(verify::Report& report);

}  // namespace plumbline::tools
