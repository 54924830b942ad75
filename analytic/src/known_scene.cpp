#include <plumbline/analytic/known_scene.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "floor_oracle.h"
#include "scenes.h"

namespace plumbline::analytic {

std::string_view to_string(Strategy strategy) {
  switch (strategy) {
    case Strategy::bsdf:
      return "bsdf";
    case Strategy::light:
      return "light";
    case Strategy::uniform:
      return "uniform";
    case Strategy::mis:
      return "mis";
    case Strategy::one_sample:
      return "one-sample";
    case Strategy::average:
      return "average";
  }
  return "?";
}

const Expectation& KnownScene::expectation(Strategy strategy, const Variant* variant) const {
  if (variant) {
    for (const Expectation& exception : variant->exceptions) {
      if (exception.strategy == strategy) return exception;
    }
  }
  for (const Expectation& expectation : expectations) {
    if (expectation.strategy == strategy) return expectation;
  }
  throw std::logic_error("a known scene without an expectation for a strategy");
}

std::vector<Expectation> expect_pass_from_all() { return expect_pass_but_for({}); }

std::vector<Expectation> expect_pass_but_for(std::vector<Expectation> exceptions) {
  for (const Strategy strategy : kStrategies) {
    const bool listed = std::any_of(exceptions.begin(), exceptions.end(),
                                    [&](const auto& e) { return e.strategy == strategy; });
    if (!listed) exceptions.push_back({strategy, Expected::pass, {}});
  }
  return exceptions;
}

Colour colour(const OracleInput& input, std::string_view name) {
  return input.parameters.find(name)->second;
}

double parameter(const OracleInput& input, std::string_view name) {
  const Colour value = colour(input, name);
  if (!value.is_grey()) throw std::invalid_argument(std::string(name) + " must be one number");
  return value.g;
}

KnownScene floor_scene(std::string_view name, std::string_view answer,
                       std::unique_ptr<PixelOracle> (*make)(const OracleInput&)) {
  KnownScene scene;
  scene.name = name;
  scene.answer = answer;
  scene.film = {64, 48};
  scene.max_depth = 2;
  scene.expectations = expect_pass_from_all();
  scene.make = make;
  return scene;
}

Parameter light_radiance(const Colour& value) {
  return {"radiance", value, "Le of the light [rgb, W/(m² sr)], not negative"};
}

Parameter floor_albedo(const Colour& value) {
  return {"albedo", value, "reflectance of the floor [rgb], 0 to 1"};
}

bool counts_reflected(const OracleInput& input) {
  return input.max_depth == -1 || input.max_depth >= 2;
}

Colour reflectance(const OracleInput& input, std::string_view name) {
  const Colour value = colour(input, name);
  require(in_every_channel([](double x) { return x >= 0 && x <= 1; }, value),
          "a reflectance must be in [0, 1]");
  return value;
}

Colour emitted(const OracleInput& input, std::string_view name) {
  const Colour value = colour(input, name);
  require(in_every_channel(
              [](double x) { return x >= 0 && x <= std::numeric_limits<double>::max(); }, value),
          "what a light emits must be finite and not negative");
  return value;
}

Colour albedo_over_pi(const OracleInput& input) {
  const Colour albedo = reflectance(input, "albedo");
  return counts_reflected(input) ? albedo / std::numbers::pi : Colour();
}

Colour reflected_radiance(const OracleInput& input) {
  return albedo_over_pi(input) * emitted(input, "radiance");
}

const std::vector<KnownScene>& known_scenes() {
  static const std::vector<KnownScene> scenes = [] {
    std::vector<KnownScene> all;
    for (const auto& family : {furnace_scenes(), sphere_scenes(), polygon_scenes(), shadow_scenes(),
                               bsdf_scenes(), sun_scenes()}) {
      all.insert(all.end(), family.begin(), family.end());
    }
    std::sort(all.begin(), all.end(),
              [](const KnownScene& a, const KnownScene& b) { return a.name < b.name; });
    return all;
  }();
  return scenes;
}

const KnownScene* find_known_scene(std::string_view name) {
  for (const KnownScene& scene : known_scenes()) {
    if (scene.name == name) return &scene;
  }
  return nullptr;
}

const KnownScene& known_scene(std::string_view name) {
  if (const KnownScene* scene = find_known_scene(name)) return *scene;
  std::string message = "no known scene '";
  message.append(name).append("'; there are:");
  for (const KnownScene& scene : known_scenes()) message.append(" ").append(scene.name);
  throw std::invalid_argument(message);
}

std::filesystem::path scene_file(std::string_view name) {
  return std::filesystem::path(PLUMBLINE_ANALYTIC_SCENES) /
         (std::string(known_scene(name).name) + ".xml");
}

ParameterValues in_grey(const KnownScene& scene) {
  ParameterValues values;
  for (const Parameter& parameter : scene.parameters) {
    values.emplace(parameter.name, parameter.value.g);
  }
  return values;
}

std::unique_ptr<PixelOracle> make_oracle(const KnownScene& scene, const ParameterValues& overrides,
                                         std::optional<FilmSize> film,
                                         std::optional<int> max_depth) {
  OracleInput input;
  for (const Parameter& parameter : scene.parameters) {
    input.parameters.emplace(parameter.name, parameter.value);
  }
  for (const auto& [name, value] : overrides) {
    const auto found = input.parameters.find(name);
    if (found == input.parameters.end()) {
      std::string message = "scene '";
      message.append(scene.name).append("' has no parameter '").append(name).append("'");
      throw std::invalid_argument(message);
    }
    found->second = value;
  }
  input.camera = make_camera(scene.view, film.value_or(scene.film));
  input.max_depth = max_depth.value_or(scene.max_depth);
  if (input.max_depth < -1) {
    throw std::invalid_argument("max_depth must be -1 (unlimited) or more");
  }
  return scene.make(input);
}

}  // namespace plumbline::analytic
