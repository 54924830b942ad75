#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/core/render/vertex.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include <plumbline/renderer/core/sampling/warps.h>
#include <plumbline/renderer/scene_file/load_scene.h>

#include "placed_scene.h"

/// Every shape that emits, through the loader, under every flip, mirroring, affine map, selection
/// and way of sampling: what `sample` says of distance, side, normal, radiance and density is what
/// a ray finds there, and what is known of the shape without either.
namespace plumbline::tests {
namespace {

using renderer::LightSample;
using renderer::LightSelection;
using renderer::Pcg32;
using renderer::Rgbf;
using renderer::Scene;
using renderer::SceneDescription;
using renderer::Vec3d;
using renderer::Vec3f;

constexpr double kUlp = 0x1p-24;
/// Of the probability of a choice: a multiple of 2⁻²⁴, of which one is given to each light for
/// certain and the rest by a cumulative sum that is rounded to half of one at both ends.
constexpr double kChoice = 2 * 0x1p-24;

SceneDescription load_placed(const std::string& body) {
  const ScratchDirectory directory;
  directory.write("mesh.obj", PlacedShape::obj());
  return renderer::load_scene(directory.write(
      "scene.xml",
      "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" "
      "value=\"60\"/><film type=\"hdrfilm\"><rfilter type=\"box\"/></film></sensor>" +
          body + "</scene>"));
}

double between(Pcg32& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.next_1d());
}

Vec3d in_cube(Pcg32& random, double half) {
  const double x = between(random, -half, half), y = between(random, -half, half);
  return {x, y, between(random, -half, half)};
}

/// As general as the format lets it be: a similarity for a sphere; for what lies in the plane z = 0
/// a rectangle's edges or a disk's radius, the z axis anywhere; anything for a mesh.
Placement random_placement(Model model, bool mirrored, Pcg32& random) {
  const renderer::Frame<double> frame(
      normalize(renderer::vec_cast<double>(renderer::square_to_uniform_sphere(random.next_2d()))));
  const double side = mirrored ? -1 : 1;
  const double a = between(random, 0.5, 1.5), b = between(random, 0.5, 1.5);
  Placement m{frame.tangent * a, frame.bitangent * a, frame.normal * (a * side),
              in_cube(random, 1.5)};
  if (model == Model::rectangle) m.y = frame.bitangent * b;
  if (model == Model::mesh) m.y = frame.bitangent * b + frame.tangent * between(random, -1, 1);
  if (model != Model::sphere) {
    m.z = frame.normal * (side * between(random, 0.5, 1.5)) +
          frame.tangent * between(random, -1, 1) + frame.bitangent * between(random, -1, 1);
  }
  return m;
}

/// Relative error of densities and absolute ones of normals and positions [m], which float makes of
/// what is known in double, measured at the point.
struct Rounding {
  double pdf, normal, position;
};

/// Coordinates up to M are off by M units. Over a shape of size s that turns its normal by M/s;
/// seen from a height h above its plane, it changes distances by M/h, and cosines, by which
/// densities go, as much. On a sphere a point moves by M/cos as the ray does, which turns the
/// normal by that over its radius; the cone that it fills goes by d² − R². An inward one goes by
/// its half chord R cos, the root of what is left of squares as large as those of R and the
/// distance m of its centre: M m over the half chord squared. The factors of 16 are for the number
/// of operations.
Rounding rounding_of(const PlacedShape& shape, const Meeting& meeting, const Vec3d& ref,
                     const Vec3d& wi, double pmf) {
  constexpr double kUnit = 16 * kUlp;
  const double d = meeting.distance, magnitude = length(ref) + d + length(shape.placement().origin);
  const double cosine = std::abs(dot(meeting.normal, wi));
  const double chosen = kChoice / pmf;
  if (shape.model() == Model::sphere) {
    const double r = shape.radius(), m = length(ref - shape.center()), half_chord = r * cosine;
    const double from_inside =
        magnitude * std::max(m, r) / (half_chord * half_chord) + magnitude / (d * cosine);
    const double cone = magnitude * (m + r) / std::abs(m * m - r * r);
    return {kUnit * (1 + (shape.flip_normals() ? from_inside : cone)) + chosen,
            kUnit * (1 + magnitude / half_chord), kUnit * magnitude / cosine};
  }
  const double turned = 1 + magnitude / shape.size(meeting.part);
  return {kUnit * turned * (1 + magnitude / (d * cosine)) + chosen, kUnit * turned,
          kUnit * magnitude * turned / cosine};
}

/// pdf_w [1/sr] of a point, the choice of its light left out: uniform on the surface of the part,
/// or in the solid angle of the part; that of a sphere which emits outwards anyway.
double known_pdf(const PlacedEmitter& emitter, const Meeting& meeting, const Vec3d& ref,
                 const Vec3d& wi) {
  const PlacedShape& shape = emitter.shape;
  if (emitter.by_solid_angle || (shape.model() == Model::sphere && !shape.flip_normals())) {
    return 1 / shape.solid_angle(meeting.part, ref);
  }
  return meeting.distance * meeting.distance /
         (std::abs(dot(meeting.normal, wi)) * shape.area(meeting.part));
}

/// One scene as it is known and as it was made.
struct Trial {
  const PlacedScene& known;
  const Scene& scene;
  LightSelection selection;
  int samples = 0, hits = 0, dark = 0, environment = 0;  ///< how often each was held to something
};

/// What MIS makes of a light sample and of a BSDF sample in the same direction sums to 1.
void expect_weights_sum_to_one(const Trial& trial, const LightSample<float>& sample,
                               std::uint32_t light, const Vec3f& ref, double tolerance) {
  for (const renderer::Heuristic heuristic : renderer::kHeuristics) {
    for (const int n : {1, 3}) {
      const renderer::PathOptions options{
          .heuristic = heuristic, .bsdf_samples = 2, .light_samples = n};
      const auto techniques = renderer::Techniques::of_counts(2, n);
      const float bsdf_pdf = 0.37f * sample.pdf_w;  // not near where a heuristic jumps
      const renderer::LightDraw draw{{1, 1, 1}, 1, sample.pdf_w, bsdf_pdf, false};
      const renderer::Arrival arrival{techniques, bsdf_pdf, false, ref};
      const double sum =
          static_cast<double>(static_cast<float>(n) * light_weight(options, techniques, draw)) +
          static_cast<double>(
              2 * emission_weight(options, trial.scene.lights(), arrival, light, sample.wi));
      EXPECT_NEAR(sum, 1, tolerance + 8 * kUlp) << describe(options.heuristic) << ' ' << n;
    }
  }
}

/// A ray along wi finds what is known of the first thing on it.
void expect_found(Trial& trial, const Vec3f& ref, const Vec3f& wi) {
  const Vec3d from = renderer::vec_cast<double>(ref), along = renderer::vec_cast<double>(wi);
  if (!trial.known.clear(from, along)) return;
  const auto first = trial.known.first(from, along);
  const auto hit = trial.scene.intersect({ref, wi});
  ASSERT_EQ(hit.has_value(), first.has_value());
  const renderer::Emission found = emission_seen(trial.scene, hit, wi);
  if (!first) {
    EXPECT_EQ(found.light, trial.known.environment_light());
    EXPECT_EQ(found.radiance, renderer::rgb_cast<float>(trial.known.environment));
    ++trial.environment;
    return;
  }
  const PlacedEmitter& emitter = trial.known.emitters[first->emitter];
  const Meeting& meeting = first->meeting;
  const std::uint32_t light = trial.known.light_of(first->emitter, meeting.part);
  const double pmf = emitter.emits() ? trial.known.pmf(trial.selection, light) : 1;
  const Rounding rounding = rounding_of(emitter.shape, meeting, from, along, pmf);
  const Vec3d end = from + along * meeting.distance;
  EXPECT_LE(length(renderer::vec_cast<double>(hit->position) - end), rounding.position);
  EXPECT_LE(length(renderer::vec_cast<double>(hit->normal) - meeting.normal), rounding.normal);
  if (!emitter.emits_towards(meeting, along)) {
    EXPECT_EQ(found.light, renderer::kNoLight);
    EXPECT_EQ(found.radiance, Rgbf{});
    ++trial.dark;
    return;
  }
  ASSERT_EQ(found.light, light);
  EXPECT_EQ(found.radiance, renderer::rgb_cast<float>(emitter.radiance));
  const double pdf = pmf * known_pdf(emitter, meeting, from, along);
  const double stated = static_cast<double>(trial.scene.lights().pdf_at_hit(light, ref, wi));
  EXPECT_NEAR(stated / pdf, 1, rounding.pdf);
  ++trial.hits;
}

/// The point of a part that emits towards ref along wi, in front of the shape's others or not.
std::optional<Meeting> emitting_point(const PlacedEmitter& emitter, std::size_t part,
                                      const Vec3d& ref, const Vec3d& wi, double edge) {
  for (const Meeting& meeting : emitter.shape.meetings(ref, wi, edge)) {
    if (meeting.part == part && emitter.emits_towards(meeting, wi)) return meeting;
  }
  return std::nullopt;
}

/// A sample of a surface states what is known of the point that it aims at.
void expect_known_sample(Trial& trial, const LightSample<float>& sample, std::size_t emitter_index,
                         std::size_t part, const Vec3f& ref) {
  const PlacedEmitter& emitter = trial.known.emitters[emitter_index];
  const Vec3d from = renderer::vec_cast<double>(ref);
  const Vec3d along = renderer::vec_cast<double>(sample.wi);
  const std::uint32_t light = trial.known.light_of(emitter_index, part);
  // A twentieth: seen flatter than that, half of a float's directions end beside the edge.
  if (sample.cos_light < 0.05f) return;
  ASSERT_TRUE(emitting_point(emitter, part, from, along, 1e-3)) << "the sample misses its light";
  if (!emitting_point(emitter, part, from, along, -1e-3)) return;
  const Meeting point = emitting_point(emitter, part, from, along, 0).value();
  const double pmf = trial.known.pmf(trial.selection, light);
  const Rounding rounding = rounding_of(emitter.shape, point, from, along, pmf);
  EXPECT_FALSE(sample.is_atom());
  EXPECT_EQ(sample.radiance, renderer::rgb_cast<float>(emitter.radiance));
  EXPECT_NEAR(static_cast<double>(sample.distance), point.distance, rounding.position);
  EXPECT_NEAR(static_cast<double>(sample.cos_light),
              -dot(point.normal, along) < 0 ? dot(point.normal, along) : -dot(point.normal, along),
              rounding.normal);
  const double pdf = pmf * known_pdf(emitter, point, from, along);
  EXPECT_NEAR(static_cast<double>(sample.pdf_w) / pdf, 1, rounding.pdf);
  expect_weights_sum_to_one(trial, sample, light, ref, 2 * rounding.pdf);
  ++trial.samples;
}

void expect_point_sample(const Trial& trial, const LightSample<float>& sample, const Vec3f& ref) {
  const Vec3d to_light = trial.known.point - renderer::vec_cast<double>(ref);
  const double irradiance = trial.known.intensity.g / length_squared(to_light);
  const double pmf = trial.known.pmf(trial.selection, trial.known.point_light());
  EXPECT_NEAR(static_cast<double>(sample.mass) / pmf, 1, kChoice / pmf + kUlp);
  EXPECT_EQ(sample.pdf_w, 0);
  EXPECT_NEAR(static_cast<double>(sample.radiance.g) / irradiance, 1, 16 * kUlp);
  EXPECT_LE(length(renderer::vec_cast<double>(sample.wi) - normalize(to_light)), 16 * kUlp);
}

void expect_environment_sample(const Trial& trial, const LightSample<float>& sample) {
  const double pmf = trial.known.pmf(trial.selection, trial.known.environment_light());
  EXPECT_EQ(sample.radiance, renderer::rgb_cast<float>(trial.known.environment));
  EXPECT_EQ(sample.distance, std::numeric_limits<float>::infinity());
  const double pdf = pmf / (4 * renderer::pi<double>());
  EXPECT_NEAR(static_cast<double>(sample.pdf_w) / pdf, 1, kChoice / pmf + 4 * kUlp);
}

void expect_sample_and_ray_agree(Trial& trial, const Vec3f& ref, const renderer::Vec2f& u) {
  const renderer::LightSet& lights = trial.scene.lights();
  const std::uint32_t light = lights.choose(u).light;
  const auto sample = lights.sample(ref, u);
  const auto parts = static_cast<std::uint32_t>(trial.known.emitters.front().shape.parts());
  if (!sample) {
    ASSERT_LE(light, parts) << "what has no dark side always gives a sample";
    return;
  }
  if (light == trial.known.point_light()) return expect_point_sample(trial, *sample, ref);
  if (light == trial.known.environment_light()) {
    expect_environment_sample(trial, *sample);
  } else if (light < parts) {
    expect_known_sample(trial, *sample, 0, light, ref);
  } else {
    expect_known_sample(trial, *sample, 1, 0, ref);
  }
  expect_found(trial, ref, sample->wi);
}

/// A point to look from: within reach of the target, every second one about inside of it.
Vec3f reference_point(const PlacedShape& target, bool inside, Pcg32& random) {
  const Vec3d center =
      target.model() == Model::sphere ? target.center() : target.placement().origin;
  return renderer::vec_cast<float>(inside ? center + in_cube(random, 0.35 * target.size(0))
                                          : in_cube(random, 4));
}

/// Whether a point lies between a sphere and the one by which its limb is widened.
bool at_surface(const PlacedShape& shape, const Vec3f& ref) {
  if (shape.model() != Model::sphere) return false;
  const double m = length(renderer::vec_cast<double>(ref) - shape.center());
  return std::abs(m / shape.radius() - 1) < 2e-3;
}

void expect_agreement(Trial& trial, Pcg32& random, int count) {
  const PlacedShape& target = trial.known.emitters.front().shape;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const Vec3f ref = reference_point(target, i % 2 == 0, random);
    if (at_surface(target, ref)) continue;
    expect_sample_and_ray_agree(trial, ref, random.next_2d());
    const Vec3d aim = target.placement().point(in_cube(random, 1));
    expect_found(trial, ref,
                 renderer::vec_cast<float>(normalize(aim - renderer::vec_cast<double>(ref))));
  }
}

