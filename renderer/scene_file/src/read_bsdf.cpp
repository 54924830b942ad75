#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/scene_file/nearest_name.h>

#include "read_parts.h"
#include "text_file.h"

namespace plumbline::renderer {
namespace {

constexpr double kMaxEta = 2.5;

constexpr Property<Kind::rgb> kReflectance{"reflectance", "0.5",
                                           between(0, 1, ": more would create energy")};
constexpr Property<Kind::metal> kMaterial{"material", "none"};
constexpr Property<Kind::rgb> kEta{"eta", "0", between(0, 1000)};
constexpr Property<Kind::rgb> kK{"k", "1", between(0, 1000)};
constexpr Property<Kind::string> kDistribution{"distribution", kRequired, one_of("ggx")};
constexpr Property<Kind::number> kAlpha{"alpha", "0.1", between(1e-4, 1)};
constexpr Property<Kind::number> kAlphaU{"alpha_u", "0.1", between(1e-4, 1)};
constexpr Property<Kind::number> kAlphaV{"alpha_v", "0.1", between(1e-4, 1)};
constexpr Property<Kind::index> kGlassIor{"int_ior", "bk7", kPositive};
constexpr Property<Kind::index> kCoatIor{"int_ior", "polypropylene", kPositive};
constexpr Property<Kind::index> kExtIor{"ext_ior", "air", kPositive};
constexpr Property<Kind::number> kExponent{"exponent", "30", between(1, 1e6)};
constexpr Property<Kind::number> kWeight{"weight", kRequired, between(0, 1)};
constexpr Property<Kind::number> kThickness{"thickness", kRequired, between(0, 2000)};
constexpr Property<Kind::index> kFilmIor{"film_ior", "water", kPositive};
constexpr Property<Kind::nested> kSides{"bsdf", kRequired, between(1, 2)};
constexpr Property<Kind::nested> kPair{"bsdf", kRequired, between(2, 2)};
constexpr Property<Kind::nested> kBase{"bsdf", kRequired, between(1, 1)};

ReadBsdf read_diffuse(const Object& object, BsdfReader&) {
  return {Lambertian{rgb_cast<float>(object[kReflectance])}};
}

ConductorFresnel read_metal(const Object& object) {
  const bool by_index = object.has(kEta) || object.has(kK);
  if (by_index && object.has(kMaterial)) object.fail(kMaterial, "either this, or eta and k");
  const ConductorFresnel metal{rgb_cast<float>(object[kEta]), rgb_cast<float>(object[kK])};
  const Rgbf sum = metal.eta() + metal.k();  // near 0 a denominator of Fresnel's equations vanishes
  if (!(std::min({sum.r, sum.g, sum.b}) >= 0.01f)) {
    object.fail(kEta, "η and k must not both be 0: their sum is at least 0.01");
  }
  return by_index ? metal : object[kMaterial];
}

/// What may be rough in Mitsuba's way: its distribution has to be named, as its default is another.
Ggx read_ggx(const Object& object) {
  const bool anisotropic = object.has(kAlphaU) || object.has(kAlphaV);
  if (anisotropic && object.has(kAlpha)) object.fail(kAlpha, "either this, or alpha_u and alpha_v");
  return {static_cast<float>(object[anisotropic ? kAlphaU : kAlpha]),
          static_cast<float>(object[anisotropic ? kAlphaV : kAlpha])};
}

ReadBsdf read_conductor(const Object& object, BsdfReader&) {
  return {SmoothConductor{read_metal(object)}};
}

ReadBsdf read_rough_conductor(const Object& object, BsdfReader&) {
  return {GgxConductor{read_ggx(object), read_metal(object)}};
}

/// Index inside over the one outside.
double read_eta(const Object& object, const Property<Kind::index>& inside, double least) {
  const double eta = object[inside] / object[kExtIor];
  if (!(eta >= least && eta <= kMaxEta)) {
    object.fail(inside, fmt::format("{:g} times ext_ior: must lie between {:g} and {:g}", eta,
                                    least, kMaxEta));
  }
  return eta;
}

ReadBsdf read_dielectric(const Object& object, BsdfReader&) {
  const double eta = read_eta(object, kGlassIor, 1 / kMaxEta);
  return {SmoothDielectric{{static_cast<float>(eta)}}, object[kExtIor], object[kGlassIor]};
}

ReadBsdf read_rough_dielectric(const Object& object, BsdfReader&) {
  const double eta = read_eta(object, kGlassIor, 1 / kMaxEta);
  if (!(std::abs(eta - 1) >= 1e-3)) {
    object.fail(kGlassIor,
                "must differ from ext_ior by a thousandth: normals cannot be told otherwise");
  }
  return {GgxDielectric{read_ggx(object), {static_cast<float>(eta)}}, object[kExtIor],
          object[kGlassIor]};
}

ReadBsdf read_phong(const Object& object, BsdfReader&) {
  return {
      ModifiedPhong{rgb_cast<float>(object[kReflectance]), static_cast<float>(object[kExponent])}};
}

ReadBsdf read_clear_coat(const Object& object, BsdfReader&) {
  const double eta = read_eta(object, kCoatIor, 1.01);
  return {ClearCoat(static_cast<float>(eta), static_cast<float>(object[kAlpha]),
                    rgb_cast<float>(object[kReflectance]))};
}

ReadBsdf read_two_sided(const Object& object, BsdfReader& bsdfs) {
  const std::vector<std::uint32_t> sides = bsdfs.read_nested(object[kSides]);
  for (const std::uint32_t side : sides) {
    if (bsdfs[side].parts.transmission) object.fail("may not hold a BSDF that light passes");
  }
  return {TwoSided{sides.front(), sides.back()}};
}

ReadBsdf read_mixture(const Object& object, BsdfReader& bsdfs) {
  const std::vector<std::uint32_t> parts = bsdfs.read_nested(object[kPair]);
  return {Mixture{parts[0], parts[1], static_cast<float>(object[kWeight])}};
}

ReadBsdf read_thin_film(const Object& object, BsdfReader& bsdfs) {
  const ReadBsdf& base = bsdfs[bsdfs.read_nested(object[kBase]).front()];
  const double least = std::min(base.ext_ior, base.int_ior), most = kMaxEta * base.ext_ior;
  if (!(object[kFilmIor] >= least && object[kFilmIor] <= most)) {
    object.fail(kFilmIor, fmt::format("must lie between {:g}, the smaller index beside the film, "
                                      "and {:g}",
                                      least, most));
  }
  const FilmLayer film{static_cast<float>(object[kThickness] * base.ext_ior),
                       static_cast<float>(object[kFilmIor] / base.ext_ior)};
  const auto coat = [&](const auto& b) -> ReadBsdf {
    if constexpr (requires { ThinFilm{b, film}; }) {
      return {ThinFilm{b, film}};
    } else {
      object.fail("covers a conductor, roughconductor, dielectric or roughdielectric");
    }
  };
  return std::visit(coat, base.bsdf);
}

}  // namespace

const ObjectTypes<ReadBsdf, BsdfReader&> kBsdfTypes = {
    {"diffuse", {kReflectance}, read_diffuse},
    {"conductor", {kMaterial, kEta, kK}, read_conductor},
    {"roughconductor",
     {kDistribution, kAlpha, kAlphaU, kAlphaV, kMaterial, kEta, kK},
     read_rough_conductor},
    {"dielectric", {kGlassIor, kExtIor}, read_dielectric},
    {"roughdielectric",
     {kDistribution, kAlpha, kAlphaU, kAlphaV, kGlassIor, kExtIor},
     read_rough_dielectric},
    {"twosided", {kSides}, read_two_sided},
    {"blendbsdf", {kWeight, kPair}, read_mixture},
    {"clearcoat", {kReflectance, kAlpha, kCoatIor, kExtIor}, read_clear_coat},
    {"thinfilm", {kThickness, kFilmIor, kBase}, read_thin_film},
    {"phong", {kReflectance, kExponent}, read_phong},
};

std::uint32_t BsdfReader::read(const Element& element) {
  constexpr int kMaxDepth = 8;  // a mixture of mixtures asks 2^depth BSDFs for every answer
  const std::uint32_t index = add(kBsdfTypes.read(element, *this));
  if (bsdfs_[index].depth > kMaxDepth) {
    element.fail(fmt::format("BSDFs are nested deeper than {}", kMaxDepth));
  }
  if (element.has("id")) by_id_.emplace(element.text("id"), index);
  return index;
}

std::vector<std::uint32_t> BsdfReader::read_nested(const std::vector<Element>& elements) {
  std::vector<std::uint32_t> indices;
  for (const Element& element : elements) {
    indices.push_back(element.tag() == "ref" ? resolve(element, " above it") : read(element));
  }
  return indices;
}

std::uint32_t BsdfReader::add(ReadBsdf read) {
  std::visit(
      [&]<class B>(const B& bsdf) {
        if constexpr (NestedBsdf<B>) {
          for (const std::uint32_t child : bsdf.children()) {
            read.parts = read.parts | bsdfs_[child].parts;
            read.depth = std::max(read.depth, bsdfs_[child].depth + 1);
          }
        } else {
          read.parts = bsdf.parts();
        }
      },
      read.bsdf);
  bsdfs_.push_back(std::move(read));
  return static_cast<std::uint32_t>(bsdfs_.size() - 1);
}

std::uint32_t BsdfReader::fallback() {
  if (!fallback_) fallback_ = add({Lambertian{{0.5f, 0.5f, 0.5f}}});
  return *fallback_;
}

std::shared_ptr<const BsdfSet> BsdfReader::take() {
  std::vector<Bsdf> bsdfs;
  for (ReadBsdf& read : bsdfs_) bsdfs.push_back(std::move(read.bsdf));
  return make_bsdfs(std::move(bsdfs));
}

std::uint32_t BsdfReader::resolve(const Element& ref, const char* where) const {
  ref.allow_attributes({"id", "name"});
  ref.allow_no_children();
  const std::string id = ref.text("id");
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
