#include "source.h"

namespace plumbline::renderer {
namespace {

/// What to do about names that Mitsuba's scenes hold and ours do not: types, properties, elements.
const Named<std::vector<std::string>> kAdvice = {
    {"write <rgb> with the texture's mean colour", {"texture"}},
    {"write ggx, whose tails are longer", {"beckmann"}},
    {"write clearcoat, or diffuse", {"plastic", "roughplastic", "pplastic"}},
    {"write diffuse, roughconductor, roughdielectric, or a blendbsdf of two of them",
     {"principled", "principledthin", "hair", "measured", "roughdiffuse", "difftrans"}},
    {"write dielectric", {"thindielectric"}},
    {"write the <bsdf> in it alone", {"bumpmap", "normalmap", "mask", "coating", "roughcoating"}},
    {"convert the mesh to an obj file", {"ply", "serialized", "cylinder", "bsplinecurve"}},
    {"write six rectangles, or an obj file", {"cube"}},
    {"write the shape itself, once for each place", {"shapegroup", "instance", "merge"}},
    {"write sun, which has a direction", {"directional", "directionalarea", "sunsky"}},
    {"write envmap, or constant", {"sky"}},
    {"write path",
     {"volpath", "volpathmis", "bdpt", "ptracer", "aov", "mlt", "pssmlt", "photonmapper"}},
    {"write box, by which pixels depend on their own samples alone",
     {"gaussian", "tent", "mitchell", "catmullrom", "lanczos"}},
    {"write independent; render has --sampler sobol",
     {"multijitter", "stratified", "ldsampler", "orthogonal", "sobol", "halton"}},
    {"write perspective, a pinhole", {"thinlens"}},
    {"write hdrfilm", {"ldrfilm", "mfilm", "specfilm", "tiledhdrfilm"}},
    {"write fov", {"focal_length", "focalLength"}},
    {"remove it: here it is 1", {"specular_reflectance", "specular_transmittance"}},
    {"remove it",
     {"aperture_radius", "banner", "crop_height", "crop_offset_x", "crop_offset_y", "crop_width",
      "high_quality_edges", "hide_emitters", "medium", "nonlinear", "sample_border",
      "sample_visible", "samples_per_pass", "seed", "shutter_close", "shutter_open",
      "strict_normals"}},
};

}  // namespace

std::string advice_for(std::string_view name) {
  for (const auto& [advice, names] : kAdvice) {
    if (contains(names, name)) return advice;
  }
  return {};
}

}  // namespace plumbline::renderer
