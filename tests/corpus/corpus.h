#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/detail/cause.h>

/// Sampling code as production renderers write it, correct and with one fault put in. It is what
/// the library is held to: silence about the correct, the right cause for the others.
namespace plumbline::tests::corpus {

/// What a battery returns.
using Results = verify::Report;

/// What a battery may spend.
enum class Effort {
  user,  ///< as the library's options are by default
  gate  ///< of hundreds of batteries: masses add up within 2e-3; of correct code a sixteenth of the
        ///< bins, and samples until four times the deviation is excluded; of a twin, which has to
        ///< be found, a fourth of the bins and of the evaluations, and half that deviation
};

/// One subject with its parameters, correct or with one fault put in.
struct Case {
  /// "rough glass/alpha 0.2/float"; of a twin "rough glass/alpha 0.2/pdf without 1/(4 wo·h)"
  std::string name;

  /// Empty: correct. Else what was done, in words; where a mutant (tests/mutants) or a known bug
  /// (tests/verify/known_bugs_test.cpp) is like it, with its id: "B3".
  std::string fault;

  /// Of a fault: the kinds that a diagnosis is right to name. The first is the one that a person
  /// would; others are here only where they say the same of this code.
  std::vector<verify::CauseKind> causes;

  /// The battery, as a user would call it.
  std::function<Results(std::uint64_t seed, Effort effort)> run;
};

verify::ContractOptions with_effort(verify::ContractOptions options, Effort effort, bool is_twin);

std::vector<Case> bsdf_cases();
std::vector<Case> pair_cases();  ///< lights, maps, warps, discrete, distances, phase functions

/// Faulty twins of a later set, `second` and so on: unseen by whoever wrote the diagnosis until
/// they were first scored. In a build with PLUMBLINE_SEALED_CORPUS alone, which `./run score`
/// makes.
std::vector<Case> sealed_bsdf_cases();
std::vector<Case> sealed_pair_cases();

}  // namespace plumbline::tests::corpus
