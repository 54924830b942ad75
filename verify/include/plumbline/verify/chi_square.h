#pragma once

#include <string>
#include <utility>

#include <plumbline/verify/contract.h>
#include <plumbline/verify/sampling_pair.h>

namespace plumbline::verify {

/// Chi-square test of a sampler of directions alone, for a user's own vector type. See
/// `check_chi_square` of a pair in contract.h.
///
/// @param density  pdf_w [1/sr] of a unit direction
/// @param sampler  two numbers uniform in [0, 1), in the scalar of the direction's type, to an
/// optional
///                 direction
template <class Direction, class Density, class Sampler>
CheckResult check_chi_square(std::string subject, Density density, Sampler sampler,
                             const ContractOptions& options = {}) {
  return check_chi_square(make_pair<Direction>(std::move(subject), Domain::sphere(),
                                               std::move(sampler), std::move(density)),
                          options);
}

}  // namespace plumbline::verify
