#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <plumbline_tests/exr_bytes.h>
#include <plumbline_tests/support.h>

#include <string>
#include <vector>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/image_io/budgets.h>
#include <plumbline/renderer/image_io/exr.h>

/// OpenEXR files that claim what they do not hold, or are damaged, are refused with what is wrong;
/// those that are merely unusual are read.
namespace plumbline::tests {
namespace {

/// What read_exr says of a file with those bytes, without its name; empty if it takes it.
std::string refusal_of_exr(const std::string& bytes) {
  const ScratchDirectory scratch;
  const auto path = scratch.write("a.exr", bytes);
  try {
    renderer::read_exr(path);
  } catch (const renderer::InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0u) << message;
    return message.substr(path.string().size() + 2);
  }
  return {};
}

/// Whether it is refused because of what it claims, and what is said then.
void expect_over_budget(const std::string& bytes, const std::string& message) {
  const ScratchDirectory scratch;
  const auto path = scratch.write("a.exr", bytes);
  try {
    renderer::read_exr(path);
    ADD_FAILURE() << "was read: " << message;
  } catch (const renderer::BudgetError& error) {
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
  }
}

/// One line of Y without compression, as the header says it: offset of the line, y, size, floats.
std::string lines_of_four(int lines, const std::string& header, float value) {
  std::string table, data;
  for (int y = 0; y < lines; ++y) {
    table += bytes_of(std::uint64_t(header.size()) + 8u * unsigned(lines) + data.size());
    data += bytes_of(y) + bytes_of(16);
    for (int x = 0; x < 4; ++x) data += bytes_of(value);
  }
  return header + table + data;
}

TEST(HostileExr, TheBytesOfTheseTestsAreAnImageWhereTheyClaimWhatTheyHold) {
  const ScratchDirectory scratch;
  const auto path = scratch.write("a.exr", lines_of_four(4, exr_header({}), 2.5f));
  const renderer::Image image = renderer::read_exr(path);
  EXPECT_EQ(image.pixels, std::vector<renderer::Rgbf>(16, {2.5f, 2.5f, 2.5f}));
}

TEST(HostileExr, ClaimingMorePixelsThanAnyImageHasIsRefused) {
  const std::string why =
      "claims 65536x16384 pixels: sides go from 1 to 65536, pixels up to 67108864";
  for (std::uint8_t compression = 0; compression < 10; ++compression) {
    const ExrClaims claims{.x1 = 65535, .y1 = 16383, .compression = compression};
    expect_over_budget(exr_header(claims) + std::string(131072, '\1'), why);
  }
  expect_over_budget(exr_header({.x1 = 65536, .y1 = 0}) + std::string(1000, '\1'),
                     "claims 65537x1 pixels");
}

TEST(HostileExr, ClaimingMoreThanAFileOfItsSizeCanHoldIsRefused) {
  for (std::uint8_t compression = 0; compression < 8; ++compression) {
    const ExrClaims claims{.x1 = 16383, .y1 = 4095, .compression = compression};
    expect_over_budget(exr_header(claims) + std::string(67000, '\1'),
                       "more than " + std::to_string(exr_header(claims).size() + 67000) +
                           " bytes can hold: it is cut off or made up");
  }
  // Tiles of one pixel: four million in the table.
  const ExrClaims tiles{.x1 = 2047,
                        .y1 = 2047,
                        .compression = 9,
                        .flags = kExrTiled,
                        .tile_width = 1,
                        .tile_height = 1};
  expect_over_budget(exr_header(tiles) + std::string(1 << 20, '\1'), "in 4194304 pieces");
}

TEST(HostileExr, ClaimingMuchToBeDecodedAtOnceIsRefused) {
  const ExrClaims line{.x1 = 65535, .y1 = 0, .compression = 9, .channels = {"B", "G", "R"}};
  expect_over_budget(exr_header(line) + std::string(5000, '\1'), "bytes are decoded at once");
  const ExrClaims tile{.x1 = 15,
                       .y1 = 15,
                       .compression = 9,
                       .flags = kExrTiled,
                       .tile_width = 16384,
                       .tile_height = 16384};
  expect_over_budget(exr_header(tile) + std::string(5000, '\1'), "bytes are decoded at once");
}

TEST(HostileExr, AttributesThatClaimMoreThanTheFileHoldsAreRefused) {
  for (const std::int64_t size : {100, 1 << 20, 0x7fffffff}) {
    const std::string attribute = exr_attribute("foo", "string", std::string(66, 'a'), size);
    EXPECT_NE(refusal_of_exr(bytes_of(20000630) + bytes_of(2) + attribute), "") << size;
    EXPECT_NE(refusal_of_exr(exr_header({.more = attribute})), "") << size;
  }
}

TEST(HostileExr, ManyAttributesAreRefused) {
  std::string attributes;
  for (int i = 0; i < 10000; ++i) {
    attributes += exr_attribute("a" + std::to_string(i), "int", bytes_of(i));
  }
  expect_over_budget(lines_of_four(4, exr_header({.more = attributes}), 1), "attributes");
}

TEST(HostileExr, ManyChannelsAreRefused) {
  std::vector<std::string> channels;
  for (int i = 0; i < 30000; ++i) channels.push_back("a channel " + std::to_string(100000 + i));
  expect_over_budget(exr_header({.channels = channels}), "channels");
}

TEST(HostileExr, WindowsThatEndBeforeTheyBeginAreRefused) {
  EXPECT_NE(refusal_of_exr(exr_header({.x1 = -5}) + std::string(1000, '\0')), "");
  EXPECT_NE(refusal_of_exr(exr_header({.y1 = -5}) + std::string(1000, '\0')), "");
  EXPECT_NE(refusal_of_exr(exr_header({.x0 = -2147483647 - 1, .x1 = 2147483647})), "");
}

TEST(HostileExr, WindowsThatBeginBeforeZeroAreRead) {
  std::string bytes = exr_header({.x0 = -2, .y0 = 0, .x1 = 1, .y1 = 1});
  EXPECT_EQ(refusal_of_exr(lines_of_four(2, bytes, 1)), "");
}

TEST(HostileExr, TilesWithoutPixelsAreRefused) {
  for (const std::uint32_t side : {0u, 0x80000000u, 0xffffffffu}) {
    const ExrClaims claims{.flags = kExrTiled, .tile_width = side};
    EXPECT_NE(refusal_of_exr(exr_header(claims) + std::string(1000, '\0')), "") << side;
  }
}

TEST(HostileExr, DeepPixelsAndSeveralPartsAreRefused) {
  EXPECT_NE(refusal_of_exr(exr_header({.flags = kExrDeep}) + std::string(1000, '\0')), "");
  EXPECT_NE(refusal_of_exr(exr_header({.flags = kExrSeveralParts}) + std::string(1000, '\0')), "");
}

TEST(HostileExr, LinesOutOfTheirPlaceAreRefused) {
  const std::string header = exr_header({});
  std::string bytes = lines_of_four(4, header, 1);
  bytes.replace(header.size() + 32 + 24, 4, bytes_of(2));  // where line 1 says which it is
  EXPECT_NE(refusal_of_exr(bytes), "");
}

TEST(HostileExr, CutAnywhereIsRefused) {
  const std::string bytes = lines_of_four(4, exr_header({}), 1);
  for (std::size_t length = 0; length < bytes.size(); length += 3) {
    EXPECT_NE(refusal_of_exr(bytes.substr(0, length)), "") << length;
  }
}

TEST(HostileExr, WithOneByteChangedNeverCrashes) {
  const std::string bytes = lines_of_four(4, exr_header({}), 1);
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ (at % 2 == 0 ? 0x7f : 0xff));
    refusal_of_exr(changed);
  }
}

