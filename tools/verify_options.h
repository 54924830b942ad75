#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/reports/exchange_messages.h>
#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/waiver.h>

/// What `plumbline verify` was asked for, on the command line and in a file.
namespace plumbline::tools {

/// The words of --convention.
std::vector<std::string> convention_words();

/// @throws renderer::InputError for a word that is not known
verify::BsdfConventions parse_conventions(const std::vector<std::string>& words);

/// "0,60,80", degrees.
/// @throws renderer::InputError for what is no list of numbers
std::vector<double> parse_angles(const std::string& text);

/// What the one states, completed by the other.
reports::VerifyOptionsFile completed(reports::VerifyOptionsFile given,
                                     reports::VerifyOptionsFile by);

/// What the command line states, completed by the file.
/// @throws renderer::InputError for a file that cannot be read or understood
reports::VerifyOptionsFile with_file(reports::VerifyOptionsFile given, const std::string& path);

/// A program of a suite, with what it is to be checked with.
struct SuiteEntry {
  std::string place;  ///< "FILE:LINE", and the seed where there are several
  reports::VerifyOptionsFile given;
};

/// A file of options, an object on each line; each with so many seeds, from its own on. What the
/// command line states wins.
/// @throws renderer::InputError for a file that cannot be read or understood, or has no line
std::vector<SuiteEntry> read_suite(const std::string& path, const reports::VerifyOptionsFile& given,
                                   std::uint64_t seeds);

/// The known failures of a file; none where no file is named.
/// @throws renderer::InputError for a file that cannot be read or understood
std::vector<verify::Waiver> read_waivers(const std::string& path);

/// @throws renderer::InputError for values that nothing can be checked with
verify::BsdfOptions bsdf_options(const reports::VerifyOptionsFile& given);

/// The command line that asks for the same, with the seed.
std::string replay_command(const reports::VerifyOptionsFile& given, std::uint64_t seed);

}  // namespace plumbline::tools
