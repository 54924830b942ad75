#include "ways.h"

#include <algorithm>
#include <variant>

#include <plumbline/renderer/assembly/names.h>

namespace plumbline::tests {
namespace {

using renderer::Heuristic;
using renderer::LightSelection;
using renderer::PathOptions;
using renderer::SamplerType;
using renderer::Strategy;
using renderer::Weighting;
using Roulette = Way::Roulette;

PathOptions single(Strategy strategy) {
  PathOptions path;
  path.strategy = strategy;
  return path;
}

PathOptions mis(const Weighting& weighting, int bsdf, int light) {
  PathOptions path;
  path.heuristic = weighting;
  path.bsdf_samples = bsdf;
  path.light_samples = light;
  return path;
}

PathOptions one_sample(const Weighting& weighting, float light_probability) {
  PathOptions path = single(Strategy::one_sample);
  path.heuristic = weighting;
  path.light_probability = light_probability;
  return path;
}

}  // namespace

std::string Way::name() const {
  std::string text(renderer::name(path.strategy));
  if (path.strategy == Strategy::mis) {
    text.append(" ").append(std::to_string(path.bsdf_samples));
    text.append(",").append(std::to_string(path.light_samples));
  }
  if (path.strategy == Strategy::one_sample) {
    text.append(" ").append(path.light_probability == 0.5f ? "half" : "fifth");
  }
  if (uses_heuristic(path.strategy)) text.append(" ").append(describe(path.heuristic));
  if (sampler != SamplerType::independent) text.append(" ").append(renderer::name(sampler));
  if (roulette == Roulette::early) text.append(" early-roulette");
  if (roulette == Roulette::off) text.append(" no-roulette");
  if (selection != LightSelection::uniform) {
    text.append(" select-").append(renderer::name(selection));
  }
  if (by_solid_angle) text.append(" solid-angle");
  if (backend == renderer::Backend::scalar) text.append(" scalar");
  return text;
}

bool Way::is_batched() const {
  if (backend == renderer::Backend::scalar) return false;
  return path.strategy == Strategy::bsdf || path.strategy == Strategy::light ||
         (path.strategy == Strategy::mis && path.bsdf_samples == 1 && path.light_samples == 1);
}

PathOptions Way::options(const renderer::IntegratorDescription& integrator) const {
  PathOptions result = path;
  result.max_depth = integrator.max_depth;
  result.rr_depth = integrator.rr_depth;
  if (roulette == Roulette::early) result.rr_depth = 1;
  if (roulette == Roulette::off && integrator.max_depth >= 0) {
    result.rr_depth = renderer::kNoRoulette;
  }
  return result;
}

renderer::SceneDescription Way::description(renderer::SceneDescription scene) const {
  scene.light_selection = selection;
  for (renderer::ShapeDescription& shape : scene.shapes) {
    const bool can = std::holds_alternative<renderer::RectangleShape>(shape.geometry) ||
                     std::holds_alternative<renderer::MeshShape>(shape.geometry);
    shape.light_by_solid_angle = by_solid_angle && can;
  }
  return scene;
}

// The strategies that are noisy by themselves take the sampler that is not, and no roulette early
// on. Independent samples, which take up to four times as many, go through each backend once.
std::vector<Way> covering_ways() {
  return {
      {single(Strategy::bsdf), SamplerType::sobol, Roulette::off},
      {single(Strategy::light), SamplerType::sobol, Roulette::scene},
      {single(Strategy::uniform), SamplerType::sobol, Roulette::scene},
      {mis(Heuristic::power, 1, 1), SamplerType::independent, Roulette::off,
       LightSelection::uniform, true},
      {mis(Heuristic::balance, 1, 4), SamplerType::sobol, Roulette::early, LightSelection::area},
      {mis({Heuristic::power, 1.5}, 4, 1), SamplerType::sobol, Roulette::scene,
       LightSelection::power},
      {mis(Heuristic::cutoff, 2, 2), SamplerType::sobol, Roulette::scene},
      {mis(Heuristic::maximum, 1, 1), SamplerType::sobol, Roulette::scene},
      {one_sample(Heuristic::power, 0.5f), SamplerType::sobol, Roulette::scene},
      {one_sample(Heuristic::cutoff, 0.2f), SamplerType::sobol, Roulette::scene},
      {single(Strategy::average), SamplerType::independent, Roulette::scene}};
}

Weighting other_heuristic(const Way& way) {
  const Weighting& own = way.path.heuristic;
  return own.heuristic == Heuristic::power ? Heuristic::balance : Heuristic::power;
}

std::vector<Way> without_one_option(const Way& way) {
  std::vector<Way> ways;
  const auto add = [&](const auto& change) {
    Way other = way;
    change(other);
    if (other.name() != way.name()) ways.push_back(other);
  };
  if (way.is_batched()) add([](Way& w) { w.backend = renderer::Backend::scalar; });
  add([](Way& w) { w.sampler = SamplerType::independent; });
  add([](Way& w) { w.selection = LightSelection::uniform; });
  add([](Way& w) { w.by_solid_angle = false; });
  add([](Way& w) { w.roulette = Roulette::scene; });
  add([](Way& w) { w.path.bsdf_samples = 1; });
  add([](Way& w) { w.path.light_samples = 1; });
  add([](Way& w) { w.path.heuristic = other_heuristic(w); });
  return ways;
}

std::vector<Way> representative_ways() {
  return {{single(Strategy::light), SamplerType::independent, Roulette::scene},
          {mis(Heuristic::power, 1, 1), SamplerType::sobol, Roulette::scene},
          {one_sample(Heuristic::balance, 0.5f), SamplerType::independent, Roulette::early}};
}

std::vector<Way> all_ways() {
  std::vector<PathOptions> paths = {single(Strategy::bsdf), single(Strategy::light),
                                    single(Strategy::uniform), single(Strategy::average)};
  for (const Heuristic heuristic : renderer::kHeuristics) {
    paths.push_back(mis(heuristic, 1, 1));
    paths.push_back(one_sample(heuristic, 0.5f));
  }
  std::vector<Way> ways = covering_ways();
  for (const LightSelection selection : renderer::kLightSelections) {
    for (const bool by_solid_angle : {false, true}) {
      ways.push_back({mis(Heuristic::power, 1, 1), SamplerType::independent, Roulette::scene,
                      selection, by_solid_angle});
    }
  }
  for (const PathOptions& path : paths) {
    for (const SamplerType sampler : renderer::kSamplers) {
      const Way way{path, sampler, Roulette::scene};
      const bool covered = std::any_of(ways.begin(), ways.end(),
                                       [&](const Way& w) { return w.name() == way.name(); });
      if (!covered) ways.push_back(way);
    }
  }
  return ways;
}

}  // namespace plumbline::tests