class PlacedLights : public testing::TestWithParam<Model> {
 protected:
  /// Whether the format lets this shape emit like that.
  static bool takes(bool two_sided, bool by_solid_angle) {
    const Model model = GetParam();
    return (!two_sided || model == Model::rectangle) &&
           (!by_solid_angle || model == Model::rectangle || model == Model::mesh);
  }

  /// Calls function(emitter) for every flip, mirroring, side and way of sampling.
  static void for_each_emitter(Pcg32& random,
                               const std::function<void(const PlacedEmitter&)>& function) {
    for (int bits = 0; bits < 16; ++bits) {
      const bool flip = (bits & 1) != 0, mirror = (bits & 2) != 0;
      const bool two_sided = (bits & 4) != 0, by_solid_angle = (bits & 8) != 0;
      if (!takes(two_sided, by_solid_angle)) continue;
      for (int map = 0; map < 3; ++map) {
        const PlacedShape shape(GetParam(), random_placement(GetParam(), mirror, random), flip);
        SCOPED_TRACE(testing::Message()
                     << (flip ? "flipped, " : "") << (mirror ? "mirrored, " : "")
                     << (two_sided ? "two-sided, " : "")
                     << (by_solid_angle ? "by solid angle, " : "") << shape.placement().xml());
        function({shape, {3, 1, 2}, two_sided, by_solid_angle});
      }
    }
  }
};

