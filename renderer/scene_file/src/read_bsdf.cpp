#include <algorithm>
#include <cmath>

#include "parts.h"

namespace plumbline::renderer {
namespace {

constexpr double kMaxEta = 2.5;

/// What an index may be named, with the values of the table in Mitsuba 3's ior.h.
const Named<double> kRefractiveIndices = {
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.5750},      {"diamond", 2.419},
};

/// The spectra of Mitsuba's data files as linear RGB, relative to air.
const Named<ConductorFresnel> kMetals = {
    {"Ag", {{0.155265f, 0.116723f, 0.138381f}, {4.82834f, 3.12225f, 2.14695f}}},
    {"Al", {{1.65746f, 0.880369f, 0.521229f}, {9.22387f, 6.26952f, 4.83700f}}},
    {"Au", {{0.143119f, 0.374957f, 1.44248f}, {3.98316f, 2.38572f, 1.60322f}}},
    {"Cr", {{4.36968f, 2.91670f, 1.65470f}, {5.20643f, 4.23136f, 3.75495f}}},
    {"Cu", {{0.200438f, 0.924033f, 1.10221f}, {3.91295f, 2.45285f, 2.14219f}}},
    {"none", {}},
};

template <class T>
const T& look_up_material(const Named<T>& materials, Node at, std::string_view name) {
  const auto message = fmt::format("{}: {} is not known", label(at), in_quotes(name));
  return look_up(materials, name, at, message);
}

/// A default, which stands at the object, is a name.
double parse_index(Node at, std::string_view text, const Range& range) {
  if (at.name() == std::string_view("float")) return parse_number<double>(at, text, range);
  return look_up_material(kRefractiveIndices, at, text);
}

ConductorFresnel parse_metal(Node at, std::string_view text, const Range& /*range*/) {
  return look_up_material(kMetals, at, text);
}

const Kind<double> kIndex{{"float", "string"}, parse_index};
const Kind<ConductorFresnel> kMetal{{"string"}, parse_metal};

const Property kReflectance{kRgb, "reflectance", "0.5",
                            between(0, 1, ": more would create energy")};
const Property kMaterial{kMetal, "material", "none", one_of(names_of(kMetals))};
const Property kEta{kRgb, "eta", "0", between(0, 1000)};
const Property kK{kRgb, "k", "1", between(0, 1000)};
const Property kDistribution{kString, "distribution", kRequired, one_of({"ggx"})};
const Property kAlpha{kFloat, "alpha", "0.1", between(1e-4, 1)};
const Property kAlphaU{kFloat, "alpha_u", "0.1", between(1e-4, 1)};
const Property kAlphaV{kFloat, "alpha_v", "0.1", between(1e-4, 1)};
const Property kGlassIor{kIndex, "int_ior", "bk7", kPositive};
const Property kCoatIor{kIndex, "int_ior", "polypropylene", kPositive};
const Property kExtIor{kIndex, "ext_ior", "air", kPositive};
const Property kExponent{kFloat, "exponent", "30", between(1, 1e6)};
const Property kWeight{kFloat, "weight", kRequired, between(0, 1)};
const Property kThickness{kFloat, "thickness", kRequired, between(0, 2000)};
const Property kFilmIor{kIndex, "film_ior", "water", kPositive};
const Nested kSides{{"bsdf", "ref"}, kRequired, between(1, 2)};
const Nested kPair{{"bsdf", "ref"}, kRequired, between(2, 2)};
const Nested kBase{{"bsdf", "ref"}, kRequired, between(1, 1)};

Rgbf read_reflectance(const Object& object) { return rgb_cast<float>(object[kReflectance]); }

ConductorFresnel read_metal(const Object& object) {
  const bool by_index = object.has(kEta) || object.has(kK);
  object.require(!by_index || !object.has(kMaterial), kMaterial, "either this, or eta and k");
  const ConductorFresnel metal{rgb_cast<float>(object[kEta]), rgb_cast<float>(object[kK])};
  const Rgbf sum = metal.eta() + metal.k();  // near 0 a denominator of Fresnel's equations vanishes
  object.require(std::min({sum.r, sum.g, sum.b}) >= 0.01f, kEta,
                 "η and k must not both be 0: their sum is at least 0.01");
  return by_index ? metal : object[kMaterial];
}

/// What may be rough in Mitsuba's way: its distribution has to be named, as its default is another.
Ggx read_ggx(const Object& object) {
  const bool anisotropic = object.has(kAlphaU) || object.has(kAlphaV);
  object.require(!anisotropic || !object.has(kAlpha), kAlpha,
                 "either this, or alpha_u and alpha_v");
  return {static_cast<float>(object[anisotropic ? kAlphaU : kAlpha]),
          static_cast<float>(object[anisotropic ? kAlphaV : kAlpha])};
}

/// Index inside over the one outside.
double read_eta(const Object& object, const Property<double>& inside, double least) {
  const double eta = object[inside] / object[kExtIor];
  object.require(eta >= least && eta <= kMaxEta, inside,
                 "{:g} times ext_ior: must lie between {:g} and {:g}", eta, least, kMaxEta);
  return eta;
}

void read_dielectric(const Object& object, Reading& in) {
  const double eta = read_eta(object, kGlassIor, 1 / kMaxEta);
  in.add_bsdf(SmoothDielectric{{static_cast<float>(eta)}}, {object[kExtIor], object[kGlassIor]});
}

void read_rough_dielectric(const Object& object, Reading& in) {
  const double eta = read_eta(object, kGlassIor, 1 / kMaxEta);
  object.require(std::abs(eta - 1) >= 1e-3, kGlassIor,
                 "must differ from ext_ior by a thousandth: normals cannot be told otherwise");
  in.add_bsdf(GgxDielectric{read_ggx(object), {static_cast<float>(eta)}},
              {object[kExtIor], object[kGlassIor]});
}

/// BSDFs in another, and what becomes of that with them.
struct Children {
  std::vector<std::uint32_t> indices;
  BsdfContext context;
};

/// Reads <bsdf>s, and finds those that <ref>s name above them.
Children read_children(const std::vector<Node>& nodes, Reading& in) {
  Children children;
  for (const Node node : nodes) {
    const bool is_ref = node.name() == std::string_view("ref");
    const std::uint32_t child = is_ref ? resolve_bsdf(node, in, " above it") : read_bsdf(node, in);
    children.indices.push_back(child);
    children.context.depth = std::max(children.context.depth, in.contexts[child].depth + 1);
  }
  return children;
}

void read_two_sided(const Object& object, Reading& in) {
  const auto [sides, context] = read_children(object[kSides], in);
  for (const std::uint32_t side : sides) {
    if (!in.bsdfs->parts(side).transmission) continue;
    fail(object.node(), "may not hold a BSDF that light passes");
  }
  in.add_bsdf(TwoSided{sides.front(), sides.back()}, context);
}

void read_mixture(const Object& object, Reading& in) {
  const auto [parts, context] = read_children(object[kPair], in);
  in.add_bsdf(Mixture{parts[0], parts[1], static_cast<float>(object[kWeight])}, context);
}

void read_thin_film(const Object& object, Reading& in) {
  const std::uint32_t base = read_children(object[kBase], in).indices.front();
  const BsdfContext& beside = in.contexts[base];
  const double least = std::min(beside.ext_ior, beside.int_ior), most = kMaxEta * beside.ext_ior;
  object.require(object[kFilmIor] >= least && object[kFilmIor] <= most, kFilmIor,
                 "must lie between {:g}, the smaller index beside the film, and {:g}", least, most);
  const FilmLayer film{static_cast<float>(object[kThickness] * beside.ext_ior),
                       static_cast<float>(object[kFilmIor] / beside.ext_ior)};
  const auto coat = [&](const auto& b) -> Bsdf {
    if constexpr (requires { ThinFilm{b, film}; }) {
      return ThinFilm{b, film};
    } else {
      fail(object.node(), "covers a conductor, roughconductor, dielectric or roughdielectric");
    }
  };
  in.add_bsdf(std::visit(coat, in.bsdfs->alternative(base)));
}

}  // namespace

