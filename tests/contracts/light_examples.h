#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <plumbline/renderer/light/light.h>

namespace plumbline::tests {

/// A light with a point that it is looked at from.
struct LightExample {
  std::string name;  ///< "SphereLight/near"
  renderer::Light light;
  renderer::Vec3f reference;
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
         {3, 0, 0}}};
  }
};

template <>
struct LightExamples<renderer::RectangleLight> {
  static NamedLights all() {
    using renderer::RectangleLight;
    const RectangleLight ceiling{{-1, -0.5f, 2}, {2, 0, 0}, {0, 1, 0}, {0, 0, -1}, kRadiance};
    // Scaled, or 1 would do for 1/area.
    const RectangleLight large{{-4, 3, -2}, {8, 0, 0}, {0, 0, 5}, {0, -1, 0}, kRadiance};
    return {{"RectangleLight/ceiling", ceiling, {0.3f, 0.2f, 0}},
            {"RectangleLight/from the side", ceiling, {4, 1, 1.5f}},
            {"RectangleLight/from behind", ceiling, {0, 0, 3}},
            {"RectangleLight/large", large, {0, 0, 0}}};
  }
};

template <>
struct LightExamples<renderer::DiskLight> {
  static NamedLights all() {
    using renderer::DiskLight;
    const renderer::Vec3f tilted = renderer::normalize(renderer::Vec3f{1, -2, -2});
    return {{"DiskLight/overhead", DiskLight{{0, 0, 2}, {0, 0, -1}, 0.7f, kRadiance}, {0, 0, 0}},
            {"DiskLight/tilted", DiskLight{{-1, 2, 3}, tilted, 3, kRadiance}, {0, 0.5f, 0}}};
  }
};

template <>
struct LightExamples<renderer::TriangleLight> {
  static NamedLights all() {
    using renderer::TriangleLight;
    return {{"TriangleLight/overhead",
             TriangleLight{{-1, -1, 2}, {0, 2, 0}, {2, 0, 0}, {0, 0, -1}, kRadiance},
             {0, 0, 0}},
            {"TriangleLight/thin",
             TriangleLight{{-1, 0, 1}, {0, 0.2f, 0}, {5, 0, 0}, {0, 0, -1}, kRadiance},
             {0.3f, 0.1f, 0}}};
  }
};

template <>
struct LightExamples<renderer::ConstantEnvironment> {
  static NamedLights all() {
    return {{"ConstantEnvironment", renderer::ConstantEnvironment{kRadiance}, {1, 2, 3}}};
  }
};

namespace detail {

template <class Variant, std::size_t... i>
NamedLights examples_of_each(std::index_sequence<i...>) {
  NamedLights all;
  const auto append = [&all](const NamedLights& some) {
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

}  // namespace plumbline::tests
