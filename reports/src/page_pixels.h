#pragma once

#include <string>

#include <plumbline/reports/page.h>

namespace plumbline::reports::detail {

/// The values of an image for the page: the upper half of each float (sign, 8 bits of exponent, 7
/// of fraction), little-endian, deflated, as base64. Finite values are rounded to the nearest, by
/// at most 2⁻⁸ of theirs where they are at least 2⁻¹²⁶, and stay finite; others stay what they are.
///
/// @throws std::invalid_argument for an image whose size and data disagree
std::string page_pixels(const PageImage& image);

}  // namespace plumbline::reports::detail
