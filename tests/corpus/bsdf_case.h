#pragma once

#include <string>
#include <utility>
#include <vector>

#include "corpus.h"

/// How the BSDF families enter their cases.
namespace plumbline::tests::corpus {

using verify::BsdfOptions;
using verify::CauseKind;

/// Few directions, so that a case takes about a second; from the front only where the BSDF is black
/// from below.
inline BsdfOptions seen_from(std::vector<double> angles, bool back = false) {
  BsdfOptions options;
  options.angles = std::move(angles);
  options.random_directions = 0;
  options.back = back;
  return options;
}

inline BsdfOptions from_both_faces(std::vector<double> angles, double eta = 1) {
  BsdfOptions options = seen_from(std::move(angles), true);
  options.eta = eta;
  return options;
}

/// @param fault  empty: it is correct
template <class Direction, class Numbers, class B>
Case bsdf_case(const std::string& name, const std::string& fault, std::vector<CauseKind> causes,
               const B& bsdf, const BsdfOptions& options) {
  const bool is_twin = !fault.empty();
  return {name, fault, std::move(causes),
          [name, bsdf, options, is_twin](std::uint64_t seed, Effort effort) {
            BsdfOptions here = options;
            here.contract = with_effort(options.contract, effort, is_twin);
            here.contract.seed = seed;
            return verify::check_bsdf<Direction, Numbers>(name, bsdf, here);
          }};
}

template <class Direction, class Numbers = void, class B>
void correct(std::vector<Case>& cases, const std::string& name, const B& bsdf,
             const BsdfOptions& options) {
  cases.push_back(bsdf_case<Direction, Numbers>(name, "", {}, bsdf, options));
}

/// The same with one fault put in.
///
/// @param what    short, the end of the name
/// @param fault   in words
template <class Direction, class Numbers = void, class B>
void twin(std::vector<Case>& cases, const std::string& subject, const std::string& what,
          const std::string& fault, std::vector<CauseKind> causes, const B& bsdf,
          const BsdfOptions& options) {
  cases.push_back(
      bsdf_case<Direction, Numbers>(subject + "/" + what, fault, std::move(causes), bsdf, options));
}

}  // namespace plumbline::tests::corpus
