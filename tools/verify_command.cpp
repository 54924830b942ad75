#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/exchange/answerer.h>
#include <plumbline/exchange/self_test.h>
#include <plumbline/mpi/ranks.h>
#include <plumbline/output/failure.h>
#include <plumbline/output/output_file.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/reports/results.h>
#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/conventions.h>
#include <plumbline/verify/waiver.h>

#include "command.h"
#include "domain_argument.h"
#include "rank_options.h"
#include "verify_check.h"
#include "verify_options.h"
#include "verify_suite.h"

namespace plumbline::tools {
namespace {

struct VerifyArguments {
  reports::VerifyOptionsFile given;
  std::string options_file, waivers, json, results;
  bool self_test = false, quick = false, not_reciprocal = false, gains_energy = false;
  std::vector<std::string> conventions;
  std::optional<double> timeout, eta;
  std::string suite;
  std::uint64_t seeds = 1;
  RankArguments ranks;
};

/// What the command line and the file say together.
reports::VerifyOptionsFile all_given(const VerifyArguments& arguments) {
  reports::VerifyOptionsFile given = arguments.given;
  given.timeout = arguments.timeout;
  given.eta = arguments.eta;
  if (!arguments.conventions.empty()) given.conventions = arguments.conventions;
  if (arguments.not_reciprocal) given.reciprocal = false;
  if (arguments.quick) given.quick = true;
  if (arguments.gains_energy) given.conserves_energy = false;
  if (!arguments.options_file.empty()) given = with_file(given, arguments.options_file);
  return given;
}

constexpr const char* kLogName = "verify";

std::filesystem::path log_of(const std::filesystem::path& results) {
  return results / (std::string(kLogName) + ".jsonl");
}

/// Where results are written, but for what is printed.
class Outputs {
 public:
  explicit Outputs(const VerifyArguments& arguments) : arguments_(arguments) {
    for (const std::string& read : {arguments.options_file, arguments.waivers, arguments.suite}) {
      files_.reads(read);
    }
    if (!arguments.results.empty()) files_.reads(log_of(arguments.results));
    if (!arguments.json.empty()) json_ = &files_.writes("--json", arguments.json);
  }

  void keep(const std::vector<verify::CheckResult>& results) {
    if (!arguments_.results.empty()) {
      reports::ResultLog log(arguments_.results, kLogName);
      for (const verify::CheckResult& result : results) log.append(result);
    }
    if (!json_) return;
    json_->fill([&](const auto& path) { reports::write_checks(path, results); });
    files_.finish();
  }

