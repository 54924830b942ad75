#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <plumbline/merging/merge.h>
#include <plumbline/merging/sample_range.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/image_io/exr.h>

#include "command_line.h"

/// Pictures of other samples of one scene, put together: from checkpoints they are the picture of
/// all samples, from images that but for a stated rounding, and nothing is counted twice.
namespace plumbline::tests {
namespace {

using merging::merge_checkpoints;
using merging::merge_images;
using merging::SampleRange;
using renderer::Image;
using renderer::Rgbf;

constexpr double kUnit = 0x1p-24;  // half a unit in the last place of 1, in float
constexpr float Rgbf::*kChannels[] = {&Rgbf::r, &Rgbf::g, &Rgbf::b};

TEST(SampleRanges, AreReadAsTheyAreWritten) {
  const std::vector<SampleRange> ranges = {{7, 0, 64, {}}, {18446744073709551615u, 64, 80, {2, 3}}};
  EXPECT_EQ(to_text(ranges), "7:0-64 18446744073709551615:64-80@2/3");
  EXPECT_EQ(merging::parse_ranges(to_text(ranges)), ranges);
  for (const char* text : {"", " ", "7", "7:0", "7:0-", "7:64-0", "7:0-0", "7:0-64 ", "7:0-64@",
                           "7:0-64@0/2", "7:0-64@3/2", "7:0-64@1", "7:0-64,8:0-64", "-7:0-64",
                           "7:0-64x", "7:0-99999999999999999999"}) {
    EXPECT_THROW(merging::parse_ranges(text), renderer::InputError) << text;
  }
}

TEST(SampleRanges, OverlapWhereTheSamePixelHasTheSameSample) {
  const SampleRange range{1, 16, 32, {}};
  EXPECT_TRUE(overlap(range, {1, 31, 40, {}}));
  EXPECT_FALSE(overlap(range, {1, 32, 40, {}}));
  EXPECT_FALSE(overlap(range, {1, 0, 16, {}}));
  EXPECT_FALSE(overlap(range, {2, 16, 32, {}}));
  EXPECT_TRUE(overlap(range, {1, 16, 32, {2, 5}}));
  // Of all pixels that two shards could share, by going through them.
  for (std::uint32_t n = 1; n <= 6; ++n) {
    for (std::uint32_t m = 1; m <= 6; ++m) {
      for (std::uint32_t i = 1; i <= n; ++i) {
        for (std::uint32_t j = 1; j <= m; ++j) {
          const merging::Shard a{i, n}, b{j, m};
          bool both = false;
          for (std::size_t pixel = 0; pixel < std::size_t{n} * m; ++pixel) {
            both |= a.has(pixel) && b.has(pixel);
          }
          EXPECT_EQ(share_pixels(a, b), both) << i << "/" << n << " " << j << "/" << m;
        }
      }
    }
  }
}

/// Renders and merges small pictures in a directory of its own.
class Merging : public testing::Test {
 protected:
  /// `NAME.exr`, and its checkpoint `NAME`.
  void render(const std::string& name, const std::string& options,
              const std::string& scene = "sphere_light --size 17x11") const {
    const Outcome outcome =
        run_plumbline(scratch_.path(), "render " + scene + " " + options + " --threads 1 -o " +
                                           name + ".exr --checkpoint " + name);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  std::vector<std::string> paths(const std::vector<std::string>& names) const {
    std::vector<std::string> paths;
    for (const std::string& name : names) paths.push_back((scratch_ / name).string());
    return paths;
  }

  Image image(const std::string& name) const { return renderer::read_exr(scratch_ / name); }
  Image checkpoints(const std::vector<std::string>& names) const {
    return merge_checkpoints(paths(names));
  }
  Image images(const std::vector<std::string>& names) const { return merge_images(paths(names)); }

  void change(const std::string& name, const std::string& changed,
              const std::function<void(Image&)>& by) const {
    Image one = image(name);
    by(one);
    write_exr(scratch_ / changed, one);
  }

  void expect_refused(const std::function<void()>& merge, const std::string& why) const {
    try {
      merge();
      FAIL() << "merged in spite of: " << why;
    } catch (const renderer::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  }

  const ScratchDirectory scratch_;
};

/// Of a mean and of a variance: what is allowed, or the largest difference over that.
struct Off {
  double mean = 0, variance = 0;
};

/// What is allowed for a channel of a pixel with this mean and variance in the second image.
using Allowed =
    std::function<Off(std::size_t pixel, float Rgbf::*channel, double mean, double variance)>;

Off worst_of(const Image& a, const Image& b, const Allowed& bound) {
  EXPECT_EQ(a.count, b.count);
  Off worst;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    for (float Rgbf::*channel : kChannels) {
      const double m = b.pixels[i].*channel, v = b.variance[i].*channel;
      const double m_off = std::abs(double{a.pixels[i].*channel} - m);
      const double v_off = std::abs(double{a.variance[i].*channel} - v);
      if (m_off > 0) worst.mean = std::max(worst.mean, m_off / bound(i, channel, m, v).mean);
      if (v_off > 0) {
        worst.variance = std::max(worst.variance, v_off / bound(i, channel, m, v).variance);
      }
    }
  }
  return worst;
}

/// Of what is the same in double but for the order of its sums: each is rounded to float once. The
/// sums are of 1e4 terms at most, whose roundings in double come to less than 1e-12 of the whole.
Off rounded_once(std::size_t, float Rgbf::*, double m, double v) {
  return {2 * kUnit * m + 1e-12 * m, 2 * kUnit * v + 1e-12 * (v + m * std::sqrt(v) + m * m)};
}

TEST_F(Merging, RangesOfOneSeedAreTheRenderOfAllOfThem) {
  const std::string seed = "--seed " + std::to_string(run_seed() % 1000000);
  for (const std::string options :
       {"", " --backend scalar", " --sampler sobol", " --sampler sobol --replicates 1"}) {
    render("whole", "--spp 48 " + seed + options);
    render("a", "--spp 16 " + seed + options);
    render("b", "--spp 16 --first-sample 16 " + seed + options);
    render("c", "--spp 16 --first-sample 32 " + seed + options);
    const Image merged = checkpoints({"a", "b", "c"}), whole = image("whole.exr");
    const Off off = worst_of(merged, whole, rounded_once);
    EXPECT_LE(off.mean, 1) << options;
    EXPECT_LE(off.variance, 1) << options;
    EXPECT_EQ(merged.metadata.at("samples"), "48");
    const Image turned = checkpoints({"c", "a", "b"});
    EXPECT_EQ(turned.pixels, merged.pixels) << "in whatever order";
    EXPECT_EQ(turned.variance, merged.variance);
    // The samples of `a` in the place of others are another picture.
    EXPECT_GT(worst_of(image("a.exr"), image("b.exr"), rounded_once).mean, 1e3) << options;
  }
}

TEST_F(Merging, ImagesAreTheCheckpointsButForTheStatedRounding) {
  const std::string seed = std::to_string(run_seed() % 1000000);
  for (const std::string sampler : {"", "--sampler sobol "}) {
    render("a", sampler + "--spp 32 --seed " + seed);
    render("b", sampler + "--spp 8 --seed 1" + seed);
    render("c", sampler + "--spp 64 --seed 2" + seed);
    const Image of_images = images({"a.exr", "b.exr", "c.exr"});
    const Image exact = checkpoints({"a", "b", "c"});
    const std::vector<Image> parts = {image("a.exr"), image("b.exr"), image("c.exr")};
    // As stated at merge_images; and what it is held against is rounded once itself.
    const auto stated = [&](std::size_t pixel, float Rgbf::*channel, double m, double v) -> Off {
      double most = 0;
      for (const Image& part : parts) most = std::max<double>(most, part.pixels[pixel].*channel);
      return {kUnit * (most + 2 * m),
              3 * kUnit * v + 6 * kUnit * most * std::sqrt(v) + 9 * kUnit * kUnit * most * most};
    };
    const auto off_by = [&](const Image& merged) { return worst_of(merged, exact, stated); };
    const Off off = off_by(of_images);
    EXPECT_LE(off.mean, 1) << sampler;
    EXPECT_LE(off.variance, 1) << sampler;
    EXPECT_GT(off.mean, 0.1) << "the bound says something";
    EXPECT_EQ(images({"c.exr", "a.exr", "b.exr"}).pixels, of_images.pixels);
    // A part with 16 bits of its 24 is not within it, nor is one that weighs too little.
    change("a.exr", "coarse.exr", [](Image& one) {
      for (Rgbf& p : one.pixels)
        p.g = std::bit_cast<float>(std::bit_cast<std::uint32_t>(p.g) & ~255u);
    });
    EXPECT_GT(off_by(images({"coarse.exr", "b.exr", "c.exr"})).mean, 1) << sampler;
    change("a.exr", "light.exr", [](Image& one) {
      for (Rgbf& v : one.variance) v.b *= 0.999f;
    });
    EXPECT_GT(off_by(images({"light.exr", "b.exr", "c.exr"})).variance, 1) << sampler;
  }
}

TEST_F(Merging, OfAMergedImageIsThatOfItsParts) {
  render("a", "--spp 16");
  render("b", "--spp 16 --first-sample 16");
  render("c", "--spp 16 --seed 9 --shard 1/2");
  render("d", "--spp 32 --seed 9 --shard 2/2");
  write_exr(scratch_ / "ab.exr", images({"a.exr", "b.exr"}));
  const Image merged = images({"ab.exr", "c.exr", "d.exr"});
  EXPECT_EQ(merged.metadata.at("holds"), "0:0-16 0:16-32 9:0-16@1/2 9:0-32@2/2");
  EXPECT_EQ(merged.metadata.at("samples"), "48");
  EXPECT_EQ(merged.metadata.at("seed"), "0, 9");
  EXPECT_EQ(merged.metadata.at("scene"), "sphere_light");
  EXPECT_EQ(merged.count.at(0), 48);
  EXPECT_EQ(merged.count.at(1), 64);
  expect_refused(
      [&] {
        images({"ab.exr", "b.exr"});
      },
      "b.exr: holds samples of the seed 0 that " + (scratch_ / "ab.exr").string());
  expect_refused([&] { images({"c.exr"}); }, "93 of 187 pixels are in none of the images");
  // What checkpoints come to is merged with images.
  write_exr(scratch_ / "state.exr", checkpoints({"a", "b"}));
  EXPECT_EQ(images({"state.exr", "c.exr", "d.exr"}).count, merged.count);
}

/// The same samples twice say of a mean that it has half the variance that it has.
TEST_F(Merging, SamplesThatComeTwiceAreRefused) {
  render("a", "--spp 16 --seed 5");
  render("b", "--spp 16 --seed 5 --first-sample 8");
  const std::string why = "b.exr: holds samples of the seed 5 that";
  expect_refused([&] { images({"a.exr", "b.exr"}); }, why);
  expect_refused([&] { images({"a.exr", "a.exr"}); }, "a.exr: holds samples of the seed 5 that");
  expect_refused([&] { checkpoints({"a", "b"}); }, "b: holds samples of the seed 5 that");
  // What it would come to, were it not seen: a copy that says that it has another seed.
  change("a.exr", "copy.exr", [](Image& one) { one.metadata["holds"] = "6:0-16"; });
  const Image one = image("a.exr"), twice = images({"a.exr", "copy.exr"});
  for (std::size_t i = 0; i < one.pixels.size(); ++i) {
    EXPECT_EQ(twice.pixels[i].g, one.pixels[i].g);
    const double claimed = double{twice.variance[i].g} / double{twice.count[i]};
    const double right = double{one.variance[i].g} / double{one.count[i]};
    EXPECT_NEAR(claimed, right * 15 / 31, 1e-6 * right) << "2·15 v / 31 of 32 samples";
  }
}

TEST_F(Merging, OfPointsOfOneScrambleIsForCheckpointsAlone) {
  render("a", "--sampler sobol --spp 16");
  render("b", "--sampler sobol --spp 16 --first-sample 16");
  expect_refused(
      [&] {
        images({"a.exr", "b.exr"});
      },
      "b.exr: holds points of the scrambles of " + (scratch_ / "a.exr").string());
  EXPECT_EQ(checkpoints({"a", "b"}).count.at(0), 4) << "replicates of 8 points, not 8 of 4";
  render("c", "--sampler sobol --spp 16 --seed 1");
  EXPECT_EQ(images({"a.exr", "c.exr"}).count.at(0), 8) << "replicates of other scrambles";
  const auto refused = [&](const std::string& options, const std::string& why) {
    tests::expect_refused(scratch_.path(),
                          "render sphere_light --size 2x2 -o x.exr --first-sample " + options, why);
  };
  refused("24 --sampler sobol --spp 16",
          "--first-sample 24: cuts a net of Sobol points in two: write 16 or 32");
  refused("24 --sampler sobol --spp 12", "in each of 4 replicates: write --spp 8 or 16");
  refused("2147483647 --spp 2", "there are 2147483648 samples");
  refused("4 --allocation lu --spp 80 --max-depth 2", "it cannot begin later");
  refused("4 --seconds 1", "excludes");
}

TEST_F(Merging, OfOtherRendersIsRefusedWithWhatIsAnother) {
  render("a", "--spp 4");
  const std::map<std::string, std::string> others = {
      {"--strategy bsdf", "strategy: kept of bsdf, asked for mis"},
      {"--heuristic balance", "heuristic: kept of balance, asked for power=2"},
      {"--counts 2,1", "counts: kept of 2,1, asked for 1,1"},
      {"--sampler sobol", "sampler: kept of sobol, asked for independent"},
      {"--light-selection power", "light_selection: kept of power, asked for uniform"},
      {"--max-depth 1", "max_depth: kept of 1, asked for 2"},
      {"--roulette 2", "roulette_depth: kept of 2, asked for 5"},
      {"--accelerator embree", "accelerator: kept of embree, asked for brute_force"},
      {"-D radius=0.3", "scene_content: kept of "}};
  for (const auto& [options, why] : others) {
    render("other", "--spp 4 --seed 1 " + options);
    expect_refused([&] { images({"a.exr", "other.exr"}); }, why);
  }
  render("smaller", "--spp 4 --seed 1", "sphere_light --size 16x11");
  expect_refused([&] { images({"a.exr", "smaller.exr"}); }, "size: kept of 16x11, asked for 17x11");
  render("b", "--spp 4 --seed 1");
  const auto changed_refused = [&](const std::function<void(Image&)>& by, const std::string& why) {
    change("b.exr", "changed.exr", by);
    expect_refused([&] { images({"a.exr", "changed.exr"}); }, "changed.exr: " + why);
  };
  changed_refused([](Image& i) { i.metadata["version"] = "0.9"; },
                  "is of another render:\n  version: kept of 0.9");
  changed_refused([](Image& i) { i.metadata.erase("holds"); }, "its header does not say which");
  changed_refused([](Image& i) { i.metadata["holds"] = "all"; }, "its header's holds: \"all\"");
  changed_refused([](Image& i) { i.metadata["samples"] = "-1"; }, "its header has samples=-1");
  changed_refused([](Image& i) { i.variance.clear(); }, "has no layers of variance and count");
  for (const float count : {0.5f, -1.0f, 3e7f, std::nanf("")}) {
    changed_refused([&](Image& i) { i.count[3] = count; }, "has a pixel of ");
  }
  const Outcome mixed = run_plumbline(scratch_.path(), "merge a b.exr -o x.exr");
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_NE(mixed.err.find("a: is no OpenEXR image, as others are"), std::string::npos)
      << mixed.err;
  const Outcome merged = run_plumbline(scratch_.path(), "merge a.exr b.exr -o x.exr");
  EXPECT_EQ(merged.out, "x.exr: 8 samples per pixel of 2 parts, seed 0, 1\n") << merged.err;
}

}  // namespace
}  // namespace plumbline::tests
