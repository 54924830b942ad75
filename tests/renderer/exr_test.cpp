#include <plumbline/renderer/image_io/exr.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

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

TEST_F(Exr, LayersThatAnImageLacksStayEmpty) {
  Image image = small_image();
  image.variance.clear();
  image.count.clear();
  write_exr(folder_ / "plain.exr", image);
  const Image back = read_exr(folder_ / "plain.exr");
  EXPECT_TRUE(back.variance.empty());
  EXPECT_TRUE(back.count.empty());
}

TEST_F(Exr, AFailedWriteLeavesTheOldFileAndNoRemains) {
  const auto folder = folder_ / "missing";
  EXPECT_THROW(write_exr(folder / "image.exr", small_image()), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder));
  std::filesystem::create_directory(folder_ / "a_folder");
  EXPECT_THROW(write_exr(folder_ / "a_folder", small_image()), InputError);
  EXPECT_TRUE(std::filesystem::is_directory(folder_ / "a_folder"));
  EXPECT_THROW(write_exr("/dev/null", small_image()), InputError);
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
