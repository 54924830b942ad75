#pragma once

#include <string>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/render/path.h>

namespace plumbline::tests {

/// One way to render a scene: strategy, heuristic, counts or probability, sampler, roulette, choice
/// of the light, choice of the point on it, backend.
struct Way {
  enum class Roulette { scene, early, off };

  renderer::PathOptions path;
  renderer::SamplerType sampler = renderer::SamplerType::independent;
  Roulette roulette = Roulette::scene;
  renderer::LightSelection selection = renderer::LightSelection::uniform;
  bool by_solid_angle = false;  ///< rectangles and meshes; the scenes' own is by area

  renderer::Backend backend = renderer::Backend::batched;

  /// Whether the batched backend traces it: it is asked to, and knows the strategy.
  bool is_batched() const;

  /// "mis 1,4 power=2 sobol no-roulette": what differs from the usual is named.
  std::string name() const;

  /// For a scene: its depth, and its roulette where the way has none of its own. Paths of unlimited
  /// depth keep theirs, or they would not end.
  renderer::PathOptions options(const renderer::IntegratorDescription& integrator) const;

  /// The scene with the lights sampled in this way.
  renderer::SceneDescription description(renderer::SceneDescription scene) const;
};

/// The way without one of its options at a time, by which that option can be told to be wrong: by
/// the scalar backend, with independent samples, lights chosen alike, by area, with
/// the roulette of the scene.
/// One of each technique, and another heuristic, are options too.
std::vector<Way> without_one_option(const Way& way);

/// Power with the exponent 2, or balance where that is the way's.
renderer::Weighting other_heuristic(const Way& way);

/// Each value of each option at least once.
std::vector<Way> covering_ways();

/// A few that differ most, for variants of a scene.
std::vector<Way> representative_ways();

/// Every strategy with every heuristic that it uses and every sampler, and the covering ways.
std::vector<Way> all_ways();

}  // namespace plumbline::tests
