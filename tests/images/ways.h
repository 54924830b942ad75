#pragma once

#include <string>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/core/render/path.h>

namespace plumbline::tests {

/// One way to render a scene: strategy, heuristic, counts or probability, sampler, roulette, choice
/// of the light, choice of the point on it.
struct Way {
  enum class Roulette { scene, early, off };

  renderer::PathOptions path;
  renderer::SamplerType sampler = renderer::SamplerType::independent;
  Roulette roulette = Roulette::scene;
  renderer::LightSelection selection = renderer::LightSelection::uniform;
  bool by_solid_angle = false;  ///< rectangles and meshes; the scenes' own is by area

  /// "mis 1,4 power=2 sobol no-roulette": what differs from the usual is named.
  std::string name() const;

  /// For a scene: its depth, and its roulette where the way has none of its own. Paths of unlimited
  /// depth keep theirs, or they would not end.
  renderer::PathOptions options(const renderer::IntegratorDescription& integrator) const;

  /// The scene with the lights sampled in this way.
  renderer::SceneDescription description(renderer::SceneDescription scene) const;
};

/// Each value of each option at least once.
std::vector<Way> covering_ways();

/// A few that differ most, for variants of a scene.
std::vector<Way> representative_ways();

/// Every strategy with every heuristic that it uses and every sampler, and the covering ways.
std::vector<Way> all_ways();

}  // namespace plumbline::tests
