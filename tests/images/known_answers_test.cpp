#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/renderer/scene/load_scene.h>
#include <plumbline/verify/agree.h>
#include <plumbline/verify/mean_check.h>
#include <plumbline_tests/support.h>
#include "path_samples.h"

/// Each scene with a closed form, rendered under each strategy: the bias of the image's mean is
/// proven small.
namespace plumbline::tests {
namespace {

using renderer::Heuristic;
using renderer::Scene;
using renderer::Strategy;

struct Case {
  const analytic::KnownScene* scene;
  Strategy strategy;
  Heuristic heuristic;

  std::string subject() const {
    std::string text(scene->name);
    text.append("/").append(name(strategy));
    if (uses_heuristic(strategy)) text.append("/").append(name(heuristic));
    return text;
  }
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const analytic::KnownScene& scene : analytic::known_scenes()) {
    for (const Strategy strategy : renderer::kStrategies) {
      for (const Heuristic heuristic : renderer::kHeuristics) {
        if (uses_heuristic(strategy) || heuristic == renderer::kHeuristics.front()) {
          cases.push_back({&scene, strategy, heuristic});
        }
      }
    }
  }
  return cases;
}

renderer::PathOptions path_options(const renderer::SceneDescription& description, Strategy strategy,
                                   Heuristic heuristic) {
  return {strategy, heuristic, description.integrator.max_depth, description.integrator.rr_depth};
}

double tolerance() { return nightly() ? 0.002 : 0.005; }

const analytic::Expectation& expectation(const Case& c) {
  for (const analytic::Expectation& e : c.scene->expectations) {
    if (analytic::to_string(e.strategy) == name(c.strategy)) return e;
  }
  throw std::logic_error("no expectation for " + c.subject());
}

class KnownAnswer : public testing::TestWithParam<Case> {};

TEST_P(KnownAnswer, BiasIsProvenSmall) {
  const Case& c = GetParam();
  const auto description = renderer::load_scene(analytic::scene_file(c.scene->name));
  const Scene scene(description);
  const bool decidable = expectation(c).verdict == analytic::Expected::pass;

  verify::MeanOptions options;
  options.subject = c.subject();
  options.reference = make_oracle(*c.scene)->image_mean().value;
  options.tolerance = tolerance();
  options.expected = decidable ? verify::Verdict::pass : verify::Verdict::inconclusive;
  options.seed = check_seed(options.subject);
  // A check that cannot decide would only burn the time up to its cap.
  options.max_samples = decidable ? std::uint64_t{1} << 28 : std::uint64_t{1} << 22;
  expect_verdict(check_mean(
      options,
      path_samples(scene, path_options(description, c.strategy, c.heuristic), options.seed)));
}

std::string test_name(const testing::TestParamInfo<Case>& info_of_case) {
  std::string text = info_of_case.param.subject();
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '/' || c == '-'; }, '_');
  return text;
}

INSTANTIATE_TEST_SUITE_P(Scenes, KnownAnswer, testing::ValuesIn(all_cases()), test_name);

/// The truncated furnace is the test of the path tracer's bookkeeping: every depth has its own
/// answer.
TEST(KnownAnswerAtDepth, FurnaceIsThePartialSumOfTheGeometricSeries) {
  const analytic::KnownScene& known = analytic::known_scene("furnace_sphere");
  const auto description = renderer::load_scene(analytic::scene_file(known.name));
  const Scene scene(description);
  for (int depth = 1; depth <= 5; ++depth) {
    for (const Strategy strategy : renderer::kStrategies) {
      verify::MeanOptions options;
      options.subject = "furnace_sphere/depth ";
      options.subject.append(std::to_string(depth)).append("/").append(name(strategy));
      options.reference = make_oracle(known, {}, std::nullopt, depth)->image_mean().value;
      options.tolerance = tolerance();
      options.seed = check_seed(options.subject);
      renderer::PathOptions path = path_options(description, strategy, Heuristic::power);
      path.max_depth = depth;
      expect_verdict(check_mean(options, path_samples(scene, path, options.seed)));
    }
  }
}

TEST(KnownAnswerControl, AnswerOffByOnePercentFails) {
  const analytic::KnownScene& known = analytic::known_scene("sphere_light");
  const auto description = renderer::load_scene(analytic::scene_file(known.name));
  const Scene scene(description);
  verify::MeanOptions options;
  options.subject = "control/sphere_light, answer off by 1 %";
  options.reference = 1.01 * make_oracle(known)->image_mean().value;
  options.tolerance = tolerance();
  options.expected = verify::Verdict::fail;
  options.seed = check_seed(options.subject);
  expect_verdict(check_mean(
      options, path_samples(scene, path_options(description, Strategy::mis, Heuristic::power),
                            options.seed)));
}

TEST(StrategiesAgree, LightOnlyBsdfOnlyAndMisHaveTheSameMean) {
  const auto description = renderer::load_scene(analytic::scene_file("sphere_light"));
  const Scene scene(description);
  const Strategy pairs[][2] = {{Strategy::light, Strategy::mis},
                               {Strategy::bsdf, Strategy::mis},
                               {Strategy::one_sample, Strategy::mis}};
  for (const auto& [a, b] : pairs) {
    verify::MeanOptions options;
    options.subject = "sphere_light/";
    options.subject.append(name(a)).append(" = ").append(name(b));
    options.tolerance = 0.01;
    options.max_samples = std::uint64_t{1} << 28;
    options.seed = check_seed(options.subject);
    expect_verdict(check_agreement(
        options,
        path_samples(scene, path_options(description, a, Heuristic::balance), options.seed),
        path_samples(scene, path_options(description, b, Heuristic::power), options.seed + 1)));
  }
}

}  // namespace
}  // namespace plumbline::tests
