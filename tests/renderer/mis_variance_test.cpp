#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/verify/mean.h>
#include <plumbline_tests/support.h>
#include "scenes.h"

/// Direct light varies by as much as its techniques, counts and weights make it: the variance of
/// whole paths of the renderer against its value by quadrature over the light, in double and
/// without any of the renderer's samplers or weights.
namespace plumbline::tests {
namespace {

using renderer::Heuristic;
using renderer::Strategy;
using renderer::Vec3d;

/// A Phong lobe at the origin, above z = 0.
constexpr double kExponent = 30, kReflectance = 0.8;

/// From the lobe to the camera, and the axis of the lobe: 40° from the normal.
const Vec3d kToCamera{-std::sin(0.7), 0, std::cos(0.7)};
const Vec3d kLobe{std::sin(0.7), 0, std::cos(0.7)};

/// A part of a light as seen from the lobe.
struct LightPart {
  double solid_angle;   ///< [sr]
  double reflected;     ///< f·cosθ, for radiance 1 [1/sr]
  double pdf_b, pdf_l;  ///< pdf_w of the BSDF and of the light [1/sr]
};

LightPart part_of(const Vec3d& wi, double solid_angle, double pdf_l) {
  const double lobe =
      std::pow(std::max(dot(wi, kLobe), 0.0), kExponent) / (2 * renderer::pi<double>());
  return {solid_angle, kReflectance * (kExponent + 2) * lobe * wi.z, (kExponent + 1) * lobe, pdf_l};
}

/// A light with the parts that it is made of.
struct SeenLight {
  std::string name;
  renderer::ShapeDescription shape;
  std::vector<LightPart> parts;
};

constexpr int kGrid = 200;

double cell(int i) { return (i + 0.5) / kGrid; }

/// A ball beside the axis of the lobe, sampled by its cone of directions.
SeenLight ball() {
  const Vec3d center{1.2, 0.3, 1.7};
  const double radius = 0.6, distance = length(center);
  const Vec3d axis = center / distance;
  const Vec3d side = normalize(cross(axis, Vec3d{0, 1, 0})), other = cross(axis, side);
  const double rim = 1 - std::sqrt(1 - radius * radius / (distance * distance));
  SeenLight light{
      "ball", {renderer::SphereShape{center, radius, false}, 0, renderer::Rgbd{1, 1, 1}}, {}};
  for (int i = 0; i < kGrid; ++i) {
    for (int j = 0; j < kGrid; ++j) {
      const double height = 1 - rim * cell(i), sine = std::sqrt(1 - height * height);
      const double phi = 2 * renderer::pi<double>() * cell(j);
      const double whole = 2 * renderer::pi<double>() * rim;
      light.parts.push_back(
          part_of(axis * height + side * (sine * std::cos(phi)) + other * (sine * std::sin(phi)),
                  whole / (kGrid * kGrid), 1 / whole));
    }
  }
  return light;
}

/// A window that faces down and back, 1 m by 0.8 m, sampled by area or by solid angle.
SeenLight window(bool by_solid_angle) {
  const Vec3d edge_u{0, 1, 0}, edge_v{0.64, 0, -0.48}, corner{0.8, -0.4, 1.5};
  const Vec3d normal = normalize(cross(edge_u, edge_v));
  const double area = length(edge_u) * length(edge_v);
  SeenLight light{by_solid_angle ? "window by solid angle" : "window by area",
                  {renderer::RectangleShape{corner, edge_u, edge_v, false}, 0,
                   renderer::Rgbd{1, 1, 1}, by_solid_angle},
                  {}};
  double whole = 0;
  for (int i = 0; i < kGrid; ++i) {
    for (int j = 0; j < kGrid; ++j) {
      const Vec3d point = corner + edge_u * cell(i) + edge_v * cell(j);
      const double square = length_squared(point);
      const double density = square * std::sqrt(square) / (-dot(normal, point) * area);
      light.parts.push_back(part_of(normalize(point), 1 / (density * kGrid * kGrid), density));
      whole += light.parts.back().solid_angle;
    }
  }
  for (LightPart& part : light.parts) {
    if (by_solid_angle) part.pdf_l = 1 / whole;
  }
  return light;
}

double mean_of(const SeenLight& light) {
  double sum = 0;
  for (const LightPart& part : light.parts) sum += part.reflected * part.solid_angle;
  return sum;
}

/// What is drawn at the lobe. `n` are counts, or the probabilities of `one_sample`.
struct Drawing {
  std::string name;
  renderer::PathOptions path;
  double n_bsdf, n_light;
};

/// Veach's weights of the BSDF and of the light sample.
std::array<double, 2> weights(const Drawing& drawing, const LightPart& part) {
  if (drawing.n_light == 0) return {1, 0};
  if (drawing.n_bsdf == 0) return {0, 1};
  const double power = drawing.path.heuristic.heuristic == Heuristic::power ? 2 : 1;
  const double b = std::pow(drawing.n_bsdf * part.pdf_b, power);
  const double l = std::pow(drawing.n_light * part.pdf_l, power);
  return {b / (b + l), l / (b + l)};
}

/// Variance of one estimate. A technique's sample is X = w f cosθ/(n p), so that n of them have
/// n E[X²] = ∫ (w f cosθ)²/(n p) dω and each the mean ∫ w f cosθ/n dω, whose square is taken off n
/// times; where one sample of either is drawn the square of the whole mean is, once.
///
/// @source Veach 1997, Eqs. 9.4 and 9.15
double variance_of(const SeenLight& light, const Drawing& drawing) {
  const std::array<double, 2> n{drawing.n_bsdf, drawing.n_light};
  std::array<double, 2> mean{}, square{};
  for (const LightPart& part : light.parts) {
    const auto w = weights(drawing, part);
    const std::array<double, 2> pdf{part.pdf_b, part.pdf_l};
    for (std::size_t i = 0; i < 2; ++i) {
      if (n[i] == 0) continue;
      const double value = w[i] * part.reflected;
      mean[i] += value * part.solid_angle;
      square[i] += value * value / (n[i] * pdf[i]) * part.solid_angle;
    }
  }
  if (drawing.path.strategy == Strategy::one_sample) {
    const double whole = mean[0] + mean[1];
    return square[0] + square[1] - whole * whole;
  }
  double variance = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    if (n[i] > 0) variance += square[i] - mean[i] * mean[i] / n[i];
  }
  return variance;
}

/// A film of one pixel that sees the lobe only.
renderer::SceneDescription scene_of(const SeenLight& light) {
  const auto reflectance = static_cast<float>(kReflectance);
  renderer::SceneDescription scene = empty_scene(1, 1);
  scene.bsdfs = renderer::make_bsdfs({renderer::ModifiedPhong{
      {reflectance, reflectance, reflectance}, static_cast<float>(kExponent)}});
  scene.camera.origin = kToCamera * 2.0;
  scene.camera.forward = -kToCamera;
  scene.camera.left = {0, 1, 0};
  scene.camera.up = cross(kToCamera, Vec3d{0, 1, 0});
  scene.camera.tan_half_fov_x = 1e-4;
  scene.shapes.push_back(
      {renderer::RectangleShape{{-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, false}, 0, {}, false, false});
  scene.shapes.push_back(light.shape);
  return scene;
}

/// Squared deviations of single paths from the mean.
class Deviations {
 public:
  Deviations(const SeenLight& light, const Drawing& drawing, renderer::Backend backend,
             std::uint64_t seed)
      : scene_(renderer::make_scene(scene_of(light))), mean_(mean_of(light)) {
    options_.path = drawing.path;
    options_.backend = backend;
    options_.seed = seed;
    samplers_ = pixel_samplers(scene_, options_);
    sampler_ = samplers_();
  }

  verify::Moments draw(std::uint64_t first, std::uint64_t count) {
    std::vector<renderer::PixelMoments> paths(count);
    for (std::uint64_t i = 0; i < count; ++i) sampler_->sample(0, 0, first + i, 0, paths[i]);
    sampler_->finish();
    verify::Moments moments;
    for (const renderer::PixelMoments& path : paths)
      moments.add(renderer::sqr(path.mean.g - mean_));
    return moments;
  }

 private:
  renderer::Scene scene_;
  renderer::RenderOptions options_;
  renderer::SamplerFactory samplers_;  // lends what the samplers share
  std::unique_ptr<renderer::PixelSampler> sampler_;
  double mean_;
};

/// @param stated  times the variance by quadrature
void expect_variance(const SeenLight& light, const Drawing& drawing, renderer::Backend backend,
                     double stated = 1) {
  verify::MeanOptions options;
  options.subject = (stated == 1 ? "direct light/" : "control/direct light/") + light.name;
  options.subject.append("/").append(drawing.name).append("/").append(name(backend));
  if (stated != 1) options.subject.append("/times ").append(std::to_string(stated));
  options.reference = stated * variance_of(light, drawing);
  options.tolerance = 0.05;  // a loss of 15 % fails, a gain asks for a new number
  // The pixel is 2e-4 m wide, of lights that are 2 m away: squares change by 1e-4 across it.
  options.rounding_allowance = 1e-3;
  options.max_samples = 1 << 22;
  if (stated != 1) options.expected = verify::Verdict::fail;
  options.seed = check_seed(options.subject);
  Deviations deviations(light, drawing, backend, options.seed);
  verify::CheckResult result = check_mean(options, [&](std::uint64_t first, std::uint64_t count) {
    return deviations.draw(first, count);
  });
  result.kind = verify::CheckKind::variance;
  expect_verdict(result);
}

Drawing of_mis(Heuristic heuristic, int n_bsdf, int n_light) {
  renderer::PathOptions path;
  path.heuristic = heuristic;
  path.max_depth = 2;
  path.bsdf_samples = n_bsdf;
  path.light_samples = n_light;
  std::string name(renderer::name(heuristic));
  name.append(" ").append(std::to_string(n_bsdf)).append("+").append(std::to_string(n_light));
  return {name, path, static_cast<double>(n_bsdf), static_cast<double>(n_light)};
}

Drawing of_one_sample(Heuristic heuristic, float light_probability) {
  Drawing drawing = of_mis(heuristic, 1, 1);
  drawing.path.strategy = Strategy::one_sample;
  drawing.path.light_probability = light_probability;
  drawing.name = "one sample, " + std::string(renderer::name(heuristic)) + " " +
                 std::to_string(light_probability);
  drawing.n_light = double{light_probability};
  drawing.n_bsdf = 1 - drawing.n_light;
  return drawing;
}

Drawing of_one_technique(Strategy strategy) {
  Drawing drawing =
      of_mis(Heuristic::balance, strategy == Strategy::bsdf, strategy == Strategy::light);
  drawing.path.strategy = strategy;
  drawing.path.bsdf_samples = drawing.path.light_samples = 1;
  drawing.name = renderer::name(strategy);
  return drawing;
}

std::vector<SeenLight> seen_lights() { return {ball(), window(false), window(true)}; }

TEST(DirectLight, VariesAsItsCountsAndWeightsSay) {
  for (const SeenLight& light : seen_lights()) {
    for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
      for (const auto& [b, l] :
           {std::pair{1, 1}, std::pair{1, 4}, std::pair{4, 1}, std::pair{2, 2}}) {
        expect_variance(light, of_mis(heuristic, b, l), renderer::Backend::batched);
      }
      expect_variance(light, of_mis(heuristic, 1, 1), renderer::Backend::scalar);
      for (const float c : {0.25f, 0.8f}) {
        expect_variance(light, of_one_sample(heuristic, c), renderer::Backend::scalar);
      }
    }
    for (const Strategy strategy : {Strategy::bsdf, Strategy::light}) {
      for (const renderer::Backend backend : renderer::kBackends) {
        expect_variance(light, of_one_technique(strategy), backend);
      }
    }
  }
}

TEST(DirectLight, AVarianceFifteenPercentOffEitherWayFails) {
  for (const double stated : {0.85, 1.15}) {
    expect_variance(ball(), of_mis(Heuristic::power, 1, 4), renderer::Backend::batched, stated);
  }
}

}  // namespace
}  // namespace plumbline::tests
