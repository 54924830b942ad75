#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// OpenEXR files byte by byte, as no library would write them.
namespace plumbline::tests {

inline constexpr std::uint32_t kExrTiled = 0x200, kExrDeep = 0x800, kExrSeveralParts = 0x1000;

/// What a header claims; the rest of the file is the test's.
struct ExrClaims {
  std::int32_t x0 = 0, y0 = 0, x1 = 3, y1 = 3;  ///< the data window, both ends in it
  std::uint8_t compression = 0;                 ///< none; 2 is ZIPS, 3 ZIP, 9 DWAB
  std::vector<std::string> channels = {"Y"};    ///< floats
  std::uint32_t flags = 0;
  std::uint32_t tile_width = 64, tile_height = 64;  ///< where the flags say so
  std::string more = {};                            ///< attributes as bytes
};

template <class T>
std::string bytes_of(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// @param size  as the file claims it; that of the value where it is negative
inline std::string exr_attribute(const std::string& name, const std::string& type,
                                 const std::string& value, std::int64_t size = -1) {
  const auto claimed = static_cast<std::int32_t>(size < 0 ? std::int64_t(value.size()) : size);
  return name + '\0' + type + '\0' + bytes_of(claimed) + value;
}

inline std::string exr_header(const ExrClaims& claims) {
  std::string channels;
  for (const std::string& name : claims.channels) {
    channels += name + '\0' + bytes_of(2) + bytes_of(0) + bytes_of(1) + bytes_of(1);
  }
  const std::string window =
      bytes_of(claims.x0) + bytes_of(claims.y0) + bytes_of(claims.x1) + bytes_of(claims.y1);
  std::string bytes = bytes_of(20000630) + bytes_of(2 | claims.flags);
  bytes += exr_attribute("channels", "chlist", channels + '\0');
  bytes += exr_attribute("compression", "compression", bytes_of(claims.compression));
  bytes += exr_attribute("dataWindow", "box2i", window);
  bytes += exr_attribute("displayWindow", "box2i", window);
  bytes += exr_attribute("lineOrder", "lineOrder", bytes_of(std::uint8_t{0}));
  bytes += exr_attribute("pixelAspectRatio", "float", bytes_of(1.0f));
  bytes += exr_attribute("screenWindowCenter", "v2f", bytes_of(0.0f) + bytes_of(0.0f));
  bytes += exr_attribute("screenWindowWidth", "float", bytes_of(1.0f));
  if (claims.flags & kExrTiled) {
    bytes += exr_attribute(
        "tiles", "tiledesc",
        bytes_of(claims.tile_width) + bytes_of(claims.tile_height) + bytes_of(std::uint8_t{0}));
  }
  return bytes + claims.more + '\0';
}

}  // namespace plumbline::tests
