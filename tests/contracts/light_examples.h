#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <plumbline/renderer/core/light/light.h>
#include "even_chart.h"

namespace plumbline::tests {

/// What there is to sample of a light from a point. Stated with each example: what a suite expects
/// of a light must not be asked of that light.
enum class Seen { density, atom, nothing };

/// A light with a point that it is looked at from.
struct LightExample {
  std::string name;  ///< "SphereLight/near"
  renderer::Light light;
  renderer::Vec3f reference;

  /// Where the density jumps inside of its support: what makes it even. No cubature certifies its
  /// integral over the sphere then.
  std::optional<EvenChart> chart{};

  Seen seen = Seen::density;

  /// The density grows without bound, as 1/cosθ does at the limb of what is sampled by area. All
  /// that cubature may spend knows its integral to 4e-4: the promise is the library's own, 1e-3.
  bool pole = false;
};

/// Lights worth checking of one alternative of `renderer::Light`. The type list drives the tests:
/// an alternative that this is not specialised for does not compile in `all_light_examples`.
template <class L>
struct LightExamples {
  static_assert(sizeof(L) == 0,
                "a light of the renderer's variant has no examples: specialise LightExamples");
};

using NamedLights = std::vector<LightExample>;

inline constexpr renderer::Rgbf kRadiance{1, 2, 3};

/// A point of which no coordinate is that of a light's centre, so that no symmetry hides an error.
inline constexpr renderer::Vec3f kBeside{0.1f, -0.2f, 0.3f};

template <>
struct LightExamples<renderer::SphereLight> {
  static NamedLights all() {
    using renderer::SphereLight;
    return {
        {"SphereLight/subtends 60°", SphereLight{{0, 0, 3}, 1.5f, false, kRadiance}, {0, 0, 0}},
        {"SphereLight/near touching", SphereLight{{1, 2, 2}, 2.997f, false, kRadiance}, {0, 0, 0}},
        {"SphereLight/small and far",
         SphereLight{{300, -200, 100}, 0.5f, false, kRadiance},
         {1, 1, 1}},
        {"SphereLight/inside", SphereLight{{0, 0, 0}, 2, true, kRadiance}, {0.5f, 0.9f, -0.3f}},
        {"SphereLight/inside, at the centre",
         SphereLight{{0, 0, 0}, 2, true, kRadiance},
         {0, 0, 0}},
        {"SphereLight/outside of an inward one",
         SphereLight{{0, 0, 0}, 2, true, kRadiance},
         {3, 0, 0},
         std::nullopt,
         Seen::density,
         true},
        {"SphereLight/beside", SphereLight{{0.5f, 1, 3}, 0.7f, false, kRadiance}, kBeside},
        {"SphereLight/inside, beside", SphereLight{{0.5f, 1, 0}, 2, true, kRadiance}, kBeside}};
  }
};

/// The same light, sampled by solid angle.
template <class L>
L by_solid_angle(L light) {
  light.by_solid_angle = true;
  return light;
}

template <>
struct LightExamples<renderer::RectangleLight> {
  static NamedLights all() {
    using renderer::RectangleLight;
    const RectangleLight ceiling{{-1, -0.5f, 2}, {2, 0, 0}, {0, 1, 0}, {0, 0, -1}, kRadiance};
    // Scaled, or 1 would do for 1/area.
    const RectangleLight large{{-4, 3, -2}, {8, 0, 0}, {0, 0, 5}, {0, -1, 0}, kRadiance};
    RectangleLight two_sided = ceiling;
    two_sided.two_sided = true;
    return {
        {"RectangleLight/two-sided, in front", two_sided, {0.3f, 0.2f, 0}},
        {"RectangleLight/two-sided, behind", two_sided, {4, 1, 2.5f}},
        {"RectangleLight/two-sided by solid angle, behind",
         by_solid_angle(two_sided),
         {0.3f, 0.2f, 4}},
        {"RectangleLight/ceiling", ceiling, {0.3f, 0.2f, 0}},
        {"RectangleLight/from the side", ceiling, {4, 1, 1.5f}},
        {"RectangleLight/from behind", ceiling, {0, 0, 3}, {}, Seen::nothing},
        {"RectangleLight/large", large, {0, 0, 0}},
        {"RectangleLight/by solid angle, overhead", by_solid_angle(ceiling), {0.3f, 0.2f, 0}},
        {"RectangleLight/by solid angle, from the side", by_solid_angle(ceiling), {4, 1, 1.5f}},
        {"RectangleLight/by solid angle, from behind",
         by_solid_angle(ceiling),
         {0, 0, 3},
         {},
         Seen::nothing},
        {"RectangleLight/by solid angle, near", by_solid_angle(large), {-1, 2.999f, 1}},
        // Too small for a solid angle: the same light falls back to its area.
        {"RectangleLight/by solid angle, far", by_solid_angle(ceiling), {0, 0, -2046}},
        {"RectangleLight/beside",
         RectangleLight{{-1, -0.5f, 2}, {2, 0, 0}, {0, 1.5f, 0}, {0, 0, -1}, kRadiance}, kBeside}};
  }
};

template <>
struct LightExamples<renderer::DiskLight> {
  static NamedLights all() {
    using renderer::DiskLight;
    const renderer::Vec3f tilted = renderer::normalize(renderer::Vec3f{1, -2, -2});
    return {{"DiskLight/overhead", DiskLight{{0, 0, 2}, {0, 0, -1}, 0.7f, kRadiance}, {0, 0, 0}},
            {"DiskLight/tilted", DiskLight{{-1, 2, 3}, tilted, 3, kRadiance}, {0, 0.5f, 0}},
            {"DiskLight/beside", DiskLight{{0.5f, 0.3f, 1}, {0, 0, -1}, 1, kRadiance}, kBeside}};
  }
};

template <>
struct LightExamples<renderer::TriangleLight> {
  static NamedLights all() {
    using renderer::TriangleLight;
    const TriangleLight overhead{{-1, -1, 2}, {0, 2, 0}, {2, 0, 0}, {0, 0, -1}, kRadiance};
    const TriangleLight thin{{-1, 0, 1}, {0, 0.2f, 0}, {5, 0, 0}, {0, 0, -1}, kRadiance};
    return {
        {"TriangleLight/overhead", overhead, {0, 0, 0}},
        {"TriangleLight/thin", thin, {0.3f, 0.1f, 0}},
        {"TriangleLight/by solid angle, overhead", by_solid_angle(overhead), {0, 0, 0}},
        {"TriangleLight/by solid angle, from the side", by_solid_angle(overhead), {-2, -3, 1}},
        {"TriangleLight/by solid angle, from behind",
         by_solid_angle(overhead),
         {0, 0, 2.5f},
         {},
         Seen::nothing},
        {"TriangleLight/by solid angle, far", by_solid_angle(overhead), {0, 0, -2046}},
        {"TriangleLight/beside",
         TriangleLight{{-1, 0, 2}, {2, 0.5f, 0}, {0.25f, 2, 0}, {0, 0, -1}, kRadiance}, kBeside}};
  }
};

template <>
struct LightExamples<renderer::ConstantEnvironment> {
  static NamedLights all() {
    return {{"ConstantEnvironment", renderer::ConstantEnvironment{kRadiance}, {1, 2, 3}}};
  }
};

inline constexpr int kSmallMapWidth = 8, kSmallMapHeight = 5;

/// A small map, brighter in the north, with one bright pixel in the south, in units of kRadiance.
inline std::vector<double> small_map_greys() {
  std::vector<double> greys;
  for (int i = 0; i < kSmallMapWidth * kSmallMapHeight; ++i) {
    greys.push_back(i == 13 ? 20 : i < 8 ? 8 + i * 5 % 8 : 1 + i % 2);
  }
  return greys;
}

/// `compensation`, as in renderer::EnvironmentTable, leaves out all but the north and that pixel.
inline std::shared_ptr<const renderer::EnvironmentTable> small_map(bool compensation) {
  std::vector<renderer::Rgbf> pixels;
  for (const double grey : small_map_greys()) {
    pixels.push_back(static_cast<float>(grey) * kRadiance);
  }
  return std::make_shared<renderer::EnvironmentTable>(kSmallMapWidth, kSmallMapHeight,
                                                      std::move(pixels), compensation);
}

using MapAxes = std::array<Direction, 3>;
inline constexpr MapAxes kUnturned{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

inline EvenChart small_map_chart(const MapAxes& axes = kUnturned) {
  return pixel_chart(kSmallMapWidth, kSmallMapHeight, small_map_greys(), axes);
}

/// Of each pixel what it has above the mean over the sphere (Karlík et al. 2019).
inline EvenChart compensated_map_chart() {
  std::vector<double> greys = small_map_greys();
  double mean = 0;
  for (std::size_t i = 0; i < greys.size(); ++i) {
    const double row = static_cast<double>(i / kSmallMapWidth);
    const double step = renderer::pi<double>() / kSmallMapHeight;
    mean += greys[i] * (std::cos(row * step) - std::cos((row + 1) * step)) / 2 / kSmallMapWidth;
  }
  for (double& grey : greys) grey = std::max(0.0, grey - mean);
  return pixel_chart(kSmallMapWidth, kSmallMapHeight, greys, kUnturned);
}

template <>
struct LightExamples<renderer::EnvironmentMap> {
  static NamedLights all() {
    using renderer::EnvironmentMap, renderer::EnvironmentTable;
    const float s = std::sqrt(0.5f);
    const double d = std::sqrt(0.5);
    const auto flat = [](const renderer::Rgbf& radiance, bool compensation) {
      return EnvironmentMap{std::make_shared<EnvironmentTable>(
          3, 2, std::vector<renderer::Rgbf>(6, radiance), compensation)};
    };
    const renderer::Vec3f origin{0, 0, 0};
    return {{"EnvironmentMap/as it stands", EnvironmentMap{small_map(false)}, origin,
             small_map_chart()},
            {"EnvironmentMap/turned and scaled",
             EnvironmentMap{small_map(false), {{{s, 0, s}, {0, 1, 0}, {-s, 0, s}}}, 2}, origin,
             small_map_chart({{{d, 0, d}, {0, 1, 0}, {-d, 0, d}}})},
            {"EnvironmentMap/compensated", EnvironmentMap{small_map(true)}, origin,
             compensated_map_chart()},
            {"EnvironmentMap/constant", flat(kRadiance, false), origin},
            {"EnvironmentMap/constant, compensated", flat(kRadiance, true), origin},
            {"EnvironmentMap/black", flat({0, 0, 0}, false), origin},
            {"EnvironmentMap/one pixel",
             EnvironmentMap{std::make_shared<EnvironmentTable>(
                 1, 1, std::vector<renderer::Rgbf>(1, kRadiance), false)},
             origin}};
  }
};

template <>
struct LightExamples<renderer::SunAndSky> {
  static NamedLights all() {
    using renderer::SunAndSky;
    const renderer::Vec3f high = renderer::normalize(renderer::Vec3f{0.2f, -0.3f, 0.9f});
    const renderer::Vec3d unit = renderer::normalize(renderer::vec_cast<double>(high));
    const Direction exact_high{unit.x, unit.y, unit.z};
    constexpr float kSmall = 1.1e-5f;  // of the sun in the sky
    const renderer::Vec3f origin{0, 0, 0};
    return {{"SunAndSky/sun with sky", SunAndSky{high, kSmall, kRadiance * 1e4f, kRadiance}, origin,
             cone_chart(exact_high, static_cast<double>(kSmall))},
            {"SunAndSky/sun alone", SunAndSky{high, kSmall, kRadiance, {0, 0, 0}}, origin},
            {"SunAndSky/half of the sky", SunAndSky{high, 1, kRadiance, kRadiance}, origin}};
  }
};

template <>
struct LightExamples<renderer::PointLight> {
  static NamedLights all() {
    return {
        {"PointLight", renderer::PointLight{{1, -2, 3}, kRadiance}, {0.5f, 0, 0}, {}, Seen::atom}};
  }
};

namespace detail {

template <class Variant, std::size_t... i>
NamedLights examples_of_each(std::index_sequence<i...>) {
  NamedLights all;
  const auto append = [&all](const NamedLights& some) {
    if (some.empty()) throw std::logic_error("a light has no examples");
    all.insert(all.end(), some.begin(), some.end());
  };
  (append(LightExamples<std::variant_alternative_t<i, Variant>>::all()), ...);
  return all;
}

}  // namespace detail

/// Every example of every alternative of a variant of lights: of the renderer's, unless it is to be
/// shown what happens with another.
template <class Variant = renderer::Light>
NamedLights all_light_examples() {
  return detail::examples_of_each<Variant>(
      std::make_index_sequence<std::variant_size_v<Variant>>());
}

/// The one example of a name.
inline LightExample light_example(const std::string& name) {
  for (const LightExample& example : all_light_examples()) {
    if (example.name == name) return example;
  }
  throw std::logic_error("no light's example is called " + name);
}

}  // namespace plumbline::tests
