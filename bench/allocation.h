#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/reports/results.h>
#include "allocation_bias.h"
#include "allocation_reference.h"
#include "statistics.h"

namespace plumbline::bench {

/// Sample allocation on Veach's plates with Phong lobes, in Veach's order and reversed: efficiency
/// of every policy from the exact variances at the shares that it visits, error against samples per
/// pixel, maps of the shares, cost per sample. Figures and tables go into the log, maps as EXR into
/// `results`/allocation.
void measure_allocation(reports::ResultLog& log, const std::filesystem::path& results, bool full);

inline constexpr std::size_t kIterations = 20;

/// The plates' scene with the exponents of one order.
struct AllocationScene {
  std::string name, title, exponents;
  std::map<std::string, std::string> parameters;
};
const std::array<AllocationScene, 2>& allocation_scenes();

struct AllocationWork {
  int width = 40, height = 30;
  bool full_size = false;              ///< as the bars ask
  int replicates = 3, references = 3;  ///< as many or more: what renders are checked against
  /// Of `lu` and `root-nodes`, for the bias; of the others `replicates`.
  int lu_renders = 3, anchor_renders = 3;
  std::uint32_t reference_samples = 1024;  ///< per pixel and reference
  int cost_width = 16, cost_height = 12;   ///< of the image that times are taken on
  int cost_repetitions = 3;
};

/// Shares visited by a method, in units of 1/50: `kIterations` of them for each pixel, side by
/// side.
using Shares = std::vector<std::uint8_t>;

/// Sums over the image of the error that is left when all samples are drawn.
struct ImageError {
  double mse = 0;      ///< mean variance
  double mean_sd = 0;  ///< mean standard deviation
  double rel_mse = 0;  ///< mean of variance/(μ² + 0.01)
};

/// Which variance stands for the error.
enum class VarianceOf {
  counts,          ///< the counts drawn, balance heuristic: what the renderer does
  mixture,         ///< the random mixture: what the policies minimise
  optimal_weights  ///< the counts drawn, optimal weights
};

/// One method in one replicate.
struct MethodRun {
  std::string method;
  ImageError counts, mixture;
  std::vector<double> rmse;  ///< after each iteration, by counts
  double bsdf_share = 0;     ///< of all samples
};

/// Cost of one sample on one thread.
struct PolicyCost {
  std::string method;
  Estimate ratio;         ///< CPU time per sample over that of `equal`, interleaved repetitions
  double bsdf_share = 0;  ///< of its samples
};

struct AllocationResults {
  std::vector<std::vector<MethodRun>> replicates;
  std::vector<RenderCheck> checks;
};

/// Renders with every policy, replicate by replicate, and sums up the errors at the shares visited.
///
/// @param maps  directory for the EXRs of the shares in the first replicate
AllocationResults run_allocation(const AllocationScene& scene, const AllocationWork& work,
                                 double cost_ratio, const std::filesystem::path& maps);

/// Time of a BSDF sample over that of a light sample, on one thread.
Estimate measure_cost_ratio(const AllocationScene& scene, const AllocationWork& work);

std::vector<PolicyCost> measure_policy_costs(const AllocationScene& scene,
                                             const AllocationWork& work, double cost_ratio);

void report_allocation(reports::ResultLog& log, const AllocationScene& scene,
                       const AllocationResults& results, const AllocationWork& work);
void report_costs(reports::ResultLog& log, const AllocationScene& scene,
                  const AllocationResults& results, const Estimate& cost_ratio,
                  const std::vector<PolicyCost>& costs, const AllocationWork& work);

renderer::SceneDescription load(const AllocationScene& scene, const AllocationWork& work);

}  // namespace plumbline::bench