TEST_P(PlacedLights, SayOfASampleWhatARayFindsThere) {
  Pcg32 random(check_seed("placed lights"), static_cast<std::uint64_t>(GetParam()), 0);
  int samples = 0, hits = 0, dark = 0, environment = 0;
  for_each_emitter(random, [&](const PlacedEmitter& emitter) {
    const PlacedScene known(emitter);
    SceneDescription description = load_placed(known.xml());
    for (const LightSelection selection : renderer::kLightSelections) {
      description.light_selection = selection;
      const Scene scene = renderer::make_scene(description);
      Trial trial{known, scene, selection};
      ASSERT_EQ(scene.lights().size(), known.environment_light() + 1);
      expect_agreement(trial, random, 100);
      samples += trial.samples;
      hits += trial.hits;
      dark += trial.dark;
      environment += trial.environment;
    }
  });
  // Of 100 of each in three selections, three maps and at least four emitters.
  EXPECT_GT(samples, 600);
  EXPECT_GT(hits, 600);
  EXPECT_GT(dark, 300);
  EXPECT_GT(environment, 300);
}

std::string model_name(const testing::TestParamInfo<Model>& model) {
  constexpr const char* kNames[] = {"Sphere", "Rectangle", "Disk", "Mesh"};
  return kNames[static_cast<int>(model.param)];
}

