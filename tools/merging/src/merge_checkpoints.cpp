#include <algorithm>
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

constexpr const char* kSeed = "seed";
constexpr const char* kFirst = "first sample";

std::uint64_t setting_number(const std::string& file, const output::CheckpointSettings& settings,
                             const char* name) {
  const auto found = settings.find(name);
  if (const auto number = whole_number(found == settings.end() ? "" : found->second)) {
    return *number;
  }
  throw renderer::InputError(file + ": does not hold what it says");
}

/// The pixels that are here, which are those of one shard.
Shard shard_of(const std::vector<std::uint32_t>& drawn) {
  const auto first = std::find_if(drawn.begin(), drawn.end(), output::is_here);
  if (first == drawn.end()) return {};
  const auto next = std::find_if(first + 1, drawn.end(), output::is_here);
  const auto before = static_cast<std::uint32_t>(first - drawn.begin());
  if (next == drawn.end()) return {before + 1, static_cast<std::uint32_t>(drawn.size())};
  return {before + 1, static_cast<std::uint32_t>(next - first)};
}

/// What has been put together so far.
class CheckpointSum {
 public:
  void add(Part& part) {
    output::Checkpoint checkpoint = output::read_checkpoint(part.file);
    checkpoint.settings.erase(kSeed);
    checkpoint.settings.erase(kFirst);
    renderer::RenderState& state = checkpoint.state;
    if (parts_.empty()) {
      settings_ = std::move(checkpoint.settings);
      film_ = renderer::Film(state.width, state.height);
      samples_.resize(film_.pixels().size());
    } else {
      output::require_same(part.file, checkpoint.settings, settings_);
    }
    SampleRange& range = part.holds.front();
    if (parts_.empty() || parts_.back().holds.front().seed != range.seed) end_seed();
    if (state.drawn.size() != samples_.size() ||
        (!of_seed_.empty() && state.nets != of_nets_.nets)) {
      throw renderer::InputError(part.file + ": does not hold what it says");
    }
    require_other_samples(part, state.drawn);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (output::is_here(state.drawn[i])) samples_[i] += state.drawn[i];
    }
    range.end = range.first + output::most_drawn(state.drawn);
    range.shard = shard_of(state.drawn);
    of_seed_.push_back(std::move(state.drawn));
    parts_.push_back(part);
    add_moments(std::move(state));
  }

  renderer::Image image() {
    end_seed();
    require_samples(samples_, "checkpoints");
    renderer::Image image = to_image(film_);
    image.metadata = metadata();
    return image;
  }

 private:
  /// The same seed gives the same samples: those of one pixel count once.
  void require_other_samples(const Part& part, const std::vector<std::uint32_t>& drawn) const {
    const std::uint64_t first = part.holds.front().first;
    for (std::size_t k = 0; k < of_seed_.size(); ++k) {
      const Part& other = parts_[parts_.size() - of_seed_.size() + k];
      const std::uint64_t other_first = other.holds.front().first;
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        const std::uint32_t here = drawn[i], there = of_seed_[k][i];
        if (!output::is_here(here) || !output::is_here(there)) continue;
        if (first >= other_first + there || other_first >= first + here) continue;
        throw renderer::InputError(fmt::format("{}: holds samples of the seed {} that {} holds too",
                                               part.file, part.holds.front().seed, other.file));
      }
    }
  }

  /// Points of one scramble, whichever part has them, are one net: its mean is what says anything
  /// of the error.
  void add_moments(renderer::RenderState state) {
    if (state.nets > 0 && of_nets_.moments.empty()) {
      of_nets_ = std::move(state);
      return;
    }
    std::vector<renderer::PixelMoments>& sum = state.nets > 0 ? of_nets_.moments : film_.pixels();
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i].merge(state.moments[i]);
  }

  /// No more points of this seed will come.
  void end_seed() {
    const renderer::Film film = of_nets_.take_film();
    for (std::size_t i = 0; i < film.pixels().size(); ++i) {
      film_.pixels()[i].merge(film.pixels()[i]);
    }
    of_nets_ = {};
    of_seed_.clear();
  }

  std::map<std::string, std::string> metadata() const {
    const std::vector<SampleRange> ranges = all_ranges(parts_);
    std::map<std::string, std::string> data = {{"seed", seeds_of(ranges)},
                                               {"holds", to_text(ranges)},
                                               {"samples", least_samples(samples_)},
                                               {"merged", std::to_string(parts_.size())},
                                               {"non_finite", std::to_string(film_.non_finite())}};
    for (const HeaderName& name : kHeaderNames) {
      const auto found = settings_.find(name.setting);
      if (found != settings_.end()) data[name.header] = found->second;
    }
    return data;
  }

  output::CheckpointSettings settings_;
  std::vector<Part> parts_;
  renderer::Film film_{0, 0};
  std::vector<std::uint64_t> samples_;
  renderer::RenderState of_nets_;                    ///< of the seed that is under way
  std::vector<std::vector<std::uint32_t>> of_seed_;  ///< what its parts have drawn
};

}  // namespace

std::map<std::string, std::string> header_of(const output::CheckpointSettings& settings) {
  std::map<std::string, std::string> data;
  for (const HeaderName& name : kHeaderNames) {
    const auto found = settings.find(name.setting);
    if (!name.in_record && found != settings.end()) data[name.header] = found->second;
  }
  return data;
}

renderer::Image merge_checkpoints(std::vector<std::string> files) {
  std::vector<Part> parts;
  for (std::string& file : files) {
    const output::CheckpointSettings settings = output::read_checkpoint_settings(file);
    const SampleRange range{
        setting_number(file, settings, kSeed), setting_number(file, settings, kFirst), 0, {}};
    parts.push_back({std::move(file), {range}});
  }
  sort_parts(parts);
  CheckpointSum sum;
  for (Part& part : parts) sum.add(part);
  return sum.image();
}

}  // namespace plumbline::merging
