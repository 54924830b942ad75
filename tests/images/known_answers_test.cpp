#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/scene_file/load_scene.h>
#include <plumbline/verify/mean.h>
#include <plumbline_tests/support.h>
#include "colour_check.h"
#include "likely_part.h"
#include "path_samples.h"
#include "ways.h"

/// Each scene with a closed form, rendered in every way: the verdict that its table expects, which
/// for most is a proof that the image's mean is not biased.
namespace plumbline::tests {
namespace {

using renderer::Scene;
using renderer::Strategy;

struct Case {
  const analytic::KnownScene* scene;
  const analytic::Variant* variant;  // nullptr: the default parameters
  Way way;

  std::string subject() const {
    std::string text(scene->name);
    if (variant) text.append(" ").append(variant->name);
    return text.append("/").append(way.name());
  }
};

/// A scene with the parameters of one variant: what all its ways share.
struct SceneCase {
  const analytic::KnownScene* scene;
  const analytic::Variant* variant;  // nullptr: the default parameters

  /// In the gate a covering set of ways for each scene and a smaller one for its variants; at night
  /// all ways, and the covering set for variants.
  std::vector<Way> ways() const {
    if (variant) return nightly() ? covering_ways() : representative_ways();
    return nightly() ? all_ways() : covering_ways();
  }
};

std::vector<SceneCase> all_cases() {
  std::vector<SceneCase> cases;
  for (const analytic::KnownScene& scene : analytic::known_scenes()) {
    cases.push_back({&scene, nullptr});
    for (const analytic::Variant& variant : scene.variants) cases.push_back({&scene, &variant});
  }
  return cases;
}

/// The two strategies that are there to be beaten need several times the samples of all others
/// together: in the gate they are held to less.
double tolerance(Strategy strategy) {
  if (nightly()) return 0.002;
  return strategy == Strategy::uniform || strategy == Strategy::average ? 0.01 : 0.005;
}

/// Where the answer is 0 the tolerance is absolute: in units of the radiance of the scenes' lights,
/// which is about 1.
constexpr double kAbsoluteTolerance = 1e-4;

/// A scene file, with a scene for each way in which lights are sampled.
class LoadedScene {
 public:
  LoadedScene(const analytic::KnownScene& known, const analytic::Variant* variant) {
    std::map<std::string, std::string> definitions;
    if (variant) {
      for (const auto& [name, value] : variant->parameters) {
        definitions.emplace(name, to_text(value));
      }
    }
    description_ = renderer::load_scene(analytic::scene_file(known.name), definitions);
  }

  ColourSampler samples(const Way& way, std::uint64_t seed,
                        std::optional<int> max_depth = std::nullopt) {
    renderer::PathOptions path = way.options(description_.integrator);
    if (max_depth) path.max_depth = *max_depth;
    return path_samples(scene(way), path, seed, way.sampler, way.backend);
  }

  int max_depth() const { return description_.integrator.max_depth; }

  verify::MomentSampler luminances(const Way& way, std::uint64_t seed) {
    return luminance_samples(scene(way), way.options(description_.integrator), seed, way.sampler);
  }

 private:
  const Scene& scene(const Way& way) {
    const auto key = std::pair(way.selection, way.by_solid_angle);
    auto found = scenes_.find(key);
    if (found == scenes_.end()) {
      found =
          scenes_.try_emplace(key, renderer::make_scene(one_pixel(way.description(description_))))
              .first;
    }
    return found->second;
  }

