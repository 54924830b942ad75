#pragma once

#include <array>

#include <plumbline/renderer/assembly/render.h>

/// Settings of paths, of which tests cross all with all others.
namespace plumbline::tests {

/// Each with a loop of its own in the batched backend, or with the one for all others.
inline const std::array kWeightings{renderer::Weighting(renderer::Heuristic::balance),
                                    renderer::Weighting(renderer::Heuristic::power),
                                    renderer::Weighting(renderer::Heuristic::power, 1.5),
                                    renderer::Weighting(renderer::Heuristic::cutoff),
                                    renderer::Weighting(renderer::Heuristic::maximum)};
inline constexpr std::array kDepths{1, 2, 5, -1};
inline constexpr std::array kRouletteDepths{1, 3, renderer::kNoRoulette};

struct Techniques {
  renderer::Strategy strategy;
  int bsdf = 1, light = 1;  // samples at the first vertex
};

inline renderer::PathOptions path_options(const Techniques& techniques,
                                          const renderer::Weighting& weighting, int max_depth,
                                          int rr_depth) {
  renderer::PathOptions path;
  path.strategy = techniques.strategy;
  path.bsdf_samples = techniques.bsdf;
  path.light_samples = techniques.light;
  path.heuristic = weighting;
  path.max_depth = max_depth;
  path.rr_depth = rr_depth;
  return path;
}

}  // namespace plumbline::tests
