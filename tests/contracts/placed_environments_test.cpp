#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/core/render/vertex.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/core/sampling/warps.h>
#include <plumbline/renderer/image_io/exr.h>
#include <plumbline/renderer/scene_file/load_scene.h>

#include "placed_scene.h"

/// Light from far away, through the loader, with every parameter off its default: what `sample`
/// says of radiance and density is what a ray that escapes finds, and what is known of the sky.
namespace plumbline::tests {
namespace {

using renderer::Rgbd;
using renderer::Vec3d;
using renderer::Vec3f;

constexpr double kUlp24 = 0x1p-24;

/// What is known of a sky before it is loaded.
struct KnownSky {
  std::string name, xml;
  std::function<Rgbd(const Vec3d& wi)> radiance;
  std::function<double(const Vec3d& wi)> pdf;  ///< pdf_w [1/sr] of its samples
  std::function<bool(const Vec3d& wi)> clear;  ///< not so near to a jump that float may cross it
  double brightness;  ///< integral of the luminance over the sphere [W/m²]
  double choice = 0;  ///< relative error of the densities from choices among pixels
};

void PrintTo(const KnownSky& sky, std::ostream* out) { *out << sky.name; }

double luminance_709(const Rgbd& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

KnownSky constant_sky() {
  const Rgbd sky{1, 3, 2};
  const double sphere = 4 * renderer::pi<double>();
  return {"Constant",
          R"(<emitter type="constant"><rgb name="radiance" value="1 3 2"/></emitter>)",
          [=](const Vec3d&) { return sky; },
          [=](const Vec3d&) { return 1 / sphere; },
          [](const Vec3d&) { return true; },
          sphere * luminance_709(sky)};
}

/// A sun of 20° with or without a sky, to which its radiance adds. Half of the samples go to each,
/// all to the sun where there is no sky.
KnownSky sun(bool with_sky) {
  const Vec3d to_sun = normalize(Vec3d{-0.3, 0.5, 0.8});
  const double cosine = std::cos(renderer::pi<double>() / 9);
  const double cone = 2 * renderer::pi<double>() * (1 - cosine);
  const double rest = 4 * renderer::pi<double>() - cone;
  const Rgbd disk{40, 20, 30}, sky = with_sky ? Rgbd{1, 3, 2} : Rgbd{};
  const double share = with_sky ? 0.5 : 1;
  std::string xml = R"(<emitter type="sun"><vector name="direction" value="0.3 -0.5 -0.8"/>
      <float name="half_angle" value="20"/><rgb name="radiance" value="40 20 30"/></emitter>)";
  if (with_sky) xml += constant_sky().xml;
  return {
      with_sky ? "SunAndSky" : "Sun",
      xml,
      [=](const Vec3d& wi) { return dot(wi, to_sun) > cosine ? disk + sky : sky; },
      [=](const Vec3d& wi) { return dot(wi, to_sun) > cosine ? share / cone : (1 - share) / rest; },
      [=](const Vec3d& wi) { return std::abs(dot(wi, to_sun) - cosine) > 1e-5; },
      cone * luminance_709(disk) + 4 * renderer::pi<double>() * luminance_709(sky)};
}

constexpr int kColumns = 6, kRows = 4;
constexpr double kMapScale = 2.5;

/// No two pixels alike, none grey, one of them bright.
Rgbd map_pixel(int column, int row) {
  const double bright = column == 4 && row == 1 ? 10 : 1;
  return Rgbd{1.0 + column, 4.0 - row, 0.5 * ((column + 2 * row) % 5)} * bright;
}

/// A map turned and mirrored: +y of its frame is up, −z at its left edge, +x a quarter to the
/// right.
class KnownMap {
 public:
  explicit KnownMap(bool compensation) {
    double mean = 0;
    for_each_pixel([&](int c, int r) {
      mean += luminance_709(map_pixel(c, r)) * solid_angle(r) / (4 * renderer::pi<double>());
    });
    floor_ = compensation ? mean : 0;
    mean_ = mean;
    for_each_pixel([&](int c, int r) { total_ += weight(c, r) * solid_angle(r); });
  }

  const Placement& placement() const { return placement_; }
  double mean_luminance() const { return mean_; }

