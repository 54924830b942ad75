#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/scene_file/load_scene.h>

/// Scene files made of text, in a directory of their own.
namespace plumbline::tests {

/// A sensor as good as any, on one line.
inline constexpr const char* kSensor =
    R"(<sensor type="perspective"><float name="fov" value="60"/><film type="hdrfilm"><rfilter type="box"/></film></sensor>)";

/// A scene with kSensor on line 2 and `body` from line 3 on.
std::string scene_with(std::string_view body);

/// Loads a file with that text.
renderer::SceneDescription load_text(const std::string& text,
                                     const std::map<std::string, std::string>& overrides = {});

/// Loads scene_with(body).
inline renderer::SceneDescription load_body(
    std::string_view body, const std::map<std::string, std::string>& overrides = {}) {
  return load_text(scene_with(body), overrides);
}

/// A BSDF that load_scene has read.
inline const renderer::Bsdf& bsdf_of(const renderer::SceneDescription& scene, std::uint32_t index) {
  return dynamic_cast<const renderer::BsdfSet&>(*scene.bsdfs).alternative(index);
}

/// Of coordinates around 10, after a few operations in double.
inline constexpr double kRounding = 1e-14;
void expect_near(const renderer::Vec3d& actual, const renderer::Vec3d& expected);

/// What load_scene says of a file with that text, the directory left out: "scene.xml:3: why".
/// Empty if it takes the file.
std::string refusal_of_text(const std::string& text,
                            const std::map<std::string, std::string>& overrides = {});

/// The same of a file that exists already.
std::string refusal_of_file(const std::filesystem::path& file,
                            const std::map<std::string, std::string>& overrides = {});

}  // namespace plumbline::tests
