#include <plumbline/renderer/image_io/exr.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

#include <plumbline/renderer/core/errors.h>

namespace plumbline::renderer {
namespace {

class Exr : public testing::Test {
 protected:
  Exr() { std::filesystem::create_directories(folder_); }
  ~Exr() override { std::filesystem::remove_all(folder_); }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("plumbline_exr_" + std::to_string(getpid()));
};

Image small_image() {
  Image image{2, 1, {{1, 2, 3}, {0.25f, 1e-30f, 1e30f}}, {{4, 5, 6}, {7, 8, 9}}, {16, 16}, {}};
  image.metadata["scene"] = "furnace";
  return image;
}

TEST_F(Exr, WhatIsWrittenIsReadBackBitForBit) {
  const auto path = folder_ / "image.exr";
  write_exr(path, small_image());
  const Image image = read_exr(path);
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 1);
  EXPECT_EQ(image.pixels, small_image().pixels);
  EXPECT_EQ(image.variance, small_image().variance);
  EXPECT_EQ(image.count, small_image().count);
  EXPECT_EQ(image.metadata.at("scene"), "furnace");
}

/// What OpenEXR finds in each channel of a file of 2 by 1 pixels: not by the reader above, which
/// would undo what the writer mixed up.
std::map<std::string, std::vector<float>> channels_of(const std::filesystem::path& path) {
  Imf::InputFile file(path.c_str());
  std::map<std::string, std::vector<float>> found;
  Imf::FrameBuffer buffer;
  const Imf::ChannelList& channels = file.header().channels();
  for (auto it = channels.begin(); it != channels.end(); ++it) {
    EXPECT_EQ(it.channel().type, Imf::FLOAT) << it.name();
    std::vector<float>& values = found[it.name()];
    values.resize(2);
    buffer.insert(it.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                        sizeof(float), 2 * sizeof(float)));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(0, 0);
  return found;
}

TEST_F(Exr, EveryChannelHoldsWhatItsNameSays) {
  const auto path = folder_ / "channels.exr";
  Image image = small_image();
  image.count = {16, 17};
  write_exr(path, image);
  const std::map<std::string, std::vector<float>> expected = {
      {"R", {1, 0.25f}},      {"G", {2, 1e-30f}},     {"B", {3, 1e30f}},  {"variance.R", {4, 7}},
      {"variance.G", {5, 8}}, {"variance.B", {6, 9}}, {"count", {16, 17}}};
  EXPECT_EQ(channels_of(path), expected);
}

TEST_F(Exr, LayersThatAnImageLacksStayEmpty) {
  Image image = small_image();
  image.variance.clear();
  image.count.clear();
  write_exr(folder_ / "plain.exr", image);
  const Image back = read_exr(folder_ / "plain.exr");
  EXPECT_TRUE(back.variance.empty());
  EXPECT_TRUE(back.count.empty());
}

TEST_F(Exr, WhatIsNoRegularFileIsNotWrittenOver) {
  const auto folder = folder_ / "missing";
  EXPECT_THROW(write_exr(folder / "image.exr", small_image()), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder));
  std::filesystem::create_directory(folder_ / "a_folder");
  EXPECT_THROW(write_exr(folder_ / "a_folder", small_image()), InputError);
  EXPECT_TRUE(std::filesystem::is_directory(folder_ / "a_folder"));
  // What is no regular file stays what it is. Not /dev/null: code that is wrong would replace that.
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(write_exr(folder_ / "pipe", small_image()), InputError);
  EXPECT_TRUE(std::filesystem::is_fifo(folder_ / "pipe"));
}

TEST_F(Exr, FilesThatAreNoImageAreRefusedByName) {
  const auto path = folder_ / "text.exr";
  std::ofstream(path) << "not an image";
  for (const auto& bad : {path, folder_ / "missing.exr", folder_}) {
    try {
      read_exr(bad);
      ADD_FAILURE() << bad << " was read";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(bad.string()), std::string::npos) << error.what();
    }
  }
}

TEST_F(Exr, ATruncatedFileIsRefused) {
  const auto path = folder_ / "cut.exr";
  write_exr(path, small_image());
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 10);
  EXPECT_THROW(read_exr(path), InputError);
}

}  // namespace
}  // namespace plumbline::renderer
