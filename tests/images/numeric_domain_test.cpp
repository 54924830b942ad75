#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/load_scene.h>

/// The numeric domain that docs/scene_format.md states: scenes whose answers are known, scaled,
/// moved, and with what is far or large beside it, give the picture that they give by themselves.
///
/// All with the same random numbers, so that paths are the same and nothing is left to chance: what
/// differs is rounding. That the scenes by themselves give their closed forms is what
/// known_answers_test proves.
namespace plumbline::tests {
namespace {

using namespace renderer;

/// Largest relative difference of a channel's mean: rounding of paths of 1e4 samples, not a bias.
constexpr double kRounding = 1e-4;

SceneDescription known(const std::string& name) {
  SceneDescription scene = load_scene(analytic::scene_file(name));
  scene.camera.width = 16;
  scene.camera.height = 12;
  return scene;
}

Rgbd mean_of(const SceneDescription& scene, Backend backend) {
  RenderOptions options;
  options.path.max_depth = scene.integrator.max_depth;
  options.path.rr_depth = scene.integrator.rr_depth;
  options.samples_per_pixel = 16;
  options.backend = backend;
  const RenderResult result = render(make_scene(scene), options);
  EXPECT_EQ(result.film.non_finite(), 0u);
  return result.film.mean();
}

double difference(const Rgbd& a, const Rgbd& b) {
  return std::max({std::abs(a.r / b.r - 1), std::abs(a.g / b.g - 1), std::abs(a.b / b.b - 1)});
}

/// Holds a scene to what its known scene gives, by both backends.
void expect_as_known(const std::string& name, const SceneDescription& changed) {
  static std::map<std::pair<std::string, Backend>, Rgbd> alone;
  for (const Backend backend : kBackends) {
    const auto [place, is_new] = alone.try_emplace({name, backend});
    if (is_new) place->second = mean_of(known(name), backend);
    EXPECT_LE(difference(mean_of(changed, backend), place->second), kRounding)
        << name << ", " << renderer::name(backend);
  }
}

/// x ↦ s·x + t of everything; intensities go with the square of lengths.
SceneDescription mapped(SceneDescription scene, double s, const Vec3d& t) {
  struct Map {
    double s;
    Vec3d t;
    void operator()(SphereShape& shape) const {
      shape.center = shape.center * s + t;
      shape.radius *= s;
    }
    void operator()(DiskShape& shape) const {
      shape.center = shape.center * s + t;
      shape.radius *= s;
    }
    void operator()(RectangleShape& shape) const {
      shape.origin = shape.origin * s + t;
      shape.edge_u = shape.edge_u * s;
      shape.edge_v = shape.edge_v * s;
    }
    void operator()(MeshShape& shape) const {
      for (Vec3d& v : shape.vertices) v = v * s + t;
    }
  } const map{s, t};
  for (ShapeDescription& shape : scene.shapes) std::visit(map, shape.geometry);
  for (PointDescription& point : scene.points) {
    point.position = point.position * s + t;
    point.intensity = point.intensity * (s * s);
  }
  scene.camera.origin = scene.camera.origin * s + t;
  return scene;
}

const std::vector<std::string> kScenes = {"furnace_cube", "sphere_light", "triangle_light",
                                          "glass_sphere", "point_glossy", "edge_shadow",
                                          "thin_gap"};

TEST(NumericDomain, ScenesMayBeOfAnySize) {
  for (const std::string& name : kScenes) {
    for (const double scale : {1e-17, 1e-12, 1e-7, 1e-3, 1e3, 1e7, 1e12, 1e16}) {
      SCOPED_TRACE(scale);
      if (name == "point_glossy" && scale > 1e12) continue;  // intensities end at 1e30
      expect_as_known(name, mapped(known(name), scale, {}));
    }
  }
}

TEST(NumericDomain, ScenesMayBeFarFromTheOriginOfTheirFile) {
  for (const std::string& name : kScenes) {
    for (const double distance : {1e3, 1e7, 1e10}) {
      SCOPED_TRACE(distance);
      expect_as_known(name, mapped(known(name), 1, Vec3d{1, -0.7, 0.3} * distance));
    }
  }
}

TEST(NumericDomain, TheComparisonSeesAScaleThatLeavesOneShapeBehind) {
  SceneDescription scene = mapped(known("sphere_light"), 1e3, {});
  std::get<SphereShape>(scene.shapes[0].geometry).radius *= 1.001;
  EXPECT_GT(
      difference(mean_of(scene, Backend::scalar), mean_of(known("sphere_light"), Backend::scalar)),
      10 * kRounding);
}

/// Those without glass or many bounces, on which a rounding of the last digit makes another path.
const std::vector<std::string> kShortPaths = {"sphere_light", "rectangle_light", "triangle_light",
                                              "thin_gap", "sphere_inside"};

MeshShape triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return {{a, b, c}, {{{0, 1, 2}}}, false};
}

TEST(NumericDomain, SomethingFarAwayLeavesThePictureAsItIs) {
  for (const std::string& name : kShortPaths) {
    const std::uint32_t bsdf = known(name).shapes.back().bsdf;
    for (int decade = 2; decade <= 11; ++decade) {
      SCOPED_TRACE(decade);
      const double d = std::pow(10.0, decade);
      const Vec3d p = Vec3d{0.6, -0.3, -0.7} * d;
      const std::array<ShapeDescription, 4> far{
          {{SphereShape{p, 1, false}, bsdf, {}},
           {RectangleShape{p, {1, 0, 0}, {0, 0, 2}, false}, bsdf, {}},
           {DiskShape{p, {0, 0, 1}, 1}, bsdf, {}},
           {triangle(p, p + Vec3d{1, 0, 0}, p + Vec3d{0, 1, 0}), bsdf, {}}}};
      SceneDescription scene = known(name);
      scene.shapes.push_back(far[static_cast<std::size_t>(decade) % far.size()]);
      expect_as_known(name, scene);
    }
  }
}

/// The known scene with another shape in place of its floor, the rectangle that reaches farthest.
SceneDescription on_floor(const std::string& name,
                          const decltype(ShapeDescription::geometry)& floor) {
  SceneDescription scene = known(name);
  const auto reach = [](const ShapeDescription& shape) {
    const auto* rectangle = std::get_if<RectangleShape>(&shape.geometry);
    return rectangle ? length(rectangle->edge_u) : 0;
  };
  std::max_element(scene.shapes.begin(), scene.shapes.end(), [&](const auto& a, const auto& b) {
    return reach(a) < reach(b);
  })->geometry = floor;
  return scene;
}

TEST(NumericDomain, AFloorMayReachAsFarAsItLikes) {
  for (const char* name : {"sphere_light", "rectangle_light", "triangle_light"}) {
    for (const double r : {1e2, 1e4, 1e6, 1e8, 1e10}) {
      SCOPED_TRACE(r);
      expect_as_known(
          name, on_floor(name, RectangleShape{{-r, -r / 9, 0}, {2 * r, 0, 0}, {0, r, 0}, false}));
      expect_as_known(name, on_floor(name, DiskShape{{0, 0, 0}, {0, 0, 1}, r}));
      expect_as_known(name, on_floor(name, triangle({-r, -r, 0}, {r, -r, 0}, {r / 3, 2 * r, 0})));
    }
    // Curved by 1e-6 of what stands on it and more: at 1e7 less than rounding.
    for (const double r : {1e7, 1e9}) {
      expect_as_known(name, on_floor(name, SphereShape{{0, 0, -r}, r, false}));
    }
  }
}

TEST(NumericDomain, AFloorThatIsTiltedMayToo) {
  // A point light over the middle of a white floor: E = I/h², L = E/π where the camera looks.
  const Vec3d n = normalize(Vec3d{0.48, -0.6, 0.64});
  const Frame<double> frame(n);
  for (const double r : {1e3, 1e6, 1e9, 1e11}) {
    SceneDescription scene = known("furnace_open");
    scene.environment.reset();
    scene.bsdfs = make_bsdfs({Lambertian{{0.5f, 0.5f, 0.5f}}});
    const Vec3d u = frame.tangent * r, v = frame.bitangent * r;
    scene.shapes = {{RectangleShape{(u + v) * -1.0, u * 2, v * 2, false}, 0, {}}};
    scene.points = {{n * 2, {8, 8, 8}}};
    scene.camera.origin = n;
    scene.camera.forward = -n;
    scene.camera.left = frame.tangent;
    scene.camera.up = frame.bitangent;
    scene.camera.tan_half_fov_x = 1e-3;
    scene.integrator.max_depth = 2;
    for (const Backend backend : kBackends) {
      EXPECT_NEAR(mean_of(scene, backend).g, 0.5 / pi<double>() * 8 / 4, 1e-5) << r;
    }
  }
}

TEST(NumericDomain, ALampMayBeFarAway) {
  // E = π Le (R/d)² of a sphere overhead: its cone is so narrow that no sample differs.
  for (const double d : {1e3, 1e5, 1e7, 1e9}) {
    SceneDescription scene = known("furnace_open");
    scene.environment.reset();
    scene.bsdfs = make_bsdfs({Lambertian{{0.5f, 0.5f, 0.5f}}});
    scene.shapes = {{RectangleShape{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, false}, 0, {}},
                    {SphereShape{{0, 0, d}, 1, false}, 0, Rgbd{2, 2, 2} * (d * d / 1e3)}};
    scene.camera.origin = {0, 0, 1};
    scene.camera.forward = {0, 0, -1};
    scene.camera.left = {1, 0, 0};
    scene.camera.up = {0, 1, 0};
    scene.camera.tan_half_fov_x = 0.1;
    scene.integrator.max_depth = 2;
    for (const Backend backend : kBackends) {
      EXPECT_NEAR(mean_of(scene, backend).g, 1e-3, 1e-3 * 3e-3 * 1e3 / d + 1e-8) << d;
    }
  }
}

std::string refusal_of(const SceneDescription& scene) {
  try {
    make_scene(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

SceneDescription with_names(SceneDescription scene) {
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    scene.shapes[i].line = 10 * (i + 1);
    scene.shapes[i].label = "<shape>";
  }
  scene.file = "scene.xml";
  return scene;
}

TEST(NumericDomain, WhatDoesNotFitIsRefusedByName) {
  SceneDescription far = known("sphere_light");
  far.shapes.push_back({SphereShape{{1e13, 0, 0}, 1e3, false}, 0, {}});
  EXPECT_EQ(refusal_of(with_names(far)),
            "scene.xml:10: <shape> is 1.3e+13 times smaller than single precision can hold beside "
            "<shape> on line 30");

  // A lamp in a shade: no point of either is where it was.
  SceneDescription lamp = known("sphere_light");
  lamp.shapes.push_back({SphereShape{{1e7, 0, 5}, 1, false}, 0, Rgbd{1, 1, 1}});
  EXPECT_EQ(refusal_of(with_names(lamp)), "");
  lamp.shapes.push_back({RectangleShape{{1e7, -1, 3.5}, {2, 0, 0}, {0, 2, 0}, false}, 0, {}});
  EXPECT_EQ(refusal_of(with_names(lamp)),
            "scene.xml:30: <shape> emits so far from the rest that single precision does not tell "
            "it from <shape> on line 40");

  // An emitting wall, its corners far apart and none of its coordinates exact.
  SceneDescription wall = known("sphere_light");
  const Frame<double> frame(normalize(Vec3d{0.48, -0.6, -0.64}));
  const Vec3d u = frame.tangent * 1e9, v = frame.bitangent * 1e9;
  wall.shapes.push_back(
      {RectangleShape{Vec3d{0, 0, 9} - (u + v) * 0.5, u, v, false}, 0, Rgbd{1, 1, 1}});
  EXPECT_EQ(refusal_of(with_names(wall)),
            "scene.xml:30: <shape> emits and is too large for single precision to sample it beside "
            "<shape> on line 10");
}

TEST(NumericDomain, WhatTheCameraLooksAtFromFarAwayIsPlacedWhereItIs) {
  // As large as the picture, with something beside the way.
  SceneDescription scene = known("furnace_sphere");
  scene.camera.origin = {0, 0, 2e5};
  scene.camera.forward = {0, 0, -1};
  scene.camera.left = {1, 0, 0};
  scene.camera.up = {0, 1, 0};
  scene.camera.tan_half_fov_x = 2e-6;                                    // the sphere: 5e-6
  std::get<SphereShape>(scene.shapes[0].geometry).flip_normals = false;  // 1 from outside, no more
  scene.shapes.push_back({SphereShape{{100, 0, 2e5}, 10, false}, scene.shapes[0].bsdf, {}});
  scene.integrator.max_depth = 1;
  const Rgbd radiance = *scene.shapes[0].radiance;
  EXPECT_LE(difference(mean_of(scene, Backend::batched), radiance), kRounding);
  EXPECT_LE(difference(mean_of(scene, Backend::scalar), radiance), kRounding);
  // Beside the camera it is another matter: both would have to be the origin.
  scene.shapes[1].geometry = SphereShape{{2, 0, 2e5}, 1, false};
  EXPECT_EQ(refusal_of(with_names(scene)),
            "scene.xml:10: <shape> is too small and too far for a picture in single precision that "
            "also holds <shape> on line 20");
}

}  // namespace
}  // namespace plumbline::tests
