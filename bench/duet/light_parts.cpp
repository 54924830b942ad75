#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/light/light.h>
#include <plumbline/renderer/core/sampling/sampler.h>

#include "parts.h"
#include "shading_parts.h"

namespace plumbline::duet {
namespace {

using namespace renderer;

const Rgbf kWhite{1, 1, 1};

Light by_solid_angle() {
  RectangleLight light{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}, {0, 0, -1}, kWhite};
  light.by_solid_angle = true;
  return light;
}

/// Noise, so that the choice of a pixel takes as long as an outdoor map's.
Light noise_map() {
  Pcg32 random(2, 0, 0);
  std::vector<Rgbf> pixels(std::size_t{512} * 256);
  for (Rgbf& pixel : pixels) pixel = kWhite * random.next_1d();
  return EnvironmentMap{std::make_shared<EnvironmentTable>(512, 256, std::move(pixels), false)};
}

/// Chooses among them, then a direction, then asks its density.
Counters sample_lights(const LightSet& lights, const Inputs& inputs) {
  Counters counters;
  for (const Vec2f& u : inputs.u) {
    const auto s = lights.sample(Vec3f{}, u);
    if (!s) continue;
    const float density = lights.pdf_at_hit(0, Vec3f{}, s->wi);
    counters.result = with_bits(counters.result, static_cast<double>(s->wi.x + density));
  }
  return counters;
}

Part light_part(const std::string& name, std::function<std::vector<Light>()> make) {
  return {"light/" + name, [make = std::move(make)](Size size) -> Work {
            return [lights = std::make_shared<LightSet>(make()), inputs = Inputs(size)] {
              return sample_lights(*lights, inputs);
            };
          }};
}

/// Paths' worth of pairs of numbers.
Counters draw_numbers(SamplerType type, Size size) {
  const std::uint64_t paths = size == Size::timed ? 128 : 8;
  constexpr int kPairs = 16;
  Counters counters;
  for (std::uint64_t path = 0; path < paths; ++path) {
    Sampler random(type, 1, 0, path);
    float sum = 0;
    for (int i = 0; i < kPairs; ++i) {
      const Vec2f u = random.next_2d();
      sum += u.x + u.y;
    }
    counters.result = with_bits(counters.result, static_cast<double>(sum));
  }
  return counters;
}

Part sampler_part(const std::string& name, SamplerType type) {
  return {"sampler/" + name,
          [type](Size size) -> Work { return [type, size] { return draw_numbers(type, size); }; }};
}

std::vector<Part> make_light_parts() {
  return {light_part("sphere",
                     [] {
                       return std::vector<Light>{SphereLight{{0, 0, 2}, 0.5f, false, kWhite}};
                     }),
          light_part("rectangle", [] { return std::vector<Light>{by_solid_angle()}; }),
          light_part("environment_map", [] { return std::vector<Light>{noise_map()}; }),
          light_part("thousand",
                     [] {
                       const Light sphere = SphereLight{{0, 0, 2}, 0.5f, false, kWhite};
                       return std::vector<Light>(1000, sphere);
                     }),
          sampler_part("independent", SamplerType::independent),
          sampler_part("sobol", SamplerType::sobol)};
}

}  // namespace

std::span<const Part> light_parts() {
  static const std::vector<Part> parts = make_light_parts();
  return parts;
}

}  // namespace plumbline::duet
