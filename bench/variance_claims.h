#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <plumbline/renderer/assembly/names.h>
#include <plumbline/reports/results.h>
#include "statistics.h"

namespace plumbline::bench {

/// What RayON's page on MIS claims of it, measured on a scene of each kind that its table names:
/// variance of MIS against BSDF sampling and against light sampling, at equal samples and at equal
/// time, rays per path, cost of a path. Every claim gets a verdict.
///
/// @source RayON, "Multiple Importance Sampling": tables "Expected variance reduction" and
///         "Performance cost"
void measure_variance_claims(reports::ResultLog& log, bool full);

/// From … to, both included; infinity where a side is open.
struct Range {
  double low, high;
};

/// A scene with the range that the page claims for variance(BSDF-only)/variance(MIS) on its kind.
struct ClaimScene {
  std::string name, title;
  std::map<std::string, std::string> parameters;  ///< of the scene file
  std::string claim;                              ///< as the page has it; empty: it gives no number
  Range claimed{0, 0};                            ///< where `claim` is not empty
  bool specular = false;                          ///< all surfaces: no light sample is ever drawn
};
const std::vector<ClaimScene>& claim_scenes();

/// The strategies compared, in the order in which the figures of a scene stand.
inline constexpr std::array kClaimStrategies{renderer::Strategy::bsdf, renderer::Strategy::light,
                                             renderer::Strategy::mis};

/// One strategy on one scene: a number per replicate of each quantity.
struct StrategyRuns {
  std::vector<double> variance;           ///< of one sample, mean over the pixels
  std::vector<double> relative_variance;  ///< the same of variance/(μ² + 0.01)
  std::vector<double> seconds;            ///< CPU time of the replicate on its one thread
  std::vector<double> rays;               ///< per path
  std::vector<double> shadow_rays;        ///< per path
  std::vector<double> fireflies;  ///< pixels brighter than the truth by the image's mean and more
};

struct SceneRuns {
  ClaimScene scene;
  std::array<StrategyRuns, kClaimStrategies.size()> strategies;

  const StrategyRuns& bsdf() const { return strategies[0]; }
  const StrategyRuns& light() const { return strategies[1]; }
  const StrategyRuns& mis() const { return strategies[2]; }
};

/// Tables and verdicts of all scenes.
void report_variance_claims(reports::ResultLog& log, const std::vector<SceneRuns>& runs);

}  // namespace plumbline::bench
