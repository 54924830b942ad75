#include <plumbline_tests/covering_array.h>
#include <plumbline_tests/support.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <variant>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/scene_file/load_scene.h>

#include "../renderer/path_settings.h"

/// Prints a hash of each picture of a covering array of settings, by both backends, on every scene
/// there is: a fault in the renderer that leaves all of them as they are changes no picture.
namespace plumbline::tests {
namespace {

using namespace renderer;

constexpr std::array kScenes{"tests/renderer/lamps",
                             "bench/scenes/cornell",
                             "bench/scenes/mixed",
                             "bench/scenes/interior",
                             "bench/scenes/mirror_glass",
                             "bench/scenes/outdoor",
                             "bench/scenes/veach",
                             "bench/scenes/veach_phong",
                             "analytic/scenes/edge_shadow",
                             "analytic/scenes/furnace_blend",
                             "analytic/scenes/furnace_coat",
                             "analytic/scenes/furnace_metal",
                             "analytic/scenes/furnace_mirror",
                             "analytic/scenes/furnace_open",
                             "analytic/scenes/furnace_rough_glass",
                             "analytic/scenes/furnace_sphere",
                             "analytic/scenes/furnace_two_sided",
                             "analytic/scenes/glass_film",
                             "analytic/scenes/glass_inside",
                             "analytic/scenes/glass_sphere",
                             "analytic/scenes/integrating_sphere",
                             "analytic/scenes/lights_1000",
                             "analytic/scenes/lights_overlap",
                             "analytic/scenes/phong_polygon",
                             "analytic/scenes/point_glossy",
                             "analytic/scenes/rectangle_light",
                             "analytic/scenes/scaled_moved",
                             "analytic/scenes/sidewalk",
                             "analytic/scenes/sphere_inside",
                             "analytic/scenes/sphere_light",
                             "analytic/scenes/sphere_near",
                             "analytic/scenes/thin_gap",
                             "analytic/scenes/triangle_light"};
constexpr std::array kTechniques{Techniques{Strategy::bsdf},      Techniques{Strategy::light},
                                 Techniques{Strategy::uniform},   Techniques{Strategy::mis},
                                 Techniques{Strategy::mis, 2, 3}, Techniques{Strategy::mis, 1, 0},
                                 Techniques{Strategy::mis, 0, 2}, Techniques{Strategy::one_sample},
                                 Techniques{Strategy::average}};
constexpr std::array<std::uint32_t, 2> kReplicates{1, 4};
constexpr std::array kBackends{Backend::scalar, Backend::batched};

enum Setting : std::size_t {
  kScene,
  kTechnique,
  kWeighting,
  kDepth,
  kRoulette,
  kSampler,
  kSelection,
  kReplicate,
  kSolidAngle,
  kBackend
};

Settings all_settings() {
  return {{kScenes.size(), kTechniques.size(), kWeightings.size(), kDepths.size(),
           kRouletteDepths.size(), kSamplers.size(), kLightSelections.size(), kReplicates.size(), 2,
           kBackends.size()},
          {{{kDepth, 3}, {kRoulette, 2}}}};
}

class Hash {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3u;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

std::uint64_t picture(const SettingsRow& row) {
  SceneDescription scene = load_scene(source_file(std::string(kScenes.at(row[kScene])) + ".xml"));
  scene.camera.width = 12;
  scene.camera.height = 9;
  scene.light_selection = kLightSelections.at(row[kSelection]);
  for (ShapeDescription& shape : scene.shapes) {
    const bool can = std::holds_alternative<RectangleShape>(shape.geometry) ||
                     std::holds_alternative<MeshShape>(shape.geometry);
    shape.light_by_solid_angle = row[kSolidAngle] == 1 && can;
  }
  RenderOptions options;
  options.samples_per_pixel = 16;
  options.threads = 1;
  options.path = path_options(kTechniques.at(row[kTechnique]), kWeightings.at(row[kWeighting]),
                              kDepths.at(row[kDepth]), kRouletteDepths.at(row[kRoulette]));
  options.sampler = kSamplers.at(row[kSampler]);
  if (options.sampler == SamplerType::sobol) options.replicates = kReplicates.at(row[kReplicate]);
  options.backend = kBackends.at(row[kBackend]);
  const RenderResult result = render(make_scene(scene), options);
  Hash hash;
  const auto& pixels = result.film.pixels();
  hash.add(pixels.data(), pixels.size() * sizeof pixels[0]);
  const PathCounters& c = result.counters;
  for (const std::uint64_t count : {c.camera_rays, c.bounce_rays, c.shadow_rays, c.rejected}) {
    hash.add(&count, sizeof count);
  }
  return hash.value();
}

}  // namespace
}  // namespace plumbline::tests

int main() {
  using namespace plumbline::tests;
  for (const SettingsRow& row : covering_array(all_settings(), 2)) {
    std::string text;
    try {
      text = std::to_string(picture(row));
    } catch (const std::exception& error) {
      text = error.what();
    }
    std::puts(text.c_str());
  }
}
