#pragma once

#include <cstdint>
#include <string>

#include <plumbline/verify/detail/vector_access.h>

/// Numbers in the sentences that people read.
namespace plumbline::verify {

/// Six significant digits, as short as possible: "0.5", "1.2e-09", "nan".
std::string number(double value);

std::string number(std::uint64_t value);

/// A share to a tenth of a percent: "12.5 %".
std::string percent(double share);

/// "(0.1, 0.2, 0.97)"
std::string place(const Vec3& x);

}  // namespace plumbline::verify