const Named<ObjectType> kBsdfTypes = {
    {"diffuse",
     {{kReflectance},
      [](const Object& object, Reading& in) {
        in.add_bsdf(Lambertian{read_reflectance(object)});
      }}},
    {"conductor",
     {{kMaterial, kEta, kK},
      [](const Object& object, Reading& in) { in.add_bsdf(SmoothConductor{read_metal(object)}); }}},
    {"roughconductor",
     {{kDistribution, kAlpha, kAlphaU, kAlphaV, kMaterial, kEta, kK},
      [](const Object& object, Reading& in) {
        in.add_bsdf(GgxConductor{read_ggx(object), read_metal(object)});
      }}},
    {"dielectric", {{kGlassIor, kExtIor}, read_dielectric}},
    {"roughdielectric",
     {{kDistribution, kAlpha, kAlphaU, kAlphaV, kGlassIor, kExtIor}, read_rough_dielectric}},
    {"twosided", {{kSides}, read_two_sided}},
    {"blendbsdf", {{kWeight, kPair}, read_mixture}},
    {"clearcoat",
     {{kReflectance, kAlpha, kCoatIor, kExtIor},
      [](const Object& object, Reading& in) {
        const double eta = read_eta(object, kCoatIor, 1.01);
        in.add_bsdf(ClearCoat(static_cast<float>(eta), static_cast<float>(object[kAlpha]),
                              read_reflectance(object)));
      }}},
    {"thinfilm", {{kThickness, kFilmIor, kBase}, read_thin_film}},
    {"phong",
     {{kReflectance, kExponent},
      [](const Object& object, Reading& in) {
        in.add_bsdf(ModifiedPhong{read_reflectance(object), static_cast<float>(object[kExponent])});
      }}},
};

std::uint32_t read_bsdf(Node node, Reading& in) {
  if (!read_object(node, kBsdfTypes, in).is_good()) in.add_bsdf(Lambertian{});  // for its <ref>s
  if (in.contexts.back().depth > kMaxBsdfNesting) {
    refuse(node, "BSDFs are nested deeper than {}", kMaxBsdfNesting);
  }
  const auto index = static_cast<std::uint32_t>(in.contexts.size() - 1);
  if (node.attribute("id")) in.bsdfs_by_id.emplace(attribute(node, "id"), index);
  return index;
}

std::uint32_t resolve_bsdf(Node ref, const Reading& in, const char* where) {
  allow_only_attributes(ref, {"id", "name"});
  const std::string id = attribute(ref, "id");
  const auto read = in.bsdfs_by_id.find(id);
  if (read != in.bsdfs_by_id.end()) return read->second;
  if (const auto named = in.ids.find(id); named != in.ids.end()) {
    const std::string tag = tag_of(named->second);
    if (tag == "<bsdf>") refuse(ref, "{} is the id of the <bsdf> around it", in_quotes(id));
    refuse(ref, "id {} is a {}, not a <bsdf>", in_quotes(id), tag);
  }
  refuse_name(ref, fmt::format("no <bsdf> has the id {}{}", in_quotes(id), where), id,
              names_of(in.bsdfs_by_id));
}

}  // namespace plumbline::renderer
