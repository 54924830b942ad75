#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include <plumbline/renderer/scene_file/load_scene.h>
#include "refusal.h"
#include "scene_text.h"

/// Every <bsdf> type with its defaults and its values, and how it is refused.
namespace plumbline::tests {
namespace {

using namespace renderer;

/// The BSDF of a sphere whose <bsdf> has that type and content.
template <class B>
B read(const std::string& type, const std::string& content = {}) {
  const SceneDescription scene = load_body("<shape type=\"sphere\"><bsdf type=\"" + type + "\">" +
                                           content + "</bsdf></shape>");
  return std::get<B>(bsdf_of(scene, scene.shapes.at(0).bsdf));
}

const std::string kGgx = R"(<string name="distribution" value="ggx"/>)";
constexpr double kAir = 1.000277;

TEST(SceneBsdf, ConductorsAreLosslessUnlessAMaterialOrIndicesAreGiven) {
  EXPECT_EQ(read<SmoothConductor>("conductor").fresnel.eta(), (Rgbf{0, 0, 0}));
  EXPECT_EQ(read<SmoothConductor>("conductor").fresnel.k(), (Rgbf{1, 1, 1}));
  const auto gold =
      read<SmoothConductor>("conductor", R"(<string name="material" value="Au"/>)").fresnel;
  EXPECT_EQ(gold.eta(), (Rgbf{0.143119f, 0.374957f, 1.44248f}));
  EXPECT_EQ(gold.k(), (Rgbf{3.98316f, 2.38572f, 1.60322f}));
  const auto stated = read<SmoothConductor>("conductor", R"(<rgb name="eta" value="0.2, 0.9, 1.1"/>
                                          <rgb name="k" value="3.9, 2.4, 2.1"/>)")
                          .fresnel;
  EXPECT_EQ(stated.eta(), (Rgbf{0.2f, 0.9f, 1.1f}));
  EXPECT_EQ(stated.k(), (Rgbf{3.9f, 2.4f, 2.1f}));
}

TEST(SceneBsdf, RoughnessHasMitsubasDefaultAndTwoAxes) {
  const auto isotropic = read<GgxConductor>("roughconductor", kGgx);
  EXPECT_EQ(isotropic.ggx.alpha_x, 0.1f);
  EXPECT_EQ(isotropic.ggx.alpha_y, 0.1f);
  EXPECT_EQ(isotropic.fresnel.k(), (Rgbf{1, 1, 1}));
  EXPECT_EQ(read<GgxConductor>("roughconductor", kGgx + R"(<float name="alpha" value="0.3"/>)")
                .ggx.alpha_y,
            0.3f);
  const auto anisotropic = read<GgxConductor>(
      "roughconductor",
      kGgx + R"(<float name="alpha_v" value="0.5"/><string name="material" value="Cu"/>)");
  EXPECT_EQ(anisotropic.ggx.alpha_x, 0.1f);
  EXPECT_EQ(anisotropic.ggx.alpha_y, 0.5f);
  EXPECT_EQ(anisotropic.fresnel.eta(), (Rgbf{0.200438f, 0.924033f, 1.10221f}));
}

TEST(SceneBsdf, DielectricsTakeIndicesAsNumbersAndAsNames) {
  EXPECT_EQ(read<SmoothDielectric>("dielectric").interface.eta, static_cast<float>(1.5046 / kAir));
  const std::string names =
      R"(<string name="int_ior" value="water"/><string name="ext_ior" value="vacuum"/>)";
  EXPECT_EQ(read<SmoothDielectric>("dielectric", names).interface.eta, 1.333f);
  const std::string numbers =
      R"(<float name="int_ior" value="1"/><float name="ext_ior" value="1.6"/>)";
  EXPECT_EQ(read<SmoothDielectric>("dielectric", numbers).interface.eta, 0.625f);
  const auto rough = read<GgxDielectric>("roughdielectric",
                                         kGgx + numbers + R"(<float name="alpha" value="0.25"/>)");
  EXPECT_EQ(rough.interface.eta, 0.625f);
  EXPECT_EQ(rough.ggx.alpha_x, 0.25f);
}

TEST(SceneBsdf, PhongClearCoatAndThinFilmAreOurOwn) {
  EXPECT_EQ(read<ModifiedPhong>("phong").exponent, 30);
  EXPECT_EQ(read<ModifiedPhong>("phong").reflectance, (Rgbf{0.5f, 0.5f, 0.5f}));
  const auto coat = read<ClearCoat>("clearcoat", R"(<rgb name="reflectance" value="0.8, 0, 0.1"/>
      <float name="alpha" value="0.2"/><float name="int_ior" value="1.5"/>
      <float name="ext_ior" value="1"/>)");
  EXPECT_EQ(coat.base_albedo(), (Rgbf{0.8f, 0, 0.1f}));
  EXPECT_EQ(coat.alpha(), 0.2f);
  EXPECT_EQ(coat.eta(), 1.5f);
  EXPECT_EQ(read<ClearCoat>("clearcoat").eta(), static_cast<float>(1.49 / kAir));
  const auto on_metal = read<ThinFilm>(
      "thinfilm", R"(<float name="thickness" value="300"/><bsdf type="conductor"/>)");
  EXPECT_TRUE(std::holds_alternative<SmoothConductor>(on_metal.base()));
  EXPECT_EQ(on_metal.film().thickness, 300);
  EXPECT_EQ(on_metal.film().eta, 1.333f);
  // Under water both are relative to the water's index, 1.333.
  const auto on_glass = read<ThinFilm>(
      "thinfilm", R"(<float name="thickness" value="100"/><float name="film_ior" value="1.9995"/>
      <bsdf type="dielectric"><string name="ext_ior" value="water"/></bsdf>)");
  EXPECT_FLOAT_EQ(on_glass.film().eta, 1.5f);
  EXPECT_FLOAT_EQ(on_glass.film().thickness, 133.3f);
}

TEST(SceneBsdf, NestedOnesAreIndicesIntoTheSet) {
  const SceneDescription scene = load_body(R"(
      <bsdf type="diffuse" id="grey"/>
      <bsdf type="twosided" id="both">
        <bsdf type="blendbsdf">
          <float name="weight" value="0.25"/>
          <ref id="grey"/>
          <bsdf type="conductor"/>
        </bsdf>
        <ref id="grey"/>
      </bsdf>
      <shape type="sphere"><ref id="both"/></shape>)");
  const auto& both = std::get<TwoSided>(bsdf_of(scene, scene.shapes.at(0).bsdf));
  const auto& blend = std::get<Mixture>(bsdf_of(scene, both.front));
  EXPECT_EQ(both.back, blend.first);
  EXPECT_TRUE(std::holds_alternative<Lambertian>(bsdf_of(scene, blend.first)));
  EXPECT_TRUE(std::holds_alternative<SmoothConductor>(bsdf_of(scene, blend.second)));
  EXPECT_EQ(blend.weight, 0.25f);
  EXPECT_LT(std::max(blend.first, blend.second), both.front);  // children come first
}

TEST(SceneBsdf, OneNestedInATwoSidedIsOnBothSides) {
  const auto both = read<TwoSided>("twosided", "<bsdf type=\"diffuse\"/>");
  EXPECT_EQ(both.front, both.back);
}

/// `levels` mixtures of the one before with itself.
std::string chain(int levels) {
  std::string body = "<bsdf type=\"diffuse\" id=\"b0\"/>";
  for (int i = 1; i <= levels; ++i) {
    const std::string ref = "<ref id=\"b" + std::to_string(i - 1) + "\"/>";
    body += "\n<bsdf type=\"blendbsdf\" id=\"b" + std::to_string(i) +
            "\"><float name=\"weight\" value=\"0.5\"/>" + ref + ref + "</bsdf>";
  }
  return body;
}

TEST(SceneBsdf, ReferencesDoNotBuildTowers) {
  const std::string shape = "\n<shape type=\"sphere\"/>";
  EXPECT_EQ(load_body(chain(8) + shape).bsdfs->size(), 10u);
  EXPECT_EQ(refusal_of_text(scene_with(chain(9) + shape)),
            "scene.xml:12: BSDFs are nested deeper than 8");
}

class RefusedBsdf : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedBsdf, SaysWhereAndWhy) {
  EXPECT_EQ(refusal_of_text(scene_with(GetParam().text)),
            std::string("scene.xml:") + GetParam().expected);
}

const std::vector<Refusal> kRefusals = {
    {"NoDistribution", R"(<bsdf type="roughconductor" id="a"/>)",
     R"(3: <bsdf type="roughconductor"> needs <string name="distribution" value="ggx">)"},
    {"Beckmann",
     "<bsdf type=\"roughconductor\" id=\"a\">\n"
     R"(<string name="distribution" value="beckmann"/></bsdf>)",
     R"(4: <string name="distribution">: "beckmann" is not supported; write ggx, whose tails are longer)"},
    {"AlphaOutOfRange",
     R"(<bsdf type="roughconductor" id="a"><float name="alpha" value="1e-5"/></bsdf>)",
     R"(3: <float name="alpha">: must lie between 0.0001 and 1)"},
    {"AlphaTwice",
     "<bsdf type=\"roughdielectric\" id=\"a\"><float name=\"alpha\" value=\"0.1\"/>\n"
     R"(<string name="distribution" value="ggx"/><float name="alpha_u" value="0.1"/></bsdf>)",
     R"(3: <float name="alpha">: either this, or alpha_u and alpha_v)"},
    {"MisspeltAlpha",
     "<bsdf type=\"roughconductor\" id=\"a\"><string name=\"distribution\" value=\"ggx\"/>\n"
     R"(<float name="alhpa" value="0.1"/></bsdf>)",
     R"(4: <bsdf type="roughconductor"> has no property "alhpa"; did you mean "alpha"?)"},
    {"UnknownMetal",
     R"(<bsdf type="conductor" id="a"><string name="material" value="Unobtainium"/></bsdf>)",
     "3: <string name=\"material\">: \"Unobtainium\" is not known; supported: Ag, Al, Au, Cr, Cu, "
     "none"},
    {"MaterialAndIndices",
     R"(<bsdf type="conductor" id="a"><string name="material" value="Au"/><rgb name="k" value="1"/></bsdf>)",
     R"(3: <string name="material">: either this, or eta and k)"},
    {"NoIndexAtAll",
     R"(<bsdf type="conductor" id="a"><rgb name="eta" value="0"/><rgb name="k" value="0"/></bsdf>)",
     R"(3: <rgb name="eta">: η and k must not both be 0: their sum is at least 0.01)"},
    {"MetalOfNearlyNothing",
     "<bsdf type=\"conductor\" id=\"a\"><rgb name=\"eta\" value=\"0.006\"/>"
     "<rgb name=\"k\" value=\"1, 0.003, 1\"/></bsdf>",
     R"(3: <rgb name="eta">: η and k must not both be 0: their sum is at least 0.01)"},
    {"NegativeK", R"(<bsdf type="conductor" id="a"><rgb name="k" value="1, -1, 1"/></bsdf>)",
     R"(3: <rgb name="k">: must lie between 0 and 1000)"},
    {"UnknownGlass",
     R"(<bsdf type="dielectric" id="a"><string name="int_ior" value="bk8"/></bsdf>)",
     R"(3: <string name="int_ior">: "bk8" is not known; did you mean "bk7"?)"},
    {"IndexOfZero", R"(<bsdf type="dielectric" id="a"><float name="ext_ior" value="0"/></bsdf>)",
     R"(3: <float name="ext_ior">: must be positive)"},
    {"IndexTooHigh",
     R"(<bsdf type="dielectric" id="a"><float name="int_ior" value="3"/><float name="ext_ior" value="1"/></bsdf>)",
     R"(3: <float name="int_ior">: 3 times ext_ior: must lie between 0.4 and 2.5)"},
    {"RoughWithoutAStep",
     R"(<bsdf type="roughdielectric" id="a"><string name="distribution" value="ggx"/><string name="int_ior" value="air"/></bsdf>)",
     R"(3: <string name="int_ior">: must differ from ext_ior by a thousandth: normals cannot be told otherwise)"},
    {"ClearCoatOfAir",
     R"(<bsdf type="clearcoat" id="a"><string name="int_ior" value="air"/></bsdf>)",
     R"(3: <string name="int_ior">: 1 times ext_ior: must lie between 1.01 and 2.5)"},
    {"ExponentTooHigh", R"(<bsdf type="phong" id="a"><float name="exponent" value="2e6"/></bsdf>)",
     R"(3: <float name="exponent">: must lie between 1 and 1e+06)"},
    {"PhongThatCreatesEnergy",
     R"(<bsdf type="phong" id="a"><rgb name="reflectance" value="1.5"/></bsdf>)",
     R"(3: <rgb name="reflectance">: must lie between 0 and 1: more would create energy)"},
    {"TwoSidedOfNothing", R"(<bsdf type="twosided" id="a"/>)",
     R"(3: <bsdf type="twosided">: nests 1 or 2 BSDFs: <bsdf> or <ref>)"},
    {"TwoSidedGlass",
     "<bsdf type=\"twosided\" id=\"a\"><bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf>\n"
     R"(<bsdf type="dielectric"/></bsdf>)",
     R"(3: <bsdf type="twosided">: may not hold a BSDF that light passes)"},
    {"BlendWithoutWeight",
     R"(<bsdf type="blendbsdf" id="a"><bsdf type="diffuse"/><bsdf type="diffuse"/></bsdf>)",
     R"(3: <bsdf type="blendbsdf"> needs <float name="weight">)"},
    {"BlendOfThree",
     R"(<bsdf type="blendbsdf" id="a"><float name="weight" value="0.5"/><bsdf type="diffuse"/><bsdf type="diffuse"/><bsdf type="diffuse"/></bsdf>)",
     R"(3: <bsdf type="blendbsdf">: nests 2 BSDFs: <bsdf> or <ref>)"},
    {"BlendTooHeavy", R"(<bsdf type="blendbsdf" id="a"><float name="weight" value="1.5"/></bsdf>)",
     R"(3: <float name="weight">: must lie between 0 and 1)"},
    {"NestedRefToALaterBsdf",
     "<bsdf type=\"twosided\" id=\"a\">\n<ref id=\"b\"/></bsdf><bsdf type=\"diffuse\" id=\"b\"/>",
     R"(4: no <bsdf> has the id "b" above it)"},
    {"NestedRefToItself", "<bsdf type=\"twosided\" id=\"a\">\n<ref id=\"a\"/></bsdf>",
     R"(4: "a" is the id of the <bsdf> around it)"},
    {"FilmWithoutThickness", R"(<bsdf type="thinfilm" id="a"><bsdf type="conductor"/></bsdf>)",
     R"(3: <bsdf type="thinfilm"> needs <float name="thickness">)"},
    {"FilmTooThick",
     R"(<bsdf type="thinfilm" id="a"><float name="thickness" value="2001"/></bsdf>)",
     R"(3: <float name="thickness">: must lie between 0 and 2000)"},
    {"FilmOnChalk",
     R"(<bsdf type="thinfilm" id="a"><float name="thickness" value="300"/><bsdf type="diffuse"/></bsdf>)",
     R"(3: <bsdf type="thinfilm">: covers a conductor, roughconductor, dielectric or roughdielectric)"},
    {"FilmThatTunnels",
     R"(<bsdf type="thinfilm" id="a"><float name="thickness" value="300"/><float name="film_ior" value="0.9"/><bsdf type="dielectric"/></bsdf>)",
     R"(3: <float name="film_ior">: must lie between 1.00028, the smaller index beside the film, and 2.50069)"},
};

INSTANTIATE_TEST_SUITE_P(All, RefusedBsdf, testing::ValuesIn(kRefusals), name_of);

}  // namespace
}  // namespace plumbline::tests