  renderer::SceneDescription description_;
  std::map<std::pair<renderer::LightSelection, bool>, Scene> scenes_;
};

const analytic::Expectation& expectation(const Case& c) {
  for (const analytic::Strategy strategy : analytic::kStrategies) {
    if (analytic::to_string(strategy) == name(c.way.path.strategy)) {
      return c.scene->expectation(strategy, c.variant);
    }
  }
  throw std::logic_error("no expectation for " + c.subject());
}

analytic::Expected expected_verdict(const Case& c) { return expectation(c).verdict; }

verify::Verdict to_verify(analytic::Expected expected) {
  if (expected == analytic::Expected::pass) return verify::Verdict::pass;
  if (expected == analytic::Expected::fail) return verify::Verdict::fail;
  return verify::Verdict::inconclusive;
}

/// What is dark or blind shows zeros, which pass from 20,000 samples on and fail from 2^20 on, be
/// they paths or nets of paths.
bool shows_zeros(const Case& c, const analytic::Colour& answer) {
  const bool dark = answer.r == 0 && answer.g == 0 && answer.b == 0;
  return dark || expected_verdict(c) == analytic::Expected::fail;
}

using ChannelOptions = std::array<verify::MeanOptions, 3>;

ChannelOptions mean_options(const std::string& subject, const analytic::Colour& answer,
                            Strategy strategy) {
  verify::MeanOptions options;
  options.subject = subject;
  options.seed = check_seed(subject);
  options.max_samples = std::uint64_t{1} << 30;
  ChannelOptions result = for_each_channel(options, answer);
  for (verify::MeanOptions& channel : result) {
    channel.relative = channel.reference != 0;
    channel.tolerance = channel.relative ? tolerance(strategy) : kAbsoluteTolerance;
  }
  return result;
}

/// Holds each channel of all that a way renders against its answer.
void expect_channels(const ChannelOptions& options, const ColourSampler& sampler) {
  for (const verify::CheckResult& result : check_channels(options, sampler)) {
    expect_verdict(result);
  }
}

/// What the check of one way may lean on, and how long it may take where it cannot decide.
///
/// @param variance  of one independent sample of the channel, 0 where it is not known
void set_expectation(verify::MeanOptions& options, const Case& c, double variance) {
  const analytic::Expected expected = expected_verdict(c);
  options.expected = to_verify(expected);
  if (expected == analytic::Expected::infinite_variance) {
    options.exact_variance = std::numeric_limits<double>::infinity();
  } else if (variance > 0 && c.way.sampler == renderer::SamplerType::independent) {
    options.exact_variance = variance;
  }
  // A check that cannot decide would only burn the time up to its cap.
  if (options.expected == verify::Verdict::inconclusive) {
    options.max_samples =
        c.way.sampler == renderer::SamplerType::sobol ? (1 << 20) / kNetSize : 1 << 20;
  }
}

using ChannelResults = std::array<verify::CheckResult, 3>;

/// @param max_depth  −1: paths keep their roulette, whatever the way says (Way::options)
WayVerdict verdict_of_way(Way way, int max_depth, const ChannelResults& results) {
  if (max_depth < 0 && way.roulette == Way::Roulette::off) way.roulette = Way::Roulette::scene;
  return {way, {verdict_of(results[0]), verdict_of(results[1]), verdict_of(results[2])}};
}

/// The verdict of a way that is asked again; undecided, which says nothing, after four million
/// paths.
WayVerdict ask_way(LoadedScene& loaded, const Way& way, const std::string& subject,
                   const analytic::Colour& answer, std::optional<int> max_depth = std::nullopt) {
  auto options = mean_options("again/" + subject, answer, way.path.strategy);
  const bool nets = way.sampler == renderer::SamplerType::sobol;
  for (verify::MeanOptions& channel : options) {
    channel.max_samples = (1 << 22) / (nets ? kNetSize : 1);
  }
  return verdict_of_way(way, max_depth.value_or(loaded.max_depth()),
                        check_channels(options, loaded.samples(way, options[0].seed, max_depth)));
}

/// Three vertices more than the depth at which scenes begin roulette.
constexpr int kDeepestAsked = 8;

/// The first depth at which a way is wrong; empty where no depth is, or the closed form is of one
/// depth only.
std::optional<int> first_wrong_depth(const SceneCase& scene, LoadedScene& loaded, const Way& way) {
  if (loaded.max_depth() == 2) return std::nullopt;
  const auto parameters = scene.variant ? scene.variant->parameters : analytic::ParameterValues{};
  for (int depth = 1; depth <= kDeepestAsked; ++depth) {
    try {
      const auto oracle = make_oracle(*scene.scene, parameters, std::nullopt, depth);
      const analytic::Colour answer = oracle->image_mean().value;
      const WayVerdict seen = ask_way(loaded, way, "depth", answer, depth);
      if (!seen.right()) return seen.wrong() ? std::optional(depth) : std::nullopt;
    } catch (const std::invalid_argument&) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

/// The verdicts that are in, with those of all covering ways that can be decided, of what fails
/// without one option at a time, and of depths. Only a scene that has failed is asked for all this.
SceneVerdicts asked_again(const SceneCase& scene, LoadedScene& loaded,
                          const analytic::Colour& answer, std::vector<WayVerdict> ways) {
  const auto ask = [&](const Way& way) {
    const bool known = std::any_of(ways.begin(), ways.end(), [&](const WayVerdict& seen) {
      return seen.way.name() == way.name();
    });
    const Case c{scene.scene, scene.variant, way};
    if (known || expected_verdict(c) != analytic::Expected::pass) return;
    ways.push_back(ask_way(loaded, way, c.subject(), answer));
  };
  for (const Way& way : covering_ways()) ask(way);
  for (const Way& way : ways_to_ask(ways)) ask(way);
  const auto wrong =
      std::find_if(ways.begin(), ways.end(), [](const WayVerdict& seen) { return seen.wrong(); });
  const auto depth = first_wrong_depth(scene, loaded, wrong->way);
  return {std::move(ways), loaded.max_depth() == 2, depth};
}

/// The part that all ways of a scene together say is wrong; empty where they say none, or none
/// fails.
std::string diagnosis_of(const SceneCase& scene, LoadedScene& loaded,
                         const analytic::Colour& answer, std::vector<WayVerdict> ways) {
  const bool failed =
      std::any_of(ways.begin(), ways.end(), [](const WayVerdict& seen) { return seen.wrong(); });
  if (!failed) return {};
  const std::string part = likely_part(asked_again(scene, loaded, answer, std::move(ways)));
  return part.empty() ? part : "likely wrong, as all ways of the scene together show: " + part;
}

class KnownAnswer : public testing::TestWithParam<SceneCase> {};

TEST_P(KnownAnswer, GivesTheExpectedVerdictInEveryWay) {
  const auto& [known, variant] = GetParam();
  LoadedScene loaded(*known, variant);
  const analytic::Colour answer =
      make_oracle(*known, variant ? variant->parameters : analytic::ParameterValues{})
          ->image_mean()
          .value;
  std::vector<ChannelResults> results;
  std::vector<renderer::Strategy> strategies;
  std::vector<WayVerdict> decidable;
  for (Way way : GetParam().ways()) {
    if (shows_zeros({known, variant, way}, answer)) {
      way.sampler = renderer::SamplerType::independent;
    }
    const Case c{known, variant, way};
    ChannelOptions options = mean_options(c.subject(), answer, way.path.strategy);
    for (std::size_t i = 0; i < options.size(); ++i) {
      set_expectation(options[i], c, expectation(c).variance.*kChannels[i].exact);
    }
    results.push_back(check_channels(options, loaded.samples(way, options[0].seed)));
    strategies.push_back(way.path.strategy);
    if (expected_verdict(c) == analytic::Expected::pass) {
      decidable.push_back(verdict_of_way(way, loaded.max_depth(), results.back()));
    }
  }
  const std::string diagnosis = diagnosis_of(GetParam(), loaded, answer, std::move(decidable));
  for (std::size_t way = 0; way < results.size(); ++way) {
    for (verify::CheckResult result : results[way]) {
      if (!result.as_expected()) {
        const bool sees = result.verdict == verify::Verdict::pass;
        result.diagnosis = diagnosis.empty() && sees ? part_that_sees(strategies[way]) : diagnosis;
      }
      expect_verdict(result);
    }
  }
}

std::string test_name(const testing::TestParamInfo<SceneCase>& info_of_case) {
  std::string text(info_of_case.param.scene->name);
  if (info_of_case.param.variant) text.append("_").append(info_of_case.param.variant->name);
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return text;
}

INSTANTIATE_TEST_SUITE_P(Scenes, KnownAnswer, testing::ValuesIn(all_cases()), test_name);

/// Truncated paths are the test of the path tracer's bookkeeping: every depth has its own answer.
class KnownAnswerAtDepth : public testing::TestWithParam<const char*> {};

TEST_P(KnownAnswerAtDepth, IsThePartialSumOfTheSeries) {
  const analytic::KnownScene& known = analytic::known_scene(GetParam());
  LoadedScene loaded(known, nullptr);
  int checked = 0;
  for (int depth = 1; depth <= 5; ++depth) {
    const analytic::Colour answer = make_oracle(known, {}, std::nullopt, depth)->image_mean().value;
    for (Way way : covering_ways()) {
      const Case c{&known, nullptr, way};
      if (expected_verdict(c) != analytic::Expected::pass) continue;
      if (shows_zeros(c, answer)) way.sampler = renderer::SamplerType::independent;
      std::string subject(known.name);
      subject.append(" depth ").append(std::to_string(depth)).append("/").append(way.name());
      const auto options = mean_options(subject, answer, way.path.strategy);
      expect_channels(options, loaded.samples(way, options[0].seed, depth));
      ++checked;
    }
  }
  EXPECT_GE(checked, 5 * 9);  // of eleven ways light alone and the average may be wrong
}

INSTANTIATE_TEST_SUITE_P(Scenes, KnownAnswerAtDepth,
                         testing::Values("furnace_sphere", "integrating_sphere"),
                         [](const auto& scene) { return std::string(scene.param); });

/// A technique that is asked for no samples gives no weight to the other's.
TEST(KnownAnswerWithCounts, OfZeroIsTheOtherTechniqueAlone) {
  const analytic::KnownScene& known = analytic::known_scene("sphere_light");
  LoadedScene loaded(known, nullptr);
  for (const auto& [bsdf, light] : {std::pair{0, 2}, {2, 0}}) {
    const Way way{.path = {.bsdf_samples = bsdf, .light_samples = light},
                  .sampler = renderer::SamplerType::sobol};
    const auto options = mean_options("sphere_light/" + way.name(),
                                      make_oracle(known)->image_mean().value, way.path.strategy);
    expect_channels(options, loaded.samples(way, options[0].seed));
  }
}

TEST(KnownAnswerControl, AnswerOffByOnePercentInOneChannelFailsInThatChannel) {
  const analytic::KnownScene& known = analytic::known_scene("sphere_light");
  LoadedScene loaded(known, nullptr);
  analytic::Colour wrong = make_oracle(known)->image_mean().value;
  wrong.b *= 1.01;
  auto options = mean_options("control/sphere_light, blue answer off by 1 %", wrong, Strategy::mis);
  options[2].expected = verify::Verdict::fail;
  const Way mis;
  expect_channels(options, loaded.samples(mis, options[0].seed));
}

/// Two strategies of every scene against each other, without its closed form; at night all pairs.
/// In luminance: the closed form holds each of them in every channel.
TEST(StrategiesAgree, PairByPair) {
  using Pair = std::pair<Strategy, Strategy>;
  std::vector<Pair> pairs = {{Strategy::mis, Strategy::one_sample}};
  if (nightly()) {
    for (const Strategy a : renderer::kStrategies) {
      for (const Strategy b : renderer::kStrategies) {
        if (a < b && Pair(a, b) != pairs.front()) pairs.emplace_back(a, b);
      }
    }
  }
  std::size_t compared = 0;
  for (const analytic::KnownScene& known : analytic::known_scenes()) {
    LoadedScene loaded(known, nullptr);
    for (const auto& [a, b] : pairs) {
      const auto sobol = renderer::SamplerType::sobol;
      const Way one{.path = {.strategy = a, .heuristic = renderer::Heuristic::balance},
                    .sampler = sobol};
      const Way other{.path = {.strategy = b}, .sampler = sobol};
      const auto decidable = [&](const Way& way) {
        return expected_verdict({&known, nullptr, way}) == analytic::Expected::pass;
      };
      if (!decidable(one) || !decidable(other)) continue;
      verify::MeanOptions options;
      options.subject = known.name;
      options.subject.append("/").append(name(a)).append(" = ").append(name(b));
      options.tolerance = 0.01;
      options.max_samples = std::uint64_t{1} << 30;
      options.seed = check_seed(options.subject);
      expect_verdict(check_agreement(options, loaded.luminances(one, options.seed),
                                     loaded.luminances(other, options.seed + 1)));
      ++compared;
    }
  }
  EXPECT_GE(compared, analytic::known_scenes().size());  // the first pair is right in every scene
}

}  // namespace
}  // namespace plumbline::tests
