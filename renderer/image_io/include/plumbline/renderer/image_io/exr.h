#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/render/film.h>

namespace plumbline::renderer {

/// An image as it is stored: row by row from the top, 32-bit floats.
struct Image {
  int width = 0, height = 0;
  std::vector<Rgbf> pixels;
  std::vector<Rgbf> variance;  ///< of one sample; empty where the file has none
  std::vector<float> count;    ///< samples per pixel; empty where the file has none
  std::map<std::string, std::string> metadata;  ///< string attributes of the header
};

Image to_image(const Film& film);

/// Writes a multi-layer OpenEXR file: R, G, B, `variance.R`, `variance.G`, `variance.B`, `count`,
/// and the metadata as string attributes. Written over what is there, if that is a regular file;
/// who needs the file whole or not at all writes it elsewhere and renames it: tools' output_file.h.
///
/// @throws InputError where the path cannot be written to, MachineError where the disk is full
void write_exr(const std::filesystem::path& path, const Image& image);

/// Reads R, G, B (or Y alone) and, where present, the layers that write_exr makes.
///
/// @throws BudgetError "file: what" for one that claims more than image_io/budgets.h has for it, or
///         than it can hold, before memory is taken for that; InputError for anything else that is
///         not such an image
Image read_exr(const std::filesystem::path& path);

/// Of a header, what memory is taken by: two readers of a damaged one may not agree on it.
struct ExrHeader {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< the window, both ends included
  int channels = 0, compression = 0;
  std::uint32_t tile_width = 0, tile_height = 0;  ///< 0 where there are none
  bool operator==(const ExrHeader&) const = default;
};

/// Refuses an OpenEXR file for what its header claims, by which OpenEXR itself takes memory: as
/// read_exr does, without the file's name.
ExrHeader check_exr_claims(const std::filesystem::path& path);

}  // namespace plumbline::renderer
