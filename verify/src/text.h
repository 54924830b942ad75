#pragma once

#include <cstdint>
#include <string>

/// Numbers in the sentences that people read.
namespace plumbline::verify {

/// Six significant digits, as short as possible: "0.5", "1.2e-09", "nan".
std::string number(double value);

std::string number(std::uint64_t value);

}  // namespace plumbline::verify