  Rgbd radiance(const Vec3d& wi) const {
    const Pixel p = pixel(wi);
    return map_pixel(static_cast<int>(p.x), static_cast<int>(p.y)) * kMapScale;
  }
  double pdf(const Vec3d& wi) const {
    const Pixel p = pixel(wi);
    return weight(static_cast<int>(p.x), static_cast<int>(p.y)) / total_;
  }

  /// Relative, of the density of the pixel that is chosen least often: probabilities of a row, and
  /// of a column in it, are right to two units.
  double choice_error() const {
    double largest = 0;
    for_each_pixel([&](int c, int r) {
      double row = 0;
      for (int i = 0; i < kColumns; ++i) row += weight(i, r);
      if (weight(c, r) == 0) return;
      const double of_rows = row * solid_angle(r) / total_, of_columns = weight(c, r) / row;
      largest = std::max(largest, 2 * kUlp24 * (1 / of_rows + 1 / of_columns));
    });
    return largest;
  }

  bool clear(const Vec3d& wi) const {
    const Pixel p = pixel(wi);
    return std::abs(p.x - std::round(p.x)) > 1e-4 && std::abs(p.y - std::round(p.y)) > 1e-4;
  }

 private:
  struct Pixel {
    double x, y;
  };

  template <class Function>
  static void for_each_pixel(const Function& function) {
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) function(column, row);
    }
  }
  static double solid_angle(int row) {
    const double step = renderer::pi<double>() / kRows;
    return 2 * renderer::pi<double>() / kColumns *
           (std::cos(row * step) - std::cos((row + 1) * step));
  }
  double weight(int column, int row) const {
    return std::max(luminance_709(map_pixel(column, row)) - floor_, 0.0);
  }
  Pixel pixel(const Vec3d& wi) const {
    const Vec3d m = placement_.inverse_vector(wi);
    const double turn = std::atan2(m.x, -m.z) / (2 * renderer::pi<double>());
    return {(turn < 0 ? turn + 1 : turn) * kColumns,
            std::acos(m.y) / renderer::pi<double>() * kRows};
  }

  Placement placement_{{0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {-0.48, -0.64, -0.6}, {}};
  double floor_ = 0, mean_ = 0, total_ = 0;
};

KnownSky mapped_sky(bool compensation) {
  const KnownMap map(compensation);
  std::string xml = "<emitter type=\"envmap\"><string name=\"filename\" value=\"map.exr\"/>";
  xml += fmt::format("<float name=\"scale\" value=\"{}\"/>", kMapScale) + map.placement().xml();
  if (compensation) xml += R"(<boolean name="mis_compensation" value="true"/>)";
  return {compensation ? "MapCompensated" : "Map",
          xml + "</emitter>",
          [=](const Vec3d& wi) { return map.radiance(wi); },
          [=](const Vec3d& wi) { return map.pdf(wi); },
          [=](const Vec3d& wi) { return map.clear(wi); },
          4 * renderer::pi<double>() * map.mean_luminance() * kMapScale,
          map.choice_error()};
}

/// The sky around the unit sphere, which emits too, so that the choice of a light matters.
renderer::SceneDescription load_sky(const KnownSky& sky) {
  const ScratchDirectory directory;
  renderer::Image image{kColumns, kRows, {}, {}, {}, {}};
  for (int i = 0; i < kColumns * kRows; ++i) {
    image.pixels.push_back(renderer::rgb_cast<float>(map_pixel(i % kColumns, i / kColumns)));
  }
  write_exr(directory.path() / "map.exr", image);
  return renderer::load_scene(directory.write(
      "scene.xml",
      R"(<scene version="3.0.0"><sensor type="perspective"><float name="fov" value="60"/>
          <film type="hdrfilm"><rfilter type="box"/></film></sensor><shape type="sphere">
          <emitter type="area"><rgb name="radiance" value="5 1 9"/></emitter></shape>)" +
          sky.xml + "</scene>"));
}

/// Probability that the sky is chosen and not the sphere, whose bounding sphere has radius √3.
double sky_pmf(const KnownSky& sky, renderer::LightSelection selection) {
  if (selection != renderer::LightSelection::power) return 0.5;  // without a surface: the average
  const double sphere =
      renderer::pi<double>() * 4 * renderer::pi<double>() * luminance_709({5, 1, 9});
  const double power = 3 * renderer::pi<double>() * sky.brightness;
  return power / (power + sphere);
}