 private:
  const VerifyArguments& arguments_;
  output::Files files_;
  output::OutputFile* json_ = nullptr;
};

int run_checks(const VerifyArguments& arguments, const reports::VerifyOptionsFile& given) {
  Outputs outputs(arguments);
  const std::vector<verify::Waiver> waivers = read_waivers(arguments.waivers);
  const CheckedProgram checked = check_program(given);
  fmt::print("{}", checked.left_out);
  if (!checked.end.empty()) output::tell(fmt::format("plumbline: {}\n", checked.end));
  verify::Report report = verify::waive(checked.report, waivers);
  note_replay(report);
  outputs.keep(report.results);
  fmt::print("{}\n{} values in {} queries, {:.1f} s\n", report.summary(), checked.values,
             checked.queries, checked.seconds);
  return report.ok() ? kExitFine : kExitUnexpectedVerdict;
}

int run_suite_alone(const VerifyArguments& arguments, const reports::VerifyOptionsFile& given) {
  Outputs outputs(arguments);
  return run_suite(nullptr, read_suite(arguments.suite, given, arguments.seeds),
                   [&](const auto& results) { outputs.keep(results); });
}

int run_suite_in_rank(const VerifyArguments& arguments, const reports::VerifyOptionsFile& given,
                      mpi::Ranks& ranks) {
  std::optional<Outputs> outputs;
  std::vector<SuiteEntry> entries;
  agree(ranks, [&] {
    if (ranks.is_first()) outputs.emplace(arguments);
    entries = read_suite(arguments.suite, given, arguments.seeds);
  });
  require_one_suite(ranks, entries);
  return run_suite(&ranks, entries, [&](const auto& results) { outputs->keep(results); });
}

int run_suite_of(const VerifyArguments& arguments, const reports::VerifyOptionsFile& given) {
  if (!arguments.ranks.asked_for) return run_suite_alone(arguments, given);
  return mpi::run_in_ranks(arguments.ranks.timeout, [&](mpi::Ranks& ranks) {
    return run_suite_in_rank(arguments, given, ranks);
  });
}

int run_self_test(const reports::VerifyOptionsFile& given) {
  const auto tell = [](const exchange::SelfTestStep& step) {
    fmt::print("{:<4} {}{}{}\n", step.ok ? "ok" : "FAIL", step.what,
               step.detail.empty() ? "" : ": ", step.detail);
    std::fflush(stdout);
  };
  const auto domain = [&](const reports::AnswererHello& hello) {
    return domain_of(given.domain, hello);
  };
  return exchange::self_test(answerer_options(given), domain, tell) ? kExitFine
                                                                    : kExitUnexpectedVerdict;
}

int run_verify(const VerifyArguments& arguments) {
  const reports::VerifyOptionsFile given = all_given(arguments);
  if (given.domain) parse_domain(*given.domain);
  if (!arguments.suite.empty()) return run_suite_of(arguments, given);
  try {
    return arguments.self_test ? run_self_test(given) : run_checks(arguments, given);
  } catch (const exchange::AnswererError& error) {
    throw renderer::InputError(error.what());
  }
}

/// A line for each word.
std::string convention_lines() {
  std::string lines;
  for (const verify::conventions::Word& known : verify::conventions::words()) {
    lines += fmt::format("  {:23} {}\n", known.word, known.meaning);
  }
  return lines;
}

/// With room for the lines of the conventions.
constexpr const char* kVerifyFooter =
    R"(The program answers queries by the protocol of docs/protocol.md: examples/answerers/ has one in C, Python,
JavaScript and Go. Its standard error is shown. Exit codes: 0 all checks pass, 1 one does not, 2 the program does
not do as the protocol says.

Domains: bsdf, sphere, hemisphere, disk, disk:RADIUS, square, triangle, interval, interval:LOW:HIGH, half-line:SCALE,
line:CENTER:SCALE, discrete:SIZE, equirectangular:COLUMNSxROWS, octahedral:PIXELS.
Conventions, a renderer's name, which says all of its own, before single ones:
{}  normal:X,Y,Z            directions are in world space, around that normal

The file of --options is a JSON object: {{"exec": "./mine", "angles": [0, 60], "conventions": ["y-up"]}}; its names
are exec, exchange, name, domain, timeout, eta, angles, conventions, faces, reciprocal, conserves_energy, quick,
samples, seed.

A waiver, {{"check": "coat/*/energy", "reason": "multiple scattering is missing", "until": "2027-01-31"}}, lets the
checks that it names fail until that day; one that has expired or is not needed fails itself.

Examples:
  plumbline verify --exec ./mine --self-test
  plumbline verify --exec ./mine --convention mitsuba --angles 0,60,80 --faces front
  plumbline verify --exec 'python3 light.py' --domain sphere --json light.jsonl
  mpirun -n 8 plumbline verify --suite pairs.jsonl --seeds 10 --mpi --json results.jsonl
  plumbline verify --exec ./batch_job --exchange /tmp/queries --timeout 600)";

/// Options whose values go where a file's go too.
void add_given_options(options::Command& command, reports::VerifyOptionsFile& given) {
  const auto text = [&](const char* name, std::optional<std::string>& into, const char* type,
                        const char* meaning) {
    command
        .add_text(
            name, [&into](const std::string& value) { into = value; }, meaning)
        .type(type);
  };
  const auto number = [&](const char* name, std::optional<std::uint64_t>& into,
                          std::int64_t smallest, const char* meaning) {
    command
        .add_text(
            name, [&into](const std::string& value) { into = std::stoull(value); }, meaning)
        .whole_number(smallest, std::numeric_limits<std::int64_t>::max())
        .type("N");
  };
  text("--exec", given.exec, "COMMAND", "The program, as a shell command");
  text("--exchange", given.exchange, "DIR",
       "Queries and answers are files in this folder; --exec is run once for each");
  text("--name", given.name, "NAME", "In the names of results; the program's own without it");
  text("--domain", given.domain, "DOMAIN", "Where the samples live; bsdf without it");
  text("--faces", given.faces, "FACES", "Faces that a BSDF is looked at from: both, front, back");
  command
      .add_text(
          "--angles", [&given](const std::string& value) { given.angles = parse_angles(value); },
          "Angles from the normal that it is looked at from [degrees]; 0,60,80,88,89.9 without it")
      .type("LIST");
  number("--samples", given.samples, 1000,
         "Of chi-square, at the last look; 1000000 without it, 250000 with --quick");
  number("--seed", given.seed, 0, "Seed of the checks; 1 without it");
}

}  // namespace

void add_verify_command(options::CommandLine& line) {
  const auto arguments = std::make_shared<VerifyArguments>();
  options::Command command =
      line.add_command("verify", "Check sampling code in another program, in any language");
  add_given_options(command, arguments->given);
  command.add("--eta", arguments->eta, "Refractive index below the surface over that above; 1")
      .positive_number()
      .type("ETA");
  command
      .add("--convention", arguments->conventions,
           "How the program writes things down where it differs; repeatable, see below")
      .one_value_each()
      .type("WORD");
  command.add_flag("--not-reciprocal", arguments->not_reciprocal,
                   "f(wo, wi) and f(wi, wo) may differ");
  command.add_flag("--gains-energy", arguments->gains_energy, "The albedo may be above 1");
  command.add_flag("--quick", arguments->quick,
                   "A tenth of the values, for slow programs: a pass proves less");
  command
      .add("--timeout", arguments->timeout,
           "Of the first line and of each answer [s]; 60 without it")
      .positive_number()
      .type("S");
  command.add("--options", arguments->options_file, "JSON file of options; the command line's win")
      .type("FILE");
  command
      .add("--suite", arguments->suite,
           "Check many programs: a file with an object of --options on each line")
      .excludes("--options")
      .type("FILE");
  command
      .add("--seeds", arguments->seeds, "Of --suite: check each with so many seeds; 1 without it")
      .whole_number(1, 1'000'000)
      .needs("--suite")
      .type("N");
  add_rank_options(command, arguments->ranks,
                   "Deal the programs and seeds of --suite out to the ranks of an mpirun "
                   "(docs/scaling.md)")
      .needs("--suite");
  command
      .add("--waivers", arguments->waivers,
           "JSON file of known failures: [{\"check\": …, \"reason\": …, \"until\": …}]")
      .excludes("--suite")
      .type("FILE");
  command
      .add_flag("--self-test", arguments->self_test,
                "Does the program keep to the protocol? Whatever its values are")
      .excludes("--suite");
  command.add("--json", arguments->json, "File to write the results to, a line of JSON each")
      .type("FILE");
  command.add("--results", arguments->results, "Directory to add the results to, for report")
      .type("DIR");
  command.footer(fmt::format(kVerifyFooter, convention_lines()));
  command.runs([arguments] { return run_verify(*arguments); });
}

}  // namespace plumbline::tools
