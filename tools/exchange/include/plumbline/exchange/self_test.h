#pragma once

#include <functional>
#include <optional>
#include <string>

#include <plumbline/exchange/answerer.h>
#include <plumbline/verify/detail/domain.h>

namespace plumbline::exchange {

/// One thing that the protocol asks of a program.
struct SelfTestStep {
  std::string what;
  bool ok = false;
  std::string detail;  ///< what was wrong, or seen
};

using DomainOf = std::function<std::optional<verify::Domain>(const reports::AnswererHello&)>;

/// Whether a program does as the protocol says: batches of all sizes, kinds in any order, values
/// that do not depend on the others of their batch, an end of its own. Says nothing of whether its
/// values are right.
///
/// @param domain_of  the domain of what it answers for, by what it says of itself; nothing: a BSDF
/// @param tell       is given each step when it is done; one that fails is the last
/// @return           whether all are well
bool self_test(const AnswererOptions& options, const DomainOf& domain_of,
               const std::function<void(const SelfTestStep&)>& tell);

}  // namespace plumbline::exchange