void expect_rgb_near(const renderer::Rgbf& actual, const Rgbd& expected) {
  // A product of two floats, each of which was rounded.
  EXPECT_NEAR(static_cast<double>(actual.r), expected.r, 4 * kUlp24 * expected.r);
  EXPECT_NEAR(static_cast<double>(actual.g), expected.g, 4 * kUlp24 * expected.g);
  EXPECT_NEAR(static_cast<double>(actual.b), expected.b, 4 * kUlp24 * expected.b);
}

class PlacedEnvironments : public testing::TestWithParam<KnownSky> {
 protected:
  /// What a ray that escapes along wi finds, and how MIS weighs it.
  static void expect_known(const renderer::Scene& scene, const Vec3f& wi, double pmf) {
    const Vec3d along = renderer::vec_cast<double>(wi);
    if (!GetParam().clear(normalize(along))) return;
    const Vec3f ref{5, 4, 3};
    if (const auto hit = scene.intersect({ref, wi})) return;
    const renderer::Emission seen = emission_seen(scene, std::nullopt, wi);
    ASSERT_EQ(seen.light, scene.environment());
    expect_rgb_near(seen.radiance, GetParam().radiance(normalize(along)));
    expect_pdf(static_cast<double>(scene.lights().pdf_at_hit(seen.light, ref, wi)), along, pmf);
  }

  static void expect_pdf(double actual, const Vec3d& along, double pmf) {
    const double pdf = pmf * GetParam().pdf(normalize(along));
    // Choices come in multiples of 2^-24; sines and cosines of pixels and cones in a few more.
    const double tolerance = 32 * kUlp24 + 2 * kUlp24 / pmf + GetParam().choice;
    EXPECT_NEAR(actual, pdf, tolerance * pdf);
  }

  static int expect_known_samples(const renderer::Scene& scene, double pmf,
                                  renderer::Pcg32& random) {
    int compared = 0;
    for (int i = 0; i < 400 && !HasFailure(); ++i) {
      const renderer::Vec2f u = random.next_2d();
      expect_known(scene, renderer::square_to_uniform_sphere(random.next_2d()), pmf);
      if (scene.lights().choose(u).light != scene.environment()) continue;
      const auto sample = scene.lights().sample(Vec3f{5, 4, 3}, u);
      EXPECT_TRUE(sample) << "the sky is on all sides";
      const Vec3d along = normalize(renderer::vec_cast<double>(sample->wi));
      if (!GetParam().clear(along)) continue;
      EXPECT_EQ(sample->distance, std::numeric_limits<float>::infinity());
      EXPECT_EQ(sample->cos_light, 1.0f) << "it faces every point";
      expect_rgb_near(sample->radiance, GetParam().radiance(along));
      expect_pdf(static_cast<double>(sample->pdf_w), along, pmf);
      expect_known(scene, sample->wi, pmf);
      ++compared;
    }
    return compared;
  }
};

TEST_P(PlacedEnvironments, SayOfASampleWhatARayThatEscapesFinds) {
  renderer::SceneDescription description = load_sky(GetParam());
  renderer::Pcg32 random(check_seed("placed environment " + GetParam().name), 0, 0);
  for (const renderer::LightSelection selection : renderer::kLightSelections) {
    SCOPED_TRACE(name(selection));
    description.light_selection = selection;
    const renderer::Scene scene = renderer::make_scene(description);
    const double pmf = sky_pmf(GetParam(), selection);
    EXPECT_NEAR(static_cast<double>(scene.lights().pmf<float>(scene.environment())), pmf,
                2 * kUlp24 + 4 * kUlp24 * pmf);
    // Of 400, at least the 0.5 of uniform selection and the 0.4 of the sun alone by power.
    EXPECT_GT(expect_known_samples(scene, pmf, random), 80);
  }
}

std::string sky_name(const testing::TestParamInfo<KnownSky>& sky) { return sky.param.name; }

INSTANTIATE_TEST_SUITE_P(All, PlacedEnvironments,
                         testing::Values(constant_sky(), sun(true), sun(false), mapped_sky(false),
                                         mapped_sky(true)),
                         sky_name);

}  // namespace
}  // namespace plumbline::tests
