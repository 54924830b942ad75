#include <gtest/gtest.h>
#include <plumbline_tests/covering_array.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/names.h>
#include "both_backends.h"
#include "path_settings.h"

/// Two backends, one image, whatever the settings: three values of any three settings meet in some
/// row.
namespace plumbline::tests {
namespace {

using namespace renderer;

/// Every scene in which both backends round alike: diffuse, metal, glass, clear coat, mixtures and
/// Phong; in colour; rectangles, triangles, a point and the sky; one light, some that differ and a
/// thousand.
constexpr std::array kScenes{"tests/renderer/lamps",           "bench/scenes/cornell",
                             "analytic/scenes/lights_1000",    "analytic/scenes/furnace_cube",
                             "analytic/scenes/triangle_light", "analytic/scenes/point_glossy",
                             "analytic/scenes/sidewalk",       "analytic/scenes/phong_polygon"};
/// Each strategy; of MIS with one sample of each technique, which is the batched backend's own, and
/// with more.
constexpr std::array kTechniques{Techniques{Strategy::bsdf},      Techniques{Strategy::light},
                                 Techniques{Strategy::uniform},   Techniques{Strategy::mis},
                                 Techniques{Strategy::mis, 2, 3}, Techniques{Strategy::one_sample},
                                 Techniques{Strategy::average}};

enum Setting : std::size_t {
  kScene,
  kTechnique,
  kWeighting,
  kDepth,
  kRoulette,
  kSampler,
  kSelection
};

/// Paths of unlimited depth without roulette are refused.
Settings all_settings() {
  return {{kScenes.size(), kTechniques.size(), kWeightings.size(), kDepths.size(),
           kRouletteDepths.size(), kSamplers.size(), kLightSelections.size()},
          {{{kDepth, 3}, {kRoulette, 2}}}};
}

RenderOptions options_of(const SettingsRow& row) {
  RenderOptions options;
  options.samples_per_pixel = kSmallSamples;
  options.path = path_options(kTechniques.at(row[kTechnique]), kWeightings.at(row[kWeighting]),
                              kDepths.at(row[kDepth]), kRouletteDepths.at(row[kRoulette]));
  options.sampler = kSamplers.at(row[kSampler]);
  return options;
}

/// What repeats one row by hand.
std::string commands(const SettingsRow& row) {
  const RenderOptions options = options_of(row);
  const PathOptions& path = options.path;
  const auto render_by = [&](Backend backend) {
    std::string text = "plumbline render ";
    text.append(kScenes.at(row[kScene])).append(".xml -o ").append(name(backend)).append(".exr");
    text.append(" --backend ").append(name(backend));
    text.append(" --strategy ").append(name(path.strategy));
    if (uses_heuristic(path.strategy)) text.append(" --heuristic " + describe(path.heuristic));
    if (path.strategy == Strategy::mis) {
      text.append(" --counts " + std::to_string(path.bsdf_samples) + "," +
                  std::to_string(path.light_samples));
    }
    text.append(" --max-depth " + std::to_string(path.max_depth) + " --roulette ");
    text.append(path.rr_depth == kNoRoulette ? "off" : std::to_string(path.rr_depth));
    text.append(" --sampler ").append(name(options.sampler));
    if (options.sampler == SamplerType::sobol) text.append(" --replicates 1");
    text.append(" --light-selection ").append(name(kLightSelections.at(row[kSelection])));
    text.append(" --spp " + std::to_string(kSmallSamples) + " --size " +
                std::to_string(kSmallWidth) + "x" + std::to_string(kSmallHeight));
    return text;
  };
  return render_by(Backend::scalar) + " && " + render_by(Backend::batched) +
         " && plumbline compare scalar.exr batched.exr --exact";
}

/// Scenes that are asked for more than once, with their lights chosen in each way.
class SceneCache {
 public:
  const Scene& get(std::size_t scene, std::size_t selection) {
    std::unique_ptr<const Scene>& entry = scenes_[{scene, selection}];
    if (!entry) {
      SceneDescription description = small(kScenes.at(scene));
      description.light_selection = kLightSelections.at(selection);
      entry = std::make_unique<const Scene>(make_scene(description));
    }
    return *entry;
  }

