#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// What a file may ask for, all in one place; for records of results it is reports/budgets.h. What
/// people make passes with room to spare: a map of the sky with 8192x4096 pixels, a picture of
/// 4096x2160 with all of our layers, a scanned mesh. What a few bytes can claim does not, and is
/// refused before memory is taken.
namespace plumbline::renderer {

// Images and films.

inline constexpr int kMaxImageSide = 1 << 16;
/// Twice the 8k map's. A film keeps 56 bytes a pixel, 3.5 GB at most; an image of ours 28 at most.
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 26;

// OpenEXR. Its reader takes a header's word for sizes, so ours stands before it.

/// Renderers write a few dozen, a film's compositors hundreds.
inline constexpr int kMaxExrChannels = 1024;
/// Cameras and renderers write about a hundred; the reader takes some 200 bytes for each.
inline constexpr int kMaxExrAttributes = 4096;
/// Thumbnails and tables of object names (Cryptomatte) come to a few megabytes.
inline constexpr std::size_t kMaxExrAttributeBytes = std::size_t{16} << 20;
/// Of pixels that are decoded at once: 256 lines (DWAB, the most) of 8192 pixels with our layers.
inline constexpr double kMaxExrBytesAtOnce = 1 << 26;
/// Pixels that memory is taken for ahead of their being decoded.
inline constexpr std::int64_t kExrStripPixels = std::int64_t{1} << 20;

/// Bytes that one byte in the file can become at most, by the number of the compression. Runs of
/// 128 take 2 (RLE); deflate makes 1032 of one, of which PXR24 keeps 3 in 4; 256 equal halves take
/// 10 bits of PIZ; 32 bytes take 14 of B44 and 3 of B44A; DWA's runs are deflated once more.
inline constexpr std::array<double, 10> kExrRatios = {1,    64, 1033, 1033,  512,
                                                      1400, 3,  11,   66100, 66100};

// Scene files and meshes.

/// Of a scene file with those that it includes, and of all that parameters put into them. The
/// largest by hand have a few hundred kilobytes; the parser takes five times as much.
inline constexpr std::size_t kMaxSceneBytes = std::size_t{16} << 20;
/// Files that a scene includes, and how many within each other: people split a scene into a dozen.
inline constexpr std::size_t kMaxIncludes = 256, kMaxIncludeNesting = 8;
/// Of a value that parameters were put into: a matrix has a few hundred bytes, a path 4096 at most.
/// Parameters of parameters multiply with every line, so each is held to it before it grows.
inline constexpr std::size_t kMaxValueBytes = std::size_t{64} << 10;
/// What is found wrong in a scene at once: more is not read, and each costs a search for its line.
inline constexpr std::size_t kMaxProblems = 1000;
/// Scenes have six levels; both are read by recursion.
inline constexpr int kMaxElementNesting = 32;
/// No element takes more than five; they are compared pairwise.
inline constexpr int kMaxElementAttributes = 32;
/// A mixture of mixtures asks 2^depth BSDFs for every answer.
inline constexpr int kMaxBsdfNesting = 8;
/// Ten million triangles; in memory three times as much.
inline constexpr std::size_t kMaxMeshBytes = std::size_t{512} << 20;
/// Corners of a face: what readers hold that count them in a byte.
inline constexpr std::size_t kMaxFaceCorners = 255;

}  // namespace plumbline::renderer
