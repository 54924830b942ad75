#pragma once

#include <plumbline/verify/pair.h>

namespace plumbline::verify {

/// Of a pair that has an inverse and a map of numbers.
CheckResult judge_inverse(const SamplingPair& pair, const ContractOptions& options);

inline bool has_inverse(const SamplingPair& pair) {
  return pair.inverse && pair.sample && !pair.draw && pair.domain.dimension() > 0;
}

}  // namespace plumbline::verify
