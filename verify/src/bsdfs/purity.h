#pragma once

#include <cstdint>
#include <string>

#include <plumbline/verify/bsdf.h>

namespace plumbline::verify {

/// Sees that a BSDF gives the same for the same input, whatever it is asked in between: what is
/// asked from several threads has no order.
///
/// @throws std::invalid_argument where it does not, which says of what
void require_pure(const std::string& name, const ErasedBsdf& bsdf, std::uint64_t seed);

}  // namespace plumbline::verify
