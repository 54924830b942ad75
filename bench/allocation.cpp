#include "allocation.h"

#include <fmt/core.h>

#include <plumbline/renderer/scene_file/load_scene.h>
#include "scenes.h"

namespace plumbline::bench {

const std::array<AllocationScene, 2>& allocation_scenes() {
  static const std::array<AllocationScene, 2> scenes = {
      AllocationScene{
          "veach_phong", "Veach's order", "Exponents 10000, 5000, 1000, 500 from the back", {}},
      AllocationScene{"veach_phong_reversed",
                      "Reversed order",
                      "Exponents 500, 1000, 5000, 10000 from the back",
                      {{"exponent_1", "500"},
                       {"exponent_2", "1000"},
                       {"exponent_3", "5000"},
                       {"exponent_4", "10000"}}}};
  return scenes;
}

renderer::SceneDescription load(const AllocationScene& scene, const AllocationWork& work) {
  return renderer::load_scene(scene_path("veach_phong"), scene.parameters,
                              renderer::FilmSize{work.width, work.height});
}

void measure_allocation(reports::ResultLog& log, const std::filesystem::path& results, bool full) {
  fmt::print("sample allocation: Veach's plates with Phong lobes\n");
  std::filesystem::remove_all(results / "allocation");
  AllocationWork work;
  if (full) {
    work = {.width = 200,
            .height = 150,
            .full_size = true,
            .replicates = 3,
            .references = 5,
            .lu_renders = 7,
            .anchor_renders = 20,
            .reference_samples = 2048,
            .cost_repetitions = 15};
  }
  for (const AllocationScene& scene : allocation_scenes()) {
    if (!full && !scene.parameters.empty()) continue;
    const Estimate cost_ratio = measure_cost_ratio(scene, work);
    const AllocationResults measured =
        run_allocation(scene, work, cost_ratio.value, results / "allocation");
    report_allocation(log, scene, measured, work);
    report_costs(log, scene, measured, cost_ratio,
                 measure_policy_costs(scene, work, cost_ratio.value), work);
  }
}

}  // namespace plumbline::bench
