#include "page_pixels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "base64.h"
#include "deflate.h"

namespace plumbline::reports::detail {
namespace {

constexpr std::uint32_t kUpperHalf = 0xffff0000u;
constexpr std::uint32_t kSign = 0x80000000u;
constexpr std::uint32_t kLargestFinite = 0x7f7f0000u;

/// The nearest float whose lower half is zero: noise that no eye sees is what costs space.
std::uint16_t upper_half(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  if (std::isnan(value)) return 0x7fc0;
  if (std::isinf(value)) return static_cast<std::uint16_t>(bits >> 16);
  const std::uint32_t rounded = ((bits & ~kSign) + 0x8000u) & kUpperHalf;
  return static_cast<std::uint16_t>(((bits & kSign) | std::min(rounded, kLargestFinite)) >> 16);
}

}  // namespace

std::string page_pixels(const PageImage& image) {
  if (image.width <= 0 || image.height <= 0 ||
      image.rgb.size() != std::size_t{3} * static_cast<std::size_t>(image.width) *
                              static_cast<std::size_t>(image.height)) {
    throw std::invalid_argument("image \"" + image.group + "/" + image.name +
                                "\": size and data disagree");
  }
  std::string bytes;
  bytes.reserve(2 * image.rgb.size());
  for (const float value : image.rgb) {
    const std::uint16_t half = upper_half(value);
    bytes += static_cast<char>(half & 0xff);
    bytes += static_cast<char>(half >> 8);
  }
  return base64_of(deflate(bytes));
}

}  // namespace plumbline::reports::detail
