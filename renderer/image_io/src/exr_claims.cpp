#include <fmt/format.h>
#include <openexr.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/image_io/budgets.h>
#include <plumbline/renderer/image_io/exr.h>

namespace plumbline::renderer {
namespace {

template <class... Args>
void require(bool good, fmt::format_string<Args...> what, Args&&... args) {
  if (!good) throw BudgetError(fmt::format(what, std::forward<Args>(args)...));
}

/// What the C library may still allocate for what a header claims; unlike the one for C++ it asks,
/// but it may go on where the answer is no.
thread_local std::size_t allocations_left = 0;

void* allocate(std::size_t bytes) {
  if (bytes > kMaxExrAttributeBytes) allocations_left = 0;
  return allocations_left == 0 || --allocations_left == 0 ? nullptr : std::malloc(bytes);
}

void check(exr_result_t result) {
  require(allocations_left > 0,
          "its header has more than {} attributes, {} channels or {} bytes in one of them",
          kMaxExrAttributes, kMaxExrChannels, kMaxExrAttributeBytes);
  if (result == EXR_ERR_SUCCESS) return;
  throw InputError(std::string("is no OpenEXR image, damaged or cut off: ") +
                   exr_get_error_code_as_string(result));
}

using Header = std::unique_ptr<std::remove_pointer_t<exr_context_t>, void (*)(exr_context_t)>;

Header open_header(const std::filesystem::path& path) {
  exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
  options.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
  options.alloc_fn = allocate;
  options.free_fn = std::free;
  // For each attribute or channel: itself, its name, its value, a list.
  allocations_left = std::size_t{4} * (kMaxExrAttributes + kMaxExrChannels);
  exr_context_t context = nullptr;
  const exr_result_t result = exr_start_read(&context, path.c_str(), &options);
  Header header(context, [](exr_context_t open) { exr_finish(&open); });
  check(result);
  return header;
}

/// What a function of the library says of the file's first part.
template <class T>
T get(const Header& header, exr_result_t (*function)(exr_const_context_t, int, T*)) {
  T value{};
  check(function(header.get(), 0, &value));
  return value;
}

/// Pixels of a row of tiles, or of the lines of a chunk: what is decoded at once.
std::int64_t pixels_at_once(const Header& header, std::int64_t width) {
  if (get(header, exr_get_storage) != EXR_STORAGE_TILED) {
    return width * get<std::int32_t>(header, exr_get_scanlines_per_chunk);
  }
  std::uint32_t x = 0, y = 0;
  check(exr_get_tile_descriptor(header.get(), 0, &x, &y, nullptr, nullptr));
  return std::max(width, std::int64_t{x}) * y;
}

}  // namespace

ExrHeader check_exr_claims(const std::filesystem::path& path) {
  const Header header = open_header(path);
  int parts = 0;
  check(exr_get_count(header.get(), &parts));
  require(get<std::int32_t>(header, exr_get_attribute_count) <= kMaxExrAttributes,
          "has more than {} attributes", kMaxExrAttributes);
  require(parts == 1, "has {} parts: write each to a file of its own", parts);
  require(get(header, exr_get_storage) < EXR_STORAGE_DEEP_SCANLINE,
          "holds deep pixels: flatten the image");
  const auto [low, high] = get(header, exr_get_data_window);
  const std::int64_t width = std::int64_t{high.x} - low.x + 1;
  const std::int64_t height = std::int64_t{high.y} - low.y + 1;
  require(width >= 1 && width <= kMaxImageSide && height >= 1 && height <= kMaxImageSide &&
              width * height <= kMaxImagePixels,
          "claims {}x{} pixels: sides go from 1 to {}, pixels up to {}", width, height,
          kMaxImageSide, kMaxImagePixels);
  const exr_attr_chlist_t& channels = *get<const exr_attr_chlist_t*>(header, exr_get_channels);
  double pixel = 0;  // bytes; channels that are stored for every second pixel count half
  for (const auto& c :
       std::span(channels.entries, static_cast<std::size_t>(channels.num_channels))) {
    pixel += (c.pixel_type == EXR_PIXEL_HALF ? 2.0 : 4.0) / c.x_sampling / c.y_sampling;
  }
  const double at_once = static_cast<double>(pixels_at_once(header, width)) * pixel;
  require(at_once <= kMaxExrBytesAtOnce,
          "{} bytes are decoded at once, {} are the most: use smaller tiles or fewer channels",
          at_once, kMaxExrBytesAtOnce);
  const auto chunks = get<std::int32_t>(header, exr_get_chunk_count);
  const auto bytes = static_cast<double>(std::filesystem::file_size(path));
  const double ratio = kExrRatios.at(get(header, exr_get_compression));
  // A chunk has 8 bytes in the table, and 8 or more before its data.
  require(16.0 * chunks <= bytes && static_cast<double>(width * height) * pixel <= ratio * bytes,
          "claims {}x{} pixels in {} pieces, more than {} bytes can hold: it is cut off or made up",
          width, height, chunks, bytes);
  ExrHeader claims{
      low.x, low.y, high.x, high.y, channels.num_channels, get(header, exr_get_compression)};
  if (get(header, exr_get_storage) == EXR_STORAGE_TILED) {
    check(exr_get_tile_descriptor(header.get(), 0, &claims.tile_width, &claims.tile_height, nullptr,
                                  nullptr));
  }
  return claims;
}

}  // namespace plumbline::renderer
