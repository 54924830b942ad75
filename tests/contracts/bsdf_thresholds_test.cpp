#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/core/bsdf/fresnel.h>
#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/mis/heuristics.h>
#include <plumbline/renderer/core/sampling/discrete.h>
#include <plumbline/renderer/core/sampling/warps.h>
#include "threshold.h"

/// The thresholds of math.h, sampling/, mis/ and bsdf/. A row names the place in the core.
namespace plumbline::tests {
namespace {

using renderer::Bsdf;
using renderer::Heuristic;
using renderer::Vec2f;
using renderer::Vec3f;
using renderer::Weighting;

constexpr double kTurn = 2 * 3.14159265358979323846;

float narrow(double x) { return static_cast<float>(x); }

std::vector<Threshold> math_thresholds() {
  using namespace renderer;
  const auto angle = [](float y, float x) { return double{angle_of<float>(y, x)}; };
  const auto there_and_back = [](double z) {
    const Vec3f n = normalize(Vec3f{0.6f, 0.8f, narrow(z)}), v{1, 2, 3};
    const Frame<float> frame(n);
    return double{length(frame.to_world(frame.to_local(v)) - v)};
  };
  return {
      {"math.h safe_sqrt x > 0", float_around(0),
       [](double x) { return double{safe_sqrt(narrow(x))}; }, thrice(0), 4e-23},
      // e^x rounds to 1 up to 2^-25.
      {"math.h exp_minus_1 power == 1, over x", float_around(0x1p-25),
       [](double x) { return double{exp_minus_1(narrow(x))} / x; }, thrice(1), 2e-7},
      {"math.h exp_minus_1 power > 0", float_around(-104),
       [](double x) { return double{exp_minus_1(narrow(x))}; }, thrice(-1)},
      {"math.h log_1_plus sum == 1, over x", float_around(0x1p-24),
       [](double x) { return double{log_1_plus(narrow(x))} / x; }, thrice(1), 2e-7},
      {"math.h sin_cos_turns nearest quarter", float_around(0.125),
       [](double u) { return double{sin_cos_turns(narrow(u)).cos}; }, thrice(std::sqrt(0.5)), 2e-7},
      {"math.h angle_of |x| < |y|", float_around(1), [&](double x) { return angle(1, narrow(x)); },
       thrice(kTurn / 8), 2e-7},
      {"math.h angle_of x < 0", float_around(0), [&](double x) { return angle(1, narrow(x)); },
       thrice(kTurn / 4), 2e-7},
      {"math.h angle_of y < 0, the seam",
       float_around(0),
       [&](double y) { return angle(narrow(y), -1); },
       {-kTurn / 2, kTurn / 2, kTurn / 2},
       2e-7},
      {"math.h Frame n.z >= 0", float_around(0), there_and_back, thrice(0), 2e-6},
  };
}

std::vector<Threshold> sampling_thresholds() {
  using namespace renderer;
  const std::vector<double> weights{1, 1};
  const DiscreteDistribution halves(weights);
  const auto triangle = [](double x, double y) {
    return double{square_to_uniform_triangle_pdf_a(Vec2f{narrow(x), narrow(y)})};
  };
  return {
      {"sampling/warps.h cosine hemisphere w.z > 0", float_around(0),
       [](double z) {
         return double{square_to_cosine_hemisphere_pdf_w(Vec3f{1, 0, narrow(z)})};
       },
       thrice(0), 1e-44},
      {"sampling/warps.h uniform hemisphere w.z >= 0",
       float_around(0),
       [](double z) {
         return double{square_to_uniform_hemisphere_pdf_w(Vec3f{1, 0, narrow(z)})};
       },
       {0, 1 / kTurn, 1 / kTurn},
       1e-7},
      {"sampling/warps.h disk |p| <= 1",
       float_around(1),
       [](double x) {
         return double{square_to_uniform_disk_pdf_a(Vec2f{narrow(x), 0})};
       },
       {2 / kTurn, 2 / kTurn, 0},
       1e-7},
      {"sampling/warps.h triangle b.x >= 0",
       float_around(0),
       [&](double x) { return triangle(x, 0.5); },
       {0, 2, 2}},
      {"sampling/warps.h triangle b.y >= 0",
       float_around(0),
       [&](double y) { return triangle(0.5, y); },
       {0, 2, 2}},
      {"sampling/warps.h triangle b.x + b.y <= 1",
       float_around(1),
       [&](double x) { return triangle(x, 0); },
       {2, 2, 0}},
      {"sampling/discrete.h u < bound, the choice",
       float_around(0.5),
       [=](double u) { return static_cast<double>(halves.sample(narrow(u)).index); },
       {0, 1, 1}},
      {"sampling/discrete.h u < bound, what is left of u",
       float_around(0.5),
       [=](double u) { return double{halves.sample(narrow(u)).u}; },
       {1, 0, 0},
       2e-7},
      {"bsdf/bsdf_sample.h choose_lobe u < probability, the choice",
       float_around(0.3),
       [](double u) { return static_cast<double>(choose_lobe(narrow(u), 0.3f).lobe); },
       {0, 1, 1}},
      {"bsdf/bsdf_sample.h choose_lobe u < probability, what is left of u",
       float_around(0.3),
       [](double u) { return double{choose_lobe(narrow(u), 0.3f).u}; },
       {1, 0, 0},
       2e-7},
  };
}

std::vector<Threshold> mis_thresholds() {
  const auto weight = [](const Weighting& weighting, double a, double b) {
    return double{renderer::mis_weight(weighting, narrow(a), narrow(b))};
  };
  const double tie_double = 1 - renderer::mis_detail::kTieUlps * 0x1p-52;
  return {
      {"mis/heuristics.h kTieUlps, float",
       float_around(1 - 4096 * 0x1p-23),
       [=](double a) { return weight(Heuristic::maximum, a, 1); },
       {0, 0.5, 0.5}},
      {"mis/heuristics.h kTieUlps, double",
       double_around(tie_double),
       [](double a) { return renderer::mis_weight(Heuristic::maximum, a, 1.0); },
       {0, 0.5, 0.5}},
      {"mis/heuristics.h cutoff relative >= parameter",
       float_around(0.1f),
       [=](double a) { return weight(Heuristic::cutoff, a, 1); },
       {0, 1 / 11.0, 1 / 11.0},
       1e-7},
      {"mis/heuristics.h power parameter == 1", double_around(1),
       [=](double beta) {
         return weight({Heuristic::power, beta}, 0.25, 1);
       },
       thrice(0.2), 1e-7},
      {"mis/heuristics.h power parameter == 2", double_around(2),
       [=](double beta) {
         return weight({Heuristic::power, beta}, 0.25, 1);
       },
       thrice(1 / 17.0), 1e-7},
      {"mis/heuristics.h pdf_a > pdf_b", float_around(1),
       [=](double a) { return weight(Heuristic::power, a, 1); }, thrice(0.5), 2e-7},
      // Densities are not negative: below 0 stands 0 once more.
      {"mis/heuristics.h pdf_a > 0",
       {0, 0, double{std::numeric_limits<float>::denorm_min()}},
       [=](double a) { return weight(Heuristic::balance, a, 0); },
       {0, 0, 1}},
  };
}

/// Whether any of many samples gives a direction.
double samples(const std::vector<Bsdf>& bsdfs, double z) {
  const auto set = renderer::make_bsdfs(bsdfs);
  const auto last = static_cast<std::uint32_t>(set->size()) - 1;
  for (int i = 0; i < 64; ++i) {
    const Vec2f u{narrow((i % 8 + 0.5) / 8), narrow((i / 8 + 0.5) / 8)};
    if (set->sample(last, Vec3f{1, 0, narrow(z)}, u)) return 1;
  }
  return 0;
}

std::vector<Threshold> horizon_thresholds() {
  using namespace renderer;
  const Rgbf white{1, 1, 1};
  const Ggx rough{0.3f, 0.3f};
  std::vector<Threshold> rows;
  const std::vector<Bsdf> one_sided{Lambertian{white}, ModifiedPhong{white, 3},
                                    GgxConductor{rough, {}}, SmoothConductor{}};
  for (const Bsdf& bsdf : one_sided) {
    rows.push_back({"bsdf/*.h wo.z > 0, alternative " + std::to_string(bsdf.index()),
                    float_around(0),
                    [=](double z) { return samples({bsdf}, z); },
                    {0, 0, 1}});
  }
  for (const Bsdf& bsdf : {Bsdf{SmoothDielectric{{1.5f}}}, Bsdf{GgxDielectric{rough, {1.5f}}}}) {
    rows.push_back({"bsdf/*dielectric.h wo.z == 0, alternative " + std::to_string(bsdf.index()),
                    float_around(0),
                    [=](double z) { return samples({bsdf}, z); },
                    {1, 0, 1}});
  }
  rows.push_back({"bsdf/two_sided.h wo.z < 0: along the surface it is the front's",
                  float_around(0),
                  [=](double z) {
                    return samples({Lambertian{white}, TwoSided{0, 0}}, z);
                  },
                  {1, 0, 1}});
  const auto pdf = [](const auto& bsdf, double z) {
    return double{bsdf.pdf(normalize(Vec3f{1, 0, 1}), Vec3f{1, 0, narrow(z)})};
  };
  const GgxConductor metal{rough, {}};
  rows.push_back({"bsdf/ggx_conductor.h wi.z > 0, pdf",
                  float_around(0),
                  [=](double z) { return pdf(metal, z); },
                  {0, 0, pdf(metal, 1e-6)},
                  1e-5});
  // Where wi is wo at 45° the lobe of the mirror direction is 90° away.
  rows.push_back({"bsdf/modified_phong.h one_minus_cos < 1, pdf", float_around(std::sqrt(0.5)),
                  [=](double x) {
                    const Vec3f wo = normalize(Vec3f{1, 0, 1});
                    return double{ModifiedPhong{white, 2}.pdf(wo, {narrow(x), 0, wo.z})};
                  },
                  thrice(0), 1e-12});
  return rows;
}

std::vector<Threshold> fresnel_thresholds() {
  using namespace renderer;
  const auto reflected = [](float eta, double cos2, bool outside) {
    return double{BareInterface{eta}.split<float>(cos2, outside).reflected};
  };
  const double critical = 1 - 1 / 2.25;  // cos² for 1.5 from inside
  const ConductorFresnel gold{{0.18f, 0.42f, 1.37f}, {3.42f, 2.35f, 1.77f}};
  const auto of_gold = [=](double cosine) { return double{gold(narrow(cosine * cosine)).r}; };
  const auto exact = [=](double cosine) { return gold(cosine * cosine).r; };
  const GgxDielectric glass{{0.3f, 0.3f}, {1.5f}};
  const auto choice = [=](double z) {
    return double{glass.lobe_probability(Vec3f{0, 0, narrow(z)}, 0)};
  };
  std::vector<Threshold> rows{
      {"bsdf/fresnel.h eta == 1", float_around(1),
       [=](double eta) { return reflected(narrow(eta), 0.25, true); }, thrice(0), 1e-12},
      {"bsdf/fresnel.h eta == 1 along the surface: only no step at all reflects nothing",
       float_around(1),
       [=](double eta) { return reflected(narrow(eta), 0, true); },
       {1, 0, 1}},
      {"bsdf/fresnel.h eta > 1, from inside", float_around(1),
       [=](double eta) { return reflected(narrow(eta), 0.25, false); }, thrice(0), 1e-12},
      {"bsdf/fresnel.h thin > 0, the critical angle", double_around(critical),
       [=](double cos2) { return reflected(1.5f, cos2, false); }, thrice(1), 1e-6},
      {"bsdf/fresnel.h thin > 0, along the surface", double_around(0),
       [=](double cos2) { return reflected(1.5f, cos2, true); }, thrice(1), 1e-6},
      {"bsdf/ggx_dielectric.h wo.z wi.z == 0, pdf > 0",
       float_around(0),
       [=](double z) {
         return glass.pdf(normalize(Vec3f{1, 0, 1}), Vec3f{1, 0, narrow(z)}) > 0 ? 1.0 : 0.0;
       },
       {0, 0, 1}},
      // Where (η − k)(η + k) = sin²: the smaller part of the root changes places. The mean of two
      // places 1e-5 away is off by their curvature, 1.15e-10.
      {"bsdf/fresnel.h difference > 0, a conductor", double_around(0.5),
       [](double cosine) { return fresnel_conductor(cosine, 1.0, 0.5); },
       thrice((fresnel_conductor(0.5 - 1e-5, 1.0, 0.5) + fresnel_conductor(0.5 + 1e-5, 1.0, 0.5)) /
              2),
       2e-10},
      {"bsdf/ggx_dielectric.h wo.z > 0, a table for each side",
       float_around(0),
       choice,
       {0.95, 0.95, choice(1e-6)},
       1e-4},
      {"bsdf/ggx_dielectric.h kLeastProbability, head-on", float_around(1),
       [](double z) {
         const GgxDielectric thin{{0.02f, 0.02f}, {1.5f}};
         return double{thin.lobe_probability(Vec3f{0, 0, narrow(z)}, 0)};
       },
       thrice(0.05), 1e-7}};
  for (const double node : {1.0 / 64, 0.5, 63.0 / 64, 1.0}) {
    rows.push_back({"bsdf/ggx_dielectric.h node of the table " + std::to_string(node),
                    float_around(node), choice, thrice(choice(node)), 1e-6});
  }
  for (const double node : {1.0 / 16, 0.25, 0.5, 1.0}) {
    rows.push_back({"bsdf/reflectance_table.h piece of the table " + std::to_string(node),
                    float_around(node), of_gold, thrice(exact(node)), 1e-5});
  }
  return rows;
}

TEST(Thresholds, OfScalarHelpersDoNotShow) { expect_all_hold(math_thresholds()); }
TEST(Thresholds, OfWarpsAndChoicesTakeTheSideThatIsStated) {
  expect_all_hold(sampling_thresholds());
}
TEST(Thresholds, OfHeuristics) { expect_all_hold(mis_thresholds()); }
TEST(Thresholds, OfTheHorizon) { expect_all_hold(horizon_thresholds()); }
TEST(Thresholds, OfFresnelAndItsTablesDoNotShow) { expect_all_hold(fresnel_thresholds()); }

}  // namespace
}  // namespace plumbline::tests
