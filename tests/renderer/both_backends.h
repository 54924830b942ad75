#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/scene_file/load_scene.h>
#include <plumbline_tests/support.h>

/// One image by both backends, bit by bit.
namespace plumbline::tests {

constexpr int kSmallWidth = 20, kSmallHeight = 15;

/// More paths than one batch holds.
constexpr std::uint32_t kSmallSamples = 16;

/// A scene of the repository, by its path without the ending, in a small image.
inline renderer::SceneDescription small(const std::string& file) {
  renderer::SceneDescription scene = renderer::load_scene(source_file(file + ".xml"));
  scene.camera.width = kSmallWidth;
  scene.camera.height = kSmallHeight;
  return scene;
}

struct Pair {
  renderer::RenderResult scalar, batched;
};

inline Pair render_both(const renderer::Scene& scene, renderer::RenderOptions options) {
  options.backend = renderer::Backend::scalar;
  options.threads = 1;
  renderer::RenderResult scalar = render(scene, options);
  options.backend = renderer::Backend::batched;
  options.threads = 2;
  return {std::move(scalar), render(scene, options)};
}

/// Pixels whose moments are not the same bits.
inline std::size_t differing_pixels(const Pair& pair) {
  const auto& a = pair.scalar.film.pixels();
  const auto& b = pair.batched.film.pixels();
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    count += std::memcmp(&a[i], &b[i], sizeof a[i]) != 0 ? 1u : 0u;
  }
  return count;
}

/// Whether these are the same bits, by the same rays.
inline bool same_bits(const Pair& pair) {
  const renderer::PathCounters &a = pair.scalar.counters, &b = pair.batched.counters;
  return differing_pixels(pair) == 0 && a.camera_rays == b.camera_rays &&
         a.bounce_rays == b.bounce_rays && a.shadow_rays == b.shadow_rays &&
         a.rejected == b.rejected;
}

/// `same_bits`, with what differs.
inline void expect_same_bits(const Pair& pair) {
  EXPECT_EQ(differing_pixels(pair), 0u);
  const renderer::PathCounters &a = pair.scalar.counters, &b = pair.batched.counters;
  EXPECT_EQ(a.camera_rays, b.camera_rays);
  EXPECT_EQ(a.bounce_rays, b.bounce_rays);
  EXPECT_EQ(a.shadow_rays, b.shadow_rays);
  EXPECT_EQ(a.rejected, b.rejected);
}

}  // namespace plumbline::tests
