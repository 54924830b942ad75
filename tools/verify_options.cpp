#include "verify_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/nearest_name.h>
#include <plumbline/verify/conventions.h>

namespace plumbline::tools {
namespace {

using Given = reports::VerifyOptionsFile;

/// Numbers with commas between; nothing where there is anything else.
std::optional<std::vector<double>> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  for (;;) {
    double& number = numbers.emplace_back();
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec != std::errc() || !std::isfinite(number)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    if (text.empty()) return numbers;
    if (text.front() != ',') return std::nullopt;
    text.remove_prefix(1);
  }
}

std::string in_shell_quotes(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string(R"('\'')") : std::string(1, c);
  return quoted + "'";
}

void require(bool holds, const char* what) {
  if (!holds) throw renderer::InputError(what);
}

/// For programs that take long: about a tenth of the values. What passes is known less well.
void put_quick(verify::BsdfOptions& options) {
  options.random_directions = 0;
  verify::ContractOptions& contract = options.contract;
  contract.points /= 10;
  contract.jacobian_points /= 10;
  contract.evaluations /= 10;
  contract.finest_bins /= 16;
  contract.first_look /= 10;
  contract.samples /= 4;
  contract.deviation *= 3;
  contract.mass_tolerance = 5e-3;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw renderer::InputError(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class T>
void complete(std::optional<T>& given, std::optional<T>& from_file) {
  if (!given) given = std::move(from_file);
}

}  // namespace

std::vector<std::string> convention_words() {
  std::vector<std::string> words;
  for (const verify::conventions::Word& known : verify::conventions::words()) {
    words.emplace_back(known.word);
  }
  words.emplace_back("normal:X,Y,Z");
  return words;
}

verify::BsdfConventions parse_conventions(const std::vector<std::string>& words) {
  const std::vector<std::string> known = convention_words();
  for (const std::string& word : words) {
    const bool is_known = std::find(known.begin(), known.end(), word) != known.end();
    if (!is_known && !word.starts_with("normal:")) {
      throw renderer::InputError(fmt::format("--convention {}: there is no such convention; {}",
                                             word, renderer::name_hint(word, known)));
    }
  }
  try {
    return verify::conventions::from_words(words);
  } catch (const std::invalid_argument& error) {
    throw renderer::InputError(fmt::format("--convention {}", error.what()));
  }
}

std::vector<double> parse_angles(const std::string& text) {
  if (const auto numbers = numbers_of(text)) return *numbers;
  throw renderer::InputError("--angles " + text + ": must read like 0,60,80");
}

Given completed(Given given, Given by) {
  complete(given.exec, by.exec);
  complete(given.exchange, by.exchange);
  complete(given.name, by.name);
  complete(given.domain, by.domain);
  complete(given.timeout, by.timeout);
  complete(given.eta, by.eta);
  complete(given.angles, by.angles);
  complete(given.conventions, by.conventions);
  complete(given.faces, by.faces);
  complete(given.reciprocal, by.reciprocal);
  complete(given.conserves_energy, by.conserves_energy);
  complete(given.quick, by.quick);
  complete(given.samples, by.samples);
  complete(given.seed, by.seed);
  return given;
}

Given with_file(Given given, const std::string& path) {
  const std::string text = text_of(path);
  try {
    return completed(std::move(given), reports::parse_verify_options(text));
  } catch (const reports::FormatError& error) {
    throw renderer::InputError(path + ": " + error.what());
  }
}

std::vector<SuiteEntry> read_suite(const std::string& path, const Given& given,
                                   std::uint64_t seeds) {
  std::istringstream lines(text_of(path));
  std::vector<SuiteEntry> entries;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string place = fmt::format("{}:{}", path, number);
    SuiteEntry entry{place, {}};
    try {
      entry.given = completed(given, reports::parse_verify_options(line));
    } catch (const reports::FormatError& error) {
      throw renderer::InputError(place + ": " + error.what());
    }
    const std::uint64_t first = entry.given.seed.value_or(verify::ContractOptions().seed);
    for (std::uint64_t i = 0; i < seeds; ++i) {
      if (seeds > 1) {
        entry.given.seed = first + i;
        entry.place = fmt::format("{}, seed {}", place, first + i);
      }
      entries.push_back(entry);
    }
  }
  if (entries.empty()) throw renderer::InputError(path + ": has no line");
  return entries;
}

std::vector<verify::Waiver> read_waivers(const std::string& path) {
  if (path.empty()) return {};
  try {
    return reports::parse_waivers(text_of(path));
  } catch (const reports::FormatError& error) {
    throw renderer::InputError(path + ": " + error.what());
  }
}

verify::BsdfOptions bsdf_options(const Given& given) {
  verify::BsdfOptions options;
  if (given.conventions) options.conventions = parse_conventions(*given.conventions);
  if (given.angles) options.angles = *given.angles;
  for (const double degrees : options.angles) {
    require(degrees >= 0 && degrees < 90, "angles are degrees from the normal, from 0 to below 90");
  }
  const std::string faces = given.faces.value_or("both");
  require(faces == "both" || faces == "front" || faces == "back",
          "faces are \"both\", \"front\" or \"back\"");
  options.front = faces != "back";
  options.back = faces != "front";
  options.eta = given.eta.value_or(options.eta);
  require(std::isfinite(options.eta) && options.eta > 0, "eta must be a positive number");
  options.reciprocal = given.reciprocal.value_or(options.reciprocal);
  options.conserves_energy = given.conserves_energy.value_or(options.conserves_energy);
  verify::ContractOptions& contract = options.contract;
  if (given.quick.value_or(false)) put_quick(options);
  contract.samples = given.samples.value_or(contract.samples);
  require(contract.samples >= 1000, "at least 1000 samples are needed");
  contract.first_look = std::min(contract.first_look, contract.samples);
  contract.seed = given.seed.value_or(contract.seed);
  return options;
}

std::string replay_command(const Given& given, std::uint64_t seed) {
  std::string command = "plumbline verify";
  const auto add = [&](const char* name, const std::optional<std::string>& text) {
    if (text) command += fmt::format(" --{} {}", name, in_shell_quotes(*text));
  };
  add("exec", given.exec);
  add("exchange", given.exchange);
  add("name", given.name);
  add("domain", given.domain);
  if (given.timeout) command += fmt::format(" --timeout {}", *given.timeout);
  if (given.eta) command += fmt::format(" --eta {}", *given.eta);
  if (given.angles) command += fmt::format(" --angles {}", fmt::join(*given.angles, ","));
  for (const std::string& word : given.conventions.value_or(std::vector<std::string>{})) {
    command += " --convention " + word;
  }
  if (given.faces) command += " --faces " + *given.faces;
  if (!given.reciprocal.value_or(true)) command += " --not-reciprocal";
  if (!given.conserves_energy.value_or(true)) command += " --gains-energy";
  if (given.quick.value_or(false)) command += " --quick";
  if (given.samples) command += fmt::format(" --samples {}", *given.samples);
  return command + fmt::format(" --seed {}", seed);
}

}  // namespace plumbline::tools
