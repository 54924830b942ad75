#include "likely_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

/// What is named, and that nothing is named on evidence that does not suffice: verdicts are made
/// up.
namespace plumbline::tests {
namespace {

using renderer::Backend;
using renderer::Heuristic;
using renderer::LightSelection;
using renderer::SamplerType;
using renderer::Strategy;
using verify::Verdict;

/// All covering ways of a scene, wrong where the fault says so, all channels by one factor.
SceneVerdicts verdicts(const std::function<bool(const Way&)>& fault, double factor = 1.3) {
  SceneVerdicts scene;
  for (const Way& way : covering_ways()) {
    const ChannelVerdict right{Verdict::pass, verify::Interval{0.997, 1.002}};
    const ChannelVerdict wrong{Verdict::fail, verify::Interval{0.99 * factor, 1.01 * factor}};
    const ChannelVerdict& channel = fault(way) ? wrong : right;
    scene.ways.push_back({way, {channel, channel, channel}});
  }
  return scene;
}

/// The same with the ways that fail traced once more by the scalar backend.
SceneVerdicts with_scalar(SceneVerdicts scene, Verdict there) {
  for (const WayVerdict& seen : std::vector<WayVerdict>(scene.ways)) {
    if (!seen.wrong() || !seen.way.is_batched()) continue;
    WayVerdict again = seen;
    again.way.backend = Backend::scalar;
    for (ChannelVerdict& channel : again.channels) channel.verdict = there;
    scene.ways.push_back(again);
  }
  return scene;
}

bool starts(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }
bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool is(const Way& way, Strategy strategy) { return way.path.strategy == strategy; }
bool combined(const Way& way) { return is(way, Strategy::mis) || is(way, Strategy::one_sample); }

/// The same with what else there is to ask.
SceneVerdicts asked_again(SceneVerdicts scene, const std::function<bool(const Way&)>& fault) {
  for (const Way& way : ways_to_ask(scene.ways)) {
    WayVerdict other = scene.ways.front();
    other.way = way;
    for (ChannelVerdict& channel : other.channels) {
      channel.verdict = fault(way) ? Verdict::fail : Verdict::pass;
    }
    scene.ways.push_back(other);
  }
  return scene;
}

std::string part_of(const std::function<bool(const Way&)>& fault) {
  return likely_part(asked_again(verdicts(fault), fault));
}

TEST(LikelyPart, IsNothingWhereNothingIsWrong) {
  EXPECT_EQ(likely_part(verdicts([](const Way&) { return false; })), "");
  EXPECT_EQ(likely_part({}), "");
}

TEST(LikelyPart, IsTheTechniqueThatIsWrongAlone) {
  const auto light = verdicts([](const Way& w) { return is(w, Strategy::light) || combined(w); });
  EXPECT_TRUE(starts(likely_part(light), "the light samples")) << likely_part(light);
  const auto bsdf = verdicts([](const Way& w) { return is(w, Strategy::bsdf) || combined(w); });
  EXPECT_TRUE(starts(likely_part(bsdf), "the BSDF's samples")) << likely_part(bsdf);
  const auto uniform = verdicts([](const Way& w) { return is(w, Strategy::uniform); });
  EXPECT_TRUE(starts(likely_part(uniform), "the uniform samples")) << likely_part(uniform);
  const auto value = verdicts([](const Way& w) { return !is(w, Strategy::bsdf); });
  EXPECT_TRUE(starts(likely_part(value), "the BSDF's value")) << likely_part(value);
}

TEST(LikelyPart, IsTheWeightsWhereEachTechniqueAloneIsRight) {
  EXPECT_TRUE(starts(likely_part(verdicts(combined)), "the MIS weights"));
  const auto one = verdicts([](const Way& w) { return is(w, Strategy::one_sample); });
  EXPECT_TRUE(starts(likely_part(one), "one-sample MIS")) << likely_part(one);
  const std::string several =
      part_of([](const Way& w) { return is(w, Strategy::mis) && w.path.light_samples > 1; });
  EXPECT_TRUE(starts(several, "the weights of several light samples")) << several;
  const std::string power = part_of(
      [](const Way& w) { return combined(w) && w.path.heuristic.heuristic == Heuristic::power; });
  EXPECT_TRUE(starts(power, "the heuristic power")) << power;
}

TEST(LikelyPart, IsTheOptionThatAllFailingWaysShare) {
  const std::string sobol = part_of([](const Way& w) { return w.sampler == SamplerType::sobol; });
  EXPECT_TRUE(starts(sobol, "the Sobol points")) << sobol;
  const std::string angle = part_of([](const Way& w) { return w.by_solid_angle; });
  EXPECT_TRUE(starts(angle, "points on lights by solid angle")) << angle;
  const std::string area =
      part_of([](const Way& w) { return w.selection == LightSelection::area; });
  EXPECT_TRUE(starts(area, "the choice of lights by area")) << area;
  const std::string early =
      part_of([](const Way& w) { return w.roulette == Way::Roulette::early; });
  EXPECT_TRUE(starts(early, "Russian roulette")) << early;
}

/// Without the same way without the option there is no telling: the one way that chooses lights by
/// area has early roulette and several light samples too.
TEST(LikelyPart, IsNoOptionThatIsNotShown) {
  const auto area = [](const Way& w) { return w.selection == LightSelection::area; };
  const std::string part = likely_part(verdicts(area));
  EXPECT_FALSE(starts(part, "the choice")) << part;
  EXPECT_FALSE(starts(part, "Russian")) << part;
}

TEST(LikelyPart, IsNotNamedWhereNoneExplainsIt) {
  const auto odd = verdicts([](const Way& w) {
    return is(w, Strategy::uniform) || (is(w, Strategy::mis) && w.path.bsdf_samples == 4);
  });
  EXPECT_EQ(likely_part(odd), "");
}

TEST(LikelyPart, IsTheBatchedBackendWhereTheScalarOneIsRight) {
  const auto light =
      verdicts([](const Way& w) { return w.is_batched() && !is(w, Strategy::bsdf); });
  const std::string alone = likely_part(with_scalar(light, Verdict::pass));
  EXPECT_TRUE(starts(alone, "the batched backend")) << alone;
  // It does not trace the uniform samples, which tell a light sample from the BSDF's value.
  EXPECT_FALSE(contains(alone, "there")) << alone;
  EXPECT_FALSE(contains(likely_part(with_scalar(light, Verdict::fail)), "batched"));
}

TEST(LikelyPart, OfAllWaysIsToldByTheDepth) {
  auto all = verdicts([](const Way&) { return true; });
  EXPECT_TRUE(starts(likely_part(all), "what all ways share"));
  all.first_wrong_depth = 1;
  EXPECT_TRUE(contains(likely_part(all), "film"));
  all.first_wrong_depth = 4;
  EXPECT_TRUE(contains(likely_part(all),
                       "bookkeeping of paths, or roulette: all ways are right up to depth 3"));
}

TEST(LikelyPart, IsNotWhatAllWaysShareWhereAllOfThemSampleLights) {
  SceneVerdicts scene = verdicts([](const Way&) { return true; });
  scene.ways.erase(std::remove_if(scene.ways.begin(), scene.ways.end(),
                                  [](const WayVerdict& w) {
                                    return is(w.way, Strategy::bsdf) ||
                                           is(w.way, Strategy::uniform);
                                  }),
                   scene.ways.end());
  EXPECT_EQ(likely_part(scene), "");
}

TEST(LikelyPart, NamesAConstantOnlyIfItAloneIsWithinTheRatiosOfAll) {
  const auto light = [](const Way& w) { return is(w, Strategy::light); };
  EXPECT_TRUE(contains(likely_part(verdicts(light, 2)), "a factor of 2 (1.98 to 2.02)"));
  EXPECT_FALSE(contains(likely_part(verdicts(light, 1.9)), "a factor"));
  auto vague = verdicts(light, 2);
  for (WayVerdict& way : vague.ways) {
    for (ChannelVerdict& c : way.channels) {
      if (c.verdict == Verdict::fail) c.ratio = verify::Interval{1.5, 4.5};
    }
  }
  EXPECT_FALSE(contains(likely_part(vague), "a factor"));
}

TEST(LikelyPart, NamesTheChannelsThatAreWrongAlone) {
  auto scene = verdicts([](const Way& w) { return is(w, Strategy::light); });
  EXPECT_FALSE(contains(likely_part(scene), "alone;"));
  for (WayVerdict& way : scene.ways) way.channels[0].verdict = Verdict::pass;
  EXPECT_TRUE(contains(likely_part(scene), "; in green and blue alone")) << likely_part(scene);
}

TEST(LikelyPart, IsTheScalarBackendWhereItAloneIsWrong) {
  // What the batched one leaves to it, several samples and one-sample MIS, is wrong too.
  const auto part = part_of([](const Way& w) { return !w.is_batched(); });
  EXPECT_TRUE(starts(part, "the scalar backend")) << part;
}

TEST(LikelyPart, OfABlindWayThatSeesIsWhatMakesItBlind) {
  EXPECT_NE(part_that_sees(renderer::Strategy::average).find("the weights"), std::string::npos);
  EXPECT_NE(part_that_sees(renderer::Strategy::bsdf).find("which lights"), std::string::npos);
}

}  // namespace
}  // namespace plumbline::tests
