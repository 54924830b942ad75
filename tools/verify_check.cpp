#include "verify_check.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/verify/detail/stopwatch.h>

#include "domain_argument.h"
#include "verify_options.h"

namespace plumbline::tools {
namespace {

/// A BSDF without `eval`: what its `sample` and `pdf` say of each other, from each direction.
verify::Report check_without_eval(const std::string& name, const verify::ErasedBsdf& bsdf,
                                  const verify::BsdfOptions& options) {
  verify::Random random(options.contract.seed);
  verify::Report all;
  for (const bool front : {true, false}) {
    if (!(front ? options.front : options.back)) continue;
    for (const double degrees : options.angles) {
      const double theta = degrees * std::numbers::pi / 180;
      const double phi = 2 * std::numbers::pi * random.uniform();
      const verify::Vec3 wo{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                            front ? std::cos(theta) : -std::cos(theta)};
      verify::SamplingPair pair = verify::bsdf_pair(
          fmt::format("{}/{} {:.4g}°", name, front ? "front" : "back", degrees), bsdf, wo, options);
      pair.value = nullptr;
      all.append(verify::check_pair(pair, options.contract));
    }
  }
  return all;
}

verify::Report check(const exchange::SharedAnswerer& answerer,
                     const reports::VerifyOptionsFile& given) {
  const verify::BsdfOptions options = bsdf_options(given);
  const std::string name = given.name.value_or(answerer->hello().name);
  if (const auto domain = domain_of(given.domain, answerer->hello())) {
    if (given.conventions || given.angles || given.faces || given.eta) {
      throw renderer::InputError(
          "conventions, angles, faces and eta belong to a BSDF, not to other domains");
    }
    return verify::check_pair(exchange::as_pair(answerer, name, *domain), options.contract);
  }
  const verify::ErasedBsdf bsdf = exchange::as_bsdf(answerer, options.conventions);
  return bsdf.eval ? verify::check_bsdf(name, bsdf, options)
                   : check_without_eval(name, bsdf, options);
}

}  // namespace

exchange::AnswererOptions answerer_options(const reports::VerifyOptionsFile& given) {
  exchange::AnswererOptions options;
  options.command = given.exec.value_or("");
  options.folder = given.exchange.value_or("");
  options.timeout = given.timeout.value_or(options.timeout);
  constexpr double kLongest = 1e6;
  if (!(options.timeout > 0) || options.timeout > kLongest) {
    throw renderer::InputError("a timeout is a positive number of seconds, a million at most");
  }
  if (options.command.empty() && options.folder.empty()) {
    throw renderer::InputError("verify needs --exec COMMAND or --exchange DIR");
  }
  return options;
}

/// The domain asked for, else the one that the program states; nothing: a BSDF.
std::optional<verify::Domain> domain_of(const std::optional<std::string>& asked,
                                        const reports::AnswererHello& hello) {
  if (asked && !hello.domain.empty() && *asked != hello.domain) {
    throw renderer::InputError(
        fmt::format("--domain {}, but the program answers for {}", *asked, hello.domain));
  }
  return parse_domain(asked.value_or(hello.domain.empty() ? "bsdf" : hello.domain));
}

CheckedProgram check_program(const reports::VerifyOptionsFile& given) {
  const verify::BsdfOptions options = bsdf_options(given);  // wrong ones start no program
  const auto answerer = std::make_shared<exchange::Answerer>(answerer_options(given));
  const verify::Stopwatch watch;
  CheckedProgram checked;
  checked.report = check(answerer, given);
  checked.seconds = watch.seconds();
  if (!answerer->hello().has_eval && !domain_of(given.domain, answerer->hello())) {
    checked.left_out = "no eval: weights, reciprocity and energy are not checked\n";
  }
  checked.end = answerer->finish();
  checked.values = answerer->values();
  checked.queries = answerer->queries();
  checked.report.replay = replay_command(given, options.contract.seed);
  return checked;
}

void note_replay(verify::Report& report) {
  for (verify::CheckResult& result : report) result.replay = report.replay;
}

}  // namespace plumbline::tools