constexpr int kWide = 1024, kHigh = 512;

/// A black image, which takes the fewest bytes that there can be.
Imf::Header black_header(Imf::Compression compression) {
  Imf::Header header(kWide, kHigh);
  header.compression() = compression;
  for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  return header;
}

Imf::FrameBuffer black_pixels(std::vector<float>& pixels) {
  Imf::FrameBuffer buffer;
  for (const char* name : {"R", "G", "B"}) {
    buffer.insert(name,
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()), 4, 4 * kWide));
  }
  return buffer;
}

TEST(HostileExr, ABlackImageIsReadWithEveryCompression) {
  const ScratchDirectory scratch;
  std::vector<float> pixels(kWide * kHigh);
  for (int method = 0; method < Imf::NUM_COMPRESSION_METHODS; ++method) {
    const auto path = scratch / ("lines" + std::to_string(method));
    {
      Imf::OutputFile file(path.c_str(), black_header(Imf::Compression(method)));
      file.setFrameBuffer(black_pixels(pixels));
      file.writePixels(kHigh);
    }
    EXPECT_EQ(renderer::read_exr(path).pixels.size(), pixels.size()) << method;
  }
}

TEST(HostileExr, TilesAndLevelsAreRead) {
  const ScratchDirectory scratch;
  std::vector<float> pixels(kWide * kHigh, 0.5f);
  for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS}) {
    const auto path = scratch / ("tiles" + std::to_string(mode));
    Imf::Header header = black_header(Imf::ZIP_COMPRESSION);
    header.setTileDescription(Imf::TileDescription(64, 32, mode));
    {
      Imf::TiledOutputFile file(path.c_str(), header);
      file.setFrameBuffer(black_pixels(pixels));
      for (int level = 0; level < file.numLevels(); ++level) {
        file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
      }
    }
    const renderer::Image image = renderer::read_exr(path);
    EXPECT_EQ(image.pixels, std::vector<renderer::Rgbf>(pixels.size(), {0.5f, 0.5f, 0.5f}));
  }
}

TEST(HostileExr, ImagesOfSeveralStripsAreReadLineByLine) {
  // Wide enough that memory is taken in three strips.
  const ScratchDirectory scratch;
  renderer::Image image{1 << 16, 33, {}, {}, {}, {}};
  image.pixels.resize(std::size_t{1 << 16} * 33);
  ASSERT_GT(image.pixels.size(), 2u * renderer::kExrStripPixels);
  image.count.resize(image.pixels.size(), 7);
  for (std::size_t i = 0; i < image.pixels.size(); i += 1000) {
    image.pixels[i] = {static_cast<float>(i), 1, 2};
    image.count[i] = static_cast<float>(i % 17);
  }
  renderer::write_exr(scratch / "a.exr", image);
  const renderer::Image back = renderer::read_exr(scratch / "a.exr");
  EXPECT_EQ(back.pixels, image.pixels);
  EXPECT_EQ(back.count, image.count);
}

}  // namespace
}  // namespace plumbline::tests
