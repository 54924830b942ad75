#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/scene_file/nearest_name.h>

#include "materials.h"
#include "read_parts.h"
#include "text_file.h"

namespace plumbline::renderer {
namespace {

constexpr double kMaxEta = 2.5;

double check_between(const Properties& properties, const char* name, double value, double low,
                     double high) {
  if (!(value >= low && value <= high)) {
    properties.fail(name, fmt::format("must lie between {:g} and {:g}", low, high));
  }
  return value;
}

/// Of a table of materials, by name.
template <class T>
const T& look_up(const std::map<std::string, T>& table, const Properties& properties,
                 const std::string& property, const std::string& name) {
  const auto found = table.find(name);
  if (found != table.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [key, unused] : table) known.push_back(key);
  properties.fail(property,
                  fmt::format("{} is not known; {}", in_quotes(name), name_hint(name, known)));
}

Rgbf read_reflectance(Properties& properties) {
  const Rgbd reflectance = properties.rgb("reflectance", {0.5, 0.5, 0.5});
  for (const double channel : {reflectance.r, reflectance.g, reflectance.b}) {
    if (!(channel >= 0 && channel <= 1)) {
      properties.fail("reflectance", "must lie between 0 and 1: more would create energy");
    }
  }
  return rgb_cast<float>(reflectance);
}

float read_alpha(Properties& properties, const char* name) {
  return static_cast<float>(check_between(properties, name, properties.number(name, 0.1), 1e-4, 1));
}

/// What may be rough in Mitsuba's way: its distribution has to be named, as its default is another.
Ggx read_ggx(Properties& properties) {
  const std::string distribution = properties.string("distribution");
  if (!distribution.empty() && distribution != "ggx") {
    properties.fail("distribution",
                    fmt::format("{} is not supported; supported: ggx", in_quotes(distribution)));
  }
  const bool anisotropic =
      !properties.tag_of("alpha_u").empty() || !properties.tag_of("alpha_v").empty();
  if (anisotropic && !properties.tag_of("alpha").empty()) {
    properties.fail("alpha", "either this, or alpha_u and alpha_v");
  }
  const float alpha = read_alpha(properties, "alpha");
  return anisotropic ? Ggx{read_alpha(properties, "alpha_u"), read_alpha(properties, "alpha_v")}
                     : Ggx{alpha, alpha};
}

Rgbf read_metal_index(Properties& properties, const char* name, double absent) {
  const Rgbd index = properties.rgb(name, {absent, absent, absent});
  for (const double channel : {index.r, index.g, index.b}) {
    if (!(channel >= 0 && channel <= 1000)) properties.fail(name, "must lie between 0 and 1000");
  }
  return rgb_cast<float>(index);
}

ConductorFresnel read_metal(Properties& properties) {
  const bool by_index = !properties.tag_of("eta").empty() || !properties.tag_of("k").empty();
  if (by_index && !properties.tag_of("material").empty()) {
    properties.fail("material", "either this, or eta and k");
  }
  const std::string material = properties.string("material", "none");
  const ConductorFresnel metal{read_metal_index(properties, "eta", 0),
                               read_metal_index(properties, "k", 1)};
  const Rgbf sum = metal.eta() + metal.k();  // near 0 a denominator of Fresnel's equations vanishes
  if (!(std::min({sum.r, sum.g, sum.b}) >= 0.01f)) {
    properties.fail("eta", "η and k must not both be 0: their sum is at least 0.01");
  }
  if (by_index) return metal;
  return look_up(kMetals, properties, "material", material);
}

/// A number, or the name of a material.
double read_index(Properties& properties, const std::string& name, const char* absent) {
  if (properties.tag_of(name) == "string") {
    return look_up(kRefractiveIndices, properties, name, properties.string(name, absent));
  }
  const double index = properties.number(name, kRefractiveIndices.at(absent));
  if (!(index > 0)) properties.fail(name, "must be positive");
  return index;
}

struct Indices {
  double inside, outside;
};

Indices read_indices(Properties& properties, const char* absent, double least_eta) {
  const Indices n{read_index(properties, "int_ior", absent),
                  read_index(properties, "ext_ior", "air")};
  const double eta = n.inside / n.outside;
  if (!(eta >= least_eta && eta <= kMaxEta)) {
    properties.fail("int_ior", fmt::format("{:g} times ext_ior: must lie between {:g} and {:g}",
                                           eta, least_eta, kMaxEta));
  }
  return n;
}

float relative(const Indices& n) { return static_cast<float>(n.inside / n.outside); }

Bsdf read_rough_glass(Properties& properties, const Indices& n) {
  if (!(std::abs(n.inside / n.outside - 1) >= 1e-3)) {
    properties.fail("int_ior",
                    "must differ from ext_ior by a thousandth: normals cannot be told otherwise");
  }
  return GgxDielectric{read_ggx(properties), {relative(n)}};
}

Bsdf read_clear_coat(Properties& properties) {
  const float alpha = read_alpha(properties, "alpha");
  const Rgbf base = read_reflectance(properties);
  const Indices n = read_indices(properties, "polypropylene", 1.01);
  properties.finish();  // before the table is made
  return ClearCoat(relative(n), alpha, base);
}

}  // namespace

std::uint32_t BsdfReader::read(const Element& element) {
  element.allow_attributes({"type", "id", "name"});
  const std::string type = element.type();
  element.file().register_id(element);
  Properties properties(element);
  Known known;
  Bsdf bsdf = read_type(type, properties, known);
  properties.finish();
  const std::uint32_t index = add(std::move(bsdf), known);
  if (element.has("id")) by_id_.emplace(element.text("id"), index);
  return index;
}

std::uint32_t BsdfReader::add(Bsdf bsdf, Known known) {
  std::visit(
      [&](const auto& b) {
        if constexpr (requires { b.parts(); }) known.parts = b.parts();
      },
      bsdf);
  bsdfs_.push_back(std::move(bsdf));
  known_.push_back(known);
  return static_cast<std::uint32_t>(bsdfs_.size() - 1);
}

Bsdf BsdfReader::read_type(const std::string& type, Properties& properties, Known& known) {
  if (type == "conductor") return SmoothConductor{read_metal(properties)};
  if (type == "roughconductor") return GgxConductor{read_ggx(properties), read_metal(properties)};
  if (type == "dielectric" || type == "roughdielectric") {
    const Indices n = read_indices(properties, "bk7", 1 / kMaxEta);
    known.ext_ior = n.outside;
    known.int_ior = n.inside;
    if (type == "roughdielectric") return read_rough_glass(properties, n);
    return SmoothDielectric{{relative(n)}};
  }
  if (type == "phong") {
    const double exponent =
        check_between(properties, "exponent", properties.number("exponent", 30), 1, 1e6);
    return ModifiedPhong{read_reflectance(properties), static_cast<float>(exponent)};
  }
  if (type == "clearcoat") return read_clear_coat(properties);
  if (type == "thinfilm") return read_thin_film(properties);
  if (type == "twosided") return read_two_sided(properties, known);
  if (type == "blendbsdf") return read_mixture(properties, known);
  return Lambertian{read_reflectance(properties)};
}

std::vector<std::uint32_t> BsdfReader::read_nested(Properties& properties, std::size_t least,
                                                   std::size_t most, Known& known) {
  constexpr int kMaxDepth = 8;  // a mixture of mixtures asks 2^depth BSDFs for every answer
  std::vector<Element> elements = properties.objects("bsdf");
  for (const Element& ref : properties.objects("ref")) elements.push_back(ref);
  properties.finish();
  std::sort(elements.begin(), elements.end(),
            [](const Element& a, const Element& b) { return a.offset() < b.offset(); });
  if (elements.size() < least || elements.size() > most) {
    properties.fail("", least == most
                            ? fmt::format("nests {} BSDFs: <bsdf> or <ref>", most)
                            : fmt::format("nests {} or {} BSDFs: <bsdf> or <ref>", least, most));
  }
  std::vector<std::uint32_t> indices;
  for (const Element& element : elements) {
    indices.push_back(element.tag() == "bsdf" ? read(element)
                                              : resolve(element, element.text("id"), " above it"));
    const Known& child = known_[indices.back()];
    known.parts = known.parts | child.parts;
    known.depth = std::max(known.depth, child.depth + 1);
    if (known.depth > kMaxDepth) {
      element.fail(fmt::format("BSDFs are nested deeper than {}", kMaxDepth));
    }
  }
  return indices;
}

Bsdf BsdfReader::read_two_sided(Properties& properties, Known& known) {
  const std::vector<std::uint32_t> sides = read_nested(properties, 1, 2, known);
  if (known.parts.transmission) properties.fail("", "may not hold a BSDF that light passes");
  return TwoSided{sides.front(), sides.back()};
}

Bsdf BsdfReader::read_mixture(Properties& properties, Known& known) {
  const double weight = check_between(properties, "weight", properties.number("weight"), 0, 1);
  const std::vector<std::uint32_t> parts = read_nested(properties, 2, 2, known);
  return Mixture{parts[0], parts[1], static_cast<float>(weight)};
}

Bsdf BsdfReader::read_thin_film(Properties& properties) {
  const double thickness =
      check_between(properties, "thickness", properties.number("thickness"), 0, 2000);
  const double index = read_index(properties, "film_ior", "water");
  Known unused;
  const std::uint32_t base = read_nested(properties, 1, 1, unused).front();
  const Known& known = known_[base];
  const double least = std::min(known.ext_ior, known.int_ior), most = kMaxEta * known.ext_ior;
  if (!(index >= least && index <= most)) {
    properties.fail(
        "film_ior",
        fmt::format("must lie between {:g}, the smaller index beside the film, and {:g}", least,
                    most));
  }
  const FilmLayer film{static_cast<float>(thickness * known.ext_ior),
                       static_cast<float>(index / known.ext_ior)};
  const auto coat = [&](const auto& b) -> Bsdf {
    if constexpr (requires { ThinFilm{b, film}; }) {
      return ThinFilm{b, film};
    } else {
      properties.fail("", "covers a conductor, roughconductor, dielectric or roughdielectric");
    }
  };
  return std::visit(coat, bsdfs_[base]);
}

std::uint32_t BsdfReader::fallback() {
  if (!fallback_) fallback_ = add(Lambertian{{0.5f, 0.5f, 0.5f}}, {});
  return *fallback_;
}

std::uint32_t BsdfReader::resolve(const Element& ref, const std::string& id,
                                  const char* where) const {
  ref.allow_attributes({"id", "name"});
  ref.allow_no_children();
  const auto found = by_id_.find(id);
  if (found != by_id_.end()) return found->second;
  const std::string tag = ref.file().tag_of_id(id);
  if (tag == "bsdf") ref.fail(fmt::format("{} is the id of the <bsdf> around it", in_quotes(id)));
  if (!tag.empty()) ref.fail(fmt::format("id {} is a <{}>, not a <bsdf>", in_quotes(id), tag));
  std::vector<std::string> known;
  for (const auto& [name, index] : by_id_) known.push_back(name);
  const std::string hint = name_hint(id, known);
  ref.fail(fmt::format("no <bsdf> has the id {}{}{}{}", in_quotes(id), where,
                       hint.empty() ? "" : "; ", hint));
}

}  // namespace plumbline::renderer
