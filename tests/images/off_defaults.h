#pragma once

#include <map>
#include <ostream>
#include <string>
#include <vector>

#include <plumbline/renderer/core/render/strategy.h>

/// Parameters of scene files off their defaults: small scenes with a closed form each.
namespace plumbline::tests {

/// What is asked of a scene.
enum class Measure {
  luminance,    ///< mean over the image
  bounce_rays,  ///< per path, which is the same in each
  samples,      ///< per pixel, as the scene file has it
  light_pdf     ///< pdf_w [1/sr] of the light straight up from the origin
};

/// A scene whose answer changes with each of the parameters that it covers.
struct OffDefault {
  std::string name;
  std::string scene;                ///< what stands in <scene>; may name the files below
  std::vector<std::string> covers;  ///< "sphere.radius"; "direct" of a type without properties
  double answer = 0;
  std::vector<renderer::Strategy> strategies{renderer::Strategy::light, renderer::Strategy::bsdf,
                                             renderer::Strategy::mis};
  Measure measure = Measure::luminance;
  double tolerance = 0.01;  ///< relative, of the mean luminance

  friend void PrintTo(const OffDefault& known, std::ostream* out) { *out << known.name; }
};

/// Text files that the scenes name, by name.
const std::map<std::string, std::string>& off_default_meshes();

/// Grey values of map.exr, four columns and two rows, from the top.
inline constexpr float kOffDefaultMap[] = {1, 8, 1, 1.5f, 1, 1, 1, 1};

std::vector<OffDefault> off_defaults();

}  // namespace plumbline::tests
