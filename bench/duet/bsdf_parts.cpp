#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/renderer/assembly/bsdf.h>

#include "parts.h"
#include "shading_parts.h"

namespace plumbline::duet {
namespace {

using namespace renderer;

const ConductorFresnel kGold{{0.143119f, 0.374957f, 1.44248f}, {3.98316f, 2.38572f, 1.60322f}};

struct NamedBsdf {
  const char* name;
  Bsdf bsdf;
};

/// One of every kind of arithmetic: constant, power, microfacets that reflect and refract, layers.
std::vector<NamedBsdf> named_bsdfs() {
  return {{"lambertian", Lambertian{{0.5f, 0.5f, 0.5f}}},
          {"modified_phong", ModifiedPhong{{1, 1, 1}, 50}},
          {"ggx_conductor", GgxConductor{{0.3f, 0.3f}, kGold}},
          {"ggx_dielectric", GgxDielectric{{0.3f, 0.3f}, {1.5f}}},
          {"clear_coat", ClearCoat(1.5f, 0.1f, {0.5f, 0.5f, 0.5f})},
          {"thin_film", ThinFilm{GgxConductor{{0.3f, 0.3f}, kGold}, {300, 1.5f}}}};
}

/// As rendered: in float, through the table.
struct Shading {
  BsdfSet bsdfs;
  Inputs inputs;

  Shading(const Bsdf& bsdf, Size size) : bsdfs({bsdf}), inputs(size) {}
};

Counters sample_all(const Shading& shading) {
  Counters counters;
  for (std::size_t i = 0; i < shading.inputs.u.size(); ++i) {
    const auto s = shading.bsdfs.sample(0, shading.inputs.wo[i], shading.inputs.u[i]);
    if (s) counters.result = with_bits(counters.result, static_cast<double>(s->wi.x + s->weight.g));
  }
  return counters;
}

Counters evaluate_all(const Shading& shading) {
  Counters counters;
  for (std::size_t i = 0; i < shading.inputs.u.size(); ++i) {
    const auto value = shading.bsdfs.evaluate(0, shading.inputs.wo[i], shading.inputs.wi[i]);
    counters.result = with_bits(counters.result, static_cast<double>(value.f.g + value.pdf_w));
  }
  return counters;
}

using Measured = Counters (*)(const Shading&);

Part bsdf_part(const char* what, const NamedBsdf& named, Measured measured) {
  return {std::string(what) + "/" + named.name, [bsdf = named.bsdf, measured](Size size) -> Work {
            return [shading = std::make_shared<Shading>(bsdf, size), measured] {
              return measured(*shading);
            };
          }};
}

std::vector<Part> make_bsdf_parts() {
  std::vector<Part> parts;
  for (const NamedBsdf& named : named_bsdfs()) {
    parts.push_back(bsdf_part("bsdf-sample", named, sample_all));
    parts.push_back(bsdf_part("bsdf-evaluate", named, evaluate_all));
  }
  return parts;
}

}  // namespace

std::span<const Part> bsdf_parts() {
  static const std::vector<Part> parts = make_bsdf_parts();
  return parts;
}

}  // namespace plumbline::duet
