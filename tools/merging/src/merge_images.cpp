#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/merging/merge.h>
#include <plumbline/output/checkpoint.h>

#include "parts.h"

namespace plumbline::merging {
namespace {

/// Counts beyond are rounded by a layer of floats.
constexpr float kMostCounted = 1 << 24;

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw renderer::InputError(fmt::format("{}: {}", file, why));
}

std::string text_of(const renderer::Image& image, const std::string& key) {
  const auto found = image.metadata.find(key);
  return found == image.metadata.end() ? std::string() : found->second;
}

std::uint64_t header_number(const std::string& file, const renderer::Image& image,
                            const std::string& key) {
  const std::string text = text_of(image, key);
  if (const auto number = whole_number(text)) return *number;
  refuse(file, fmt::format("its header has {}={:.40}, no whole number", key, text));
}

std::vector<SampleRange> ranges_of(const std::string& file, const renderer::Image& image) {
  const std::string text = text_of(image, "holds");
  if (text.empty()) {
    refuse(file, "its header does not say which samples it holds: render it again");
  }
  try {
    return parse_ranges(text);
  } catch (const renderer::InputError& error) {
    refuse(file, std::string("its header's holds: ") + error.what());
  }
}

/// All that another picture of the same thing has in common with it.
output::CheckpointSettings settings_of(const renderer::Image& image) {
  output::CheckpointSettings settings = {{"size", fmt::format("{}x{}", image.width, image.height)}};
  for (const HeaderName& name : kHeaderNames) {
    const std::string text = text_of(image, name.header);
    if (!text.empty()) settings[name.header] = text;
  }
  // What an allocation learns depends on how many samples there are.
  if (settings.contains("allocation")) settings["samples"] = text_of(image, "samples");
  return settings;
}

/// What has been put together so far.
class ImageSum {
 public:
  void add(const Part& part) {
    const renderer::Image image = renderer::read_exr(part.file);
    if (image.variance.empty() || image.count.empty()) {
      refuse(part.file, "has no layers of variance and count");
    }
    if (parts_.empty()) {
      settings_ = settings_of(image);
      metadata_ = image.metadata;
      film_ = renderer::Film(image.width, image.height);
      samples_.resize(film_.pixels().size());
    } else {
      output::require_same(part.file, settings_of(image), settings_);
      if (text_of(image, "scene") != metadata_["scene"]) metadata_.erase("scene");
    }
    for (const Part& other : parts_) require_other_samples(part, other);
    add_pixels(part, image);
    non_finite_ += header_number(part.file, image, "non_finite");
    parts_.push_back(part);
  }

  renderer::Image image() {
    require_samples(samples_, "images");
    const std::vector<SampleRange> ranges = all_ranges(parts_);
    for (const char* key : {"seconds", "stopped", "shard"}) metadata_.erase(key);
    metadata_["seed"] = seeds_of(ranges);
    metadata_["holds"] = to_text(ranges);
    metadata_["samples"] = least_samples(samples_);
    metadata_["merged"] = std::to_string(parts_.size());
    metadata_["non_finite"] = std::to_string(non_finite_);
    renderer::Image image = to_image(film_);
    image.metadata = std::move(metadata_);
    return image;
  }

 private:
  void require_other_samples(const Part& part, const Part& other) const {
    const bool nets = settings_.contains("sampler") && settings_.at("sampler") == "sobol";
    for (const SampleRange& a : part.holds) {
      for (const SampleRange& b : other.holds) {
        if (overlap(a, b)) {
          refuse(part.file,
                 fmt::format("holds samples of the seed {} that {} holds too", a.seed, other.file));
        }
        if (nets && a.seed == b.seed && share_pixels(a.shard, b.shard)) {
          refuse(
              part.file,
              fmt::format("holds points of the scrambles of {}, both of the seed {}: they depend "
                          "on each other, and images do not say how. Merge their checkpoints, "
                          "or render one with another --seed",
                          other.file, a.seed));
        }
      }
    }
  }

  void add_pixels(const Part& part, const renderer::Image& image) {
    const std::uint64_t samples = header_number(part.file, image, "samples");
    // What has been merged is whole.
    const Shard shard = part.holds.size() == 1 ? part.holds.front().shard : Shard{};
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const renderer::PixelMoments moments = moments_of(part.file, image, i);
      film_.pixels()[i].merge(moments);
      if (shard.has(i)) samples_[i] += std::max<std::uint64_t>(samples, moments.count > 0 ? 1 : 0);
    }
  }

  static renderer::PixelMoments moments_of(const std::string& file, const renderer::Image& image,
                                           std::size_t pixel) {
    const float count = image.count[pixel];
    if (!(count >= 0 && count <= kMostCounted && count == std::floor(count))) {
      refuse(file, fmt::format("has a pixel of {} samples: images count whole ones, up to {}. "
                               "Merge checkpoints",
                               count, kMostCounted));
    }
    renderer::PixelMoments moments;
    moments.count = static_cast<std::uint32_t>(count);
    if (moments.count == 0) return moments;
    moments.mean = renderer::rgb_cast<double>(image.pixels[pixel]);
    moments.sum_squares = renderer::rgb_cast<double>(image.variance[pixel]) * (moments.count - 1.0);
    return moments;
  }

  output::CheckpointSettings settings_;
  std::map<std::string, std::string> metadata_;
  std::vector<Part> parts_;
  renderer::Film film_{0, 0};
  std::vector<std::uint64_t> samples_;
  std::uint64_t non_finite_ = 0;
};

}  // namespace

renderer::Image merge_images(std::vector<std::string> files) {
  std::vector<Part> parts;
  for (std::string& file : files) {
    std::vector<SampleRange> ranges = ranges_of(file, renderer::read_exr(file));
    parts.push_back({std::move(file), std::move(ranges)});
  }
  sort_parts(parts);
  ImageSum sum;
  for (const Part& part : parts) sum.add(part);
  return sum.image();
}

}  // namespace plumbline::merging