INSTANTIATE_TEST_SUITE_P(All, PlacedLights,
                         testing::Values(Model::sphere, Model::rectangle, Model::disk, Model::mesh),
                         model_name);

/// What the loader says to a shape under a matrix; empty if it takes it.
std::string refusal_of(Model model, const Placement& placement) {
  const PlacedEmitter emitter{{model, placement, false}, {1, 1, 1}};
  try {
    load_placed(emitter.xml());
  } catch (const renderer::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(PlacedLights, MapsThatMakeAnotherShapeOfItAreRefused) {
  const Placement uneven{{1, 0, 0}, {0, 1.5, 0}, {0, 0, 1}, {}};
  const Placement sheared{{1, 0, 0}, {0.5, 1, 0}, {0, 0, 1}, {}};
  const Placement leaning{{1, 0, 0}, {0, 1, 0}, {0.5, 0.25, 2}, {}};
  for (const Placement& placement : {uneven, sheared, leaning}) {
    EXPECT_NE(refusal_of(Model::sphere, placement).find("would make an ellipsoid"),
              std::string::npos);
    EXPECT_EQ(refusal_of(Model::mesh, placement), "");
  }
  EXPECT_NE(refusal_of(Model::disk, uneven).find("would make an ellipse"), std::string::npos);
  EXPECT_NE(refusal_of(Model::disk, sheared).find("would make an ellipse"), std::string::npos);
  EXPECT_NE(refusal_of(Model::rectangle, sheared).find("shears the rectangle"), std::string::npos);
  EXPECT_EQ(refusal_of(Model::rectangle, uneven), "");
  // Leaning, the plane z = 0 stays what it is: a disk and a rectangle under shear.
  EXPECT_EQ(refusal_of(Model::disk, leaning), "");
  EXPECT_EQ(refusal_of(Model::rectangle, leaning), "");
}

}  // namespace
}  // namespace plumbline::tests