 private:
  std::map<std::pair<std::size_t, std::size_t>, std::unique_ptr<const Scene>> scenes_;
};

/// "strategy mis, heuristic power=1.5": settings by the words of the command line.
std::string words(const Combination& combination) {
  std::string text;
  for (const SettingValue& v : combination) {
    text += text.empty() ? "" : ", ";
    switch (v.setting) {
      case kScene:
        text.append("scene ").append(kScenes.at(v.value));
        break;
      case kTechnique: {
        const Techniques& t = kTechniques.at(v.value);
        text.append("strategy ").append(name(t.strategy));
        text.append(" --counts " + std::to_string(t.bsdf) + "," + std::to_string(t.light));
        break;
      }
      case kWeighting:
        text.append("heuristic ").append(describe(kWeightings.at(v.value)));
        break;
      case kDepth:
        text.append("max-depth " + std::to_string(kDepths.at(v.value)));
        break;
      case kRoulette:
        text.append("roulette " + std::to_string(kRouletteDepths.at(v.value)));
        break;
      case kSampler:
        text.append("sampler ").append(name(kSamplers.at(v.value)));
        break;
      default:
        text.append("light-selection ").append(name(kLightSelections.at(v.value)));
    }
  }
  return text;
}

/// Where to look: what all rows that differ have in common, and how many that have it agree.
std::string where_to_look(const std::vector<SettingsRow>& rows,
                          const std::vector<SettingsRow>& differing) {
  std::string text = std::to_string(differing.size()) + " of " + std::to_string(rows.size()) +
                     " rows of settings differ between the scalar and the batched backend";
  const Combination shared = shared_by(differing);
  if (shared.empty())
    return text + ": of every setting at least two values, so look at what all paths do";
  const auto with = std::count_if(rows.begin(), rows.end(),
                                  [&](const SettingsRow& row) { return has(row, shared); });
  return text + ", all with " + words(shared) + "; of the " + std::to_string(with) +
         " rows with that the others agree";
}

TEST(BackendSettings, AnyThreeGiveTheSameBitsOnFlatSurfaces) {
  SceneCache scenes;
  const std::vector<SettingsRow> rows = covering_array(all_settings(), 3);
  ASSERT_EQ(uncovered(all_settings(), 3, rows), std::vector<Combination>{});
  std::vector<SettingsRow> differing;
  for (const SettingsRow& row : rows) {
    const Pair pair = render_both(scenes.get(row[kScene], row[kSelection]), options_of(row));
    EXPECT_EQ(pair.batched.counters.camera_rays, kSmallSamples * kSmallWidth * kSmallHeight);
    if (!same_bits(pair)) differing.push_back(row);
  }
  EXPECT_TRUE(differing.empty()) << where_to_look(rows, differing) << "\nthe first:\n"
                                 << commands(differing.front());
}

TEST(BackendSettings, ThatDifferAreNamedByWhatTheyShare) {
  const std::vector<SettingsRow> rows = covering_array(all_settings(), 3);
  const auto rows_with = [&](Setting setting, std::size_t value) {
    std::vector<SettingsRow> with;
    for (const SettingsRow& row : rows) {
      if (row[setting] == value) with.push_back(row);
    }
    return with;
  };
  const auto power = rows_with(kWeighting, 2);
  EXPECT_NE(
      where_to_look(rows, power)
          .find("all with heuristic power=1.5; of the " + std::to_string(power.size()) + " rows"),
      std::string::npos)
      << where_to_look(rows, power);
  EXPECT_NE(where_to_look(rows, rows).find("look at what all paths do"), std::string::npos);
}

/// A loop of its own is for one exponent, not for its neighbours.
TEST(BackendSettings, AnyParameterOfAHeuristicGivesTheSameBits) {
  SceneCache scenes;
  const std::vector<Weighting> weightings{{Heuristic::power, 0.5f}, {Heuristic::power, 1},
                                          {Heuristic::power, 3},    {Heuristic::power, 4},
                                          {Heuristic::cutoff, 0},   {Heuristic::cutoff, 0.5f},
                                          {Heuristic::cutoff, 1}};
  for (const Weighting& weighting : weightings) {
    SCOPED_TRACE(describe(weighting));
    RenderOptions options;
    options.samples_per_pixel = kSmallSamples;
    options.path = path_options({Strategy::mis}, weighting, 5, kNoRoulette);
    expect_same_bits(render_both(scenes.get(0, 0), options));
  }
}

TEST(BackendSettings, EachIsSeenInTheImage) {
  SceneCache scenes;
  // Lamps that differ; roulette from depth 3 on.
  const SettingsRow base{0, 3, 0, 2, 1, 0, 0};
  for (std::size_t setting = kTechnique; setting < base.size(); ++setting) {
    SettingsRow row = base;
    const auto image = [&] {
      return render_both(scenes.get(row[kScene], row[kSelection]), options_of(row));
    };
    Pair pair = image();
    const std::size_t values = all_settings().value_counts[setting];
    for (std::size_t other = 0; other < values; ++other) {
      if (other == base[setting]) continue;
      row[setting] = other;
      pair.batched = image().batched;
      EXPECT_GT(differing_pixels(pair), 0u) << commands(row);
    }
  }
}

TEST(BackendSettings, AnAllocationOfSamplesDoesNotAskWhichBackend) {
  SceneCache scenes;
  for (const Allocation policy : kAllocations) {
    for (std::size_t selection = 0; selection < kLightSelections.size(); ++selection) {
      SCOPED_TRACE(
          std::string(name(policy)).append(", ").append(name(kLightSelections.at(selection))));
      RenderOptions options;
      options.samples_per_pixel = kSmallSamples;
      options.path.max_depth = 2;
      options.allocation = AllocationOptions{.policy = policy, .iterations = 4, .cost_ratio = 2};
      const Pair pair = render_both(scenes.get(0, selection), options);
      expect_same_bits(pair);
      ASSERT_EQ(pair.scalar.bsdf_counts.size(), 4u * kSmallWidth * kSmallHeight);
      EXPECT_EQ(pair.scalar.bsdf_counts, pair.batched.bsdf_counts);
    }
  }
}

}  // namespace
}  // namespace plumbline::tests
