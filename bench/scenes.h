#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/core/render/film.h>

namespace plumbline::bench {

struct NamedScene {
  const char *name, *title;
};

/// What rays are measured in: few primitives and many, flat and round.
inline constexpr NamedScene kTracedScenes[] = {{"cornell", "Cornell box"},
                                               {"veach", "Veach's plates"},
                                               {"displaced_sphere", "1M triangles"},
                                               {"many_spheres", "100k spheres"}};

/// Path of a scene by name, from the scenes with known answers or from bench/scenes.
/// @throws renderer::InputError for a name that neither has
std::filesystem::path scene_path(const std::string& name);

/// The scene at another resolution, with square pixels as before: one of made_scene() or from a
/// file. Scenes with known answers are in grey: figures of luminance from before they had colours
/// stay comparable.
renderer::SceneDescription load_at_size(const std::string& name, int width, int height);

/// Luminance of the exact image, or of a render with `reference_spp` samples per pixel where no
/// closed form is known; row by row from the top.
std::vector<double> reference_luminance(const std::string& name,
                                        const renderer::SceneDescription& description,
                                        std::uint32_t reference_spp);

/// Row by row from the top.
std::vector<double> luminances(const renderer::Film& film);

/// Mean over pixels of (x − r)²/(r² + 0.01), both of luminance and of the same size.
double rel_mse(const std::vector<double>& image, const std::vector<double>& reference);

}  // namespace plumbline::bench
