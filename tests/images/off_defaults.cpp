#include "off_defaults.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <plumbline/analytic/polygon_light.h>
#include <plumbline_tests/directions.h>

#include "off_default_parts.h"

namespace plumbline::tests {
namespace {

using renderer::Strategy;

std::string area_light(const std::string& radiance, const std::string& more = "") {
  return R"(<emitter type="area"><rgb name="radiance" value=")" + radiance + "\"/>" + more +
         "</emitter>";
}

/// Radiance of the floors: without their lights they are not black, which takes long to be sure of.
constexpr double kGlow = 0.25;

std::string floor_of(const std::string& type, const std::string& reflectance) {
  return "<shape type=\"" + type +
         R"("><transform name="to_world"><scale value="10"/></transform>)" + diffuse(reflectance) +
         area_light("0.25") + "</shape>\n";
}

// A light of radiance L over a floor of reflectance ρ, which glows: kGlow + ρ/π E.

OffDefault placed_sphere() {
  // (0.5, 0, 1) twice as far and half up: (1, 0, 2.5), radius 1. E = π L R²/d² cosθ.
  const double d2 = 1 + 2.5 * 2.5;
  return {"placed_sphere",
          eye() + kDirect + floor_of("rectangle", "0.8") +
              R"(<shape type="sphere"><point name="center" value="0.5 0 1"/>
      <float name="radius" value="0.5"/><transform name="to_world"><scale value="2"/>
      <translate z="0.5"/></transform>)" +
              area_light("5") + "</shape>",
          {"sphere.center", "sphere.radius", "sphere.to_world", "sphere.emitter", "area.radiance",
           "rectangle.bsdf", "diffuse.reflectance"},
          kGlow + 0.8 * 5 / d2 * 2.5 / std::sqrt(d2),
          {Strategy::light, Strategy::mis}};
}

OffDefault flipped_sphere() {
  // The light all around a small floor: E = π L.
  return {"flipped_sphere",
          eye() + kDirect + R"(<shape type="disk">)" + diffuse("0.25") + area_light("0.25") +
              R"(</shape><shape type="sphere"><float name="radius" value="3"/>
      <boolean name="flip_normals" value="true"/>)" +
              area_light("2") + "</shape>",
          {"sphere.flip_normals", "disk.bsdf"},
          kGlow + 0.25 * 2};
}

OffDefault closed_sphere_of_three() {
  return {"closed_sphere_to_depth_3",
          eye() +
              R"(<integrator type="path"><integer name="max_depth" value="3"/></integrator>
      <shape type="sphere"><float name="radius" value="3"/>
      <boolean name="flip_normals" value="true"/>)" +
              diffuse("0.75") + area_light("0.5") + "</shape>",
          {"sphere.bsdf", "path.max_depth"},
          0.5 * (1 + 0.75 + 0.75 * 0.75)};
}

OffDefault direct_integrator() {
  return {"direct_integrator",
          eye() + R"(<integrator type="direct"/><shape type="sphere">
      <boolean name="flip_normals" value="true"/><float name="radius" value="3"/>)" +
              area_light("0.5") + "</shape>",
          {"direct"},
          0.5 * (1 + 0.5)};
}

OffDefault roulette_from_depth_40() {
  // A white room: nothing ends a path of 40 but its depth. With the usual roulette from 5 on one in
  // twenty would end at every vertex.
  return {"roulette_from_depth_40",
          eye() +
              R"(<integrator type="path"><integer name="max_depth" value="40"/>
      <integer name="rr_depth" value="40"/></integrator>
      <shape type="sphere"><float name="radius" value="3"/>
      <boolean name="flip_normals" value="true"/>)" +
              diffuse("1") + area_light("1") + "</shape>",
          {"path.rr_depth"},
          39,
          {Strategy::bsdf},
          Measure::bounce_rays};
}

OffDefault placed_rectangle() {
  const analytic::Polygon corners{{-1.2, -0.3, 2}, {1.8, -0.3, 2}, {1.8, 0.7, 2}, {-1.2, 0.7, 2}};
  return {"flipped_rectangle",
          eye() + kDirect + floor_of("disk", "0.8") +
              R"(<shape type="rectangle"><boolean name="flip_normals" value="true"/>
      <transform name="to_world"><scale x="1.5" y="0.5"/><translate x="0.3" y="0.2" z="2"/>
      </transform>)" +
              area_light("3") + "</shape>",
          {"rectangle.flip_normals", "rectangle.to_world", "rectangle.emitter"},
          kGlow + 0.8 * 3 / std::numbers::pi *
                      analytic::polygon_irradiance(corners, {0, 0, 0}, {0, 0, 1})};
}

OffDefault two_sided_rectangle() {
  OffDefault both = placed_rectangle();
  both.name = "two_sided_rectangle";
  const std::string flip = R"(<boolean name="flip_normals" value="true"/>)";
  both.scene.erase(both.scene.find(flip), flip.size());
  both.scene.insert(both.scene.rfind("</emitter>"), R"(<boolean name="two_sided" value="true"/>)");
  both.covers = {"area.two_sided"};
  return both;
}

OffDefault sheared_disk() {
  // Of radius 0.5, its axis n = (0.6, 0, 0.8) through the origin, which lies 2 away against n; the
  // z axis leans, and the front, along n, is flipped. A cone above the horizon projects to an
  // ellipse: E = π L sin²σ cosθ with tanσ = 0.5/2.
  return {"flipped_disk_under_shear",
          eye("-0.25 0 1") + kDirect + floor_of("rectangle", "0.8") +
              R"(<shape type="disk"><boolean name="flip_normals" value="true"/>
      <transform name="to_world"><matrix value="0.4 0 0.9 1.2  0 0.5 0.2 0  -0.3 0 0.2 1.6  0 0 0 1"/>
      </transform>)" +
              area_light("7") + "</shape>",
          {"disk.flip_normals", "disk.to_world", "disk.emitter"},
          kGlow + 0.8 * 7 * (0.25 / 4.25) * 0.8,
          {Strategy::light, Strategy::mis}};
}

OffDefault flipped_mesh() {
  // The triangle faces up; mirrored it is inside out, turned about x up again, and flipped it faces
  // the floor. (x, y, 0) becomes (−2x, −y, 2).
  const analytic::Polygon corners{{2, 1, 2}, {-2, 1, 2}, {0, -1, 2}};
  return {"flipped_mesh",
          eye() + kDirect + floor_of("disk", "0.6") +
              R"(<shape type="obj"><string name="filename" value="triangle.obj"/>
      <boolean name="face_normals" value="true"/><boolean name="flip_normals" value="true"/>
      <transform name="to_world"><scale x="-2"/><rotate x="1" angle="180"/><translate z="2"/>
      </transform>)" +
              area_light("4") + "</shape>",
          {"obj.filename", "obj.face_normals", "obj.flip_normals", "obj.to_world", "obj.emitter"},
          kGlow + 0.6 * 4 / std::numbers::pi *
                      analytic::polygon_irradiance(corners, {0, 0, 0}, {0, 0, 1})};
}

OffDefault mesh_under_sky() {
  return {"mesh_under_sky",
          eye() + kDirect + sky("1") +
              R"(<shape type="obj"><string name="filename" value="floor.obj"/>
      <boolean name="face_normals" value="true"/>)" +
              diffuse("0.6") + "</shape>",
          {"obj.bsdf"},
          0.6};
}

OffDefault light_by_solid_angle() {
  // From the centre of a cube each of its faces fills a sixth of the sphere.
  return {"light_by_solid_angle",
          eye("0.25 0 0") +
              R"(<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/>
      <translate z="1"/></transform>)" +
              area_light("1", R"(<string name="sampling" value="solid_angle"/>)") +
              R"(</shape><shape type="rectangle"><transform name="to_world"><translate z="-1"/>
      </transform></shape>)",
          {"area.sampling"},
          6 / (4 * std::numbers::pi),
          {},
          Measure::light_pdf};
}

std::string map(const std::string& more) {
  return R"(<emitter type="envmap"><string name="filename" value="map.exr"/>
      <float name="scale" value="2.5"/><transform name="to_world"><rotate x="1" angle="90"/>
      </transform>)" +
         more + "</emitter>";
}

OffDefault scaled_map() {
  // Stood up, its upper half is above the floor, each pixel over a quarter of all azimuths.
  return {"scaled_map",
          eye() + kDirect + floor_of("rectangle", "0.8") + map(""),
          {"envmap.filename", "envmap.scale", "envmap.to_world"},
          kGlow + 0.8 * 2.5 * (1 + 8 + 1 + 1.5) / 4};
}

OffDefault compensated_map() {
  // The mean is 15.5/8: light samples are left with the one pixel above it.
  return {"compensated_map",
          eye() + kDirect + floor_of("rectangle", "0.8") +
              map(R"(<boolean name="mis_compensation" value="true"/>)"),
          {"envmap.mis_compensation"},
          kGlow + 0.8 * 2.5 * 8 / 4,
          {Strategy::light}};
}

OffDefault sun_and_sky() {
  const double sine = std::sin(radians(15));
  return {"sun_and_sky",
          eye() + kDirect + floor_of("rectangle", "0.8") + sky("0.5") +
              R"(<emitter type="sun"><vector name="direction" value="3 0 -4"/>
      <float name="half_angle" value="15"/><rgb name="radiance" value="20"/></emitter>)",
          {"sun.direction", "sun.half_angle", "sun.radiance", "constant.radiance"},
          kGlow + 0.8 * (0.5 + 20 * sine * sine * 0.8),
          {Strategy::light, Strategy::mis}};
}

OffDefault sun_alone() {
  const double sine = std::sin(radians(15));
  return {"sun_alone",
          eye() + kDirect + floor_of("rectangle", "0.8") +
              R"(<emitter type="sun"><vector name="direction" value="3 0 -4"/>
      <float name="half_angle" value="15"/><rgb name="radiance" value="20"/></emitter>)",
          {},
          kGlow + 0.8 * 20 * sine * sine * 0.8,
          {Strategy::light, Strategy::mis}};
}

OffDefault point_light() {
  return {"point_light",
          eye() + kDirect + floor_of("rectangle", "0.8") +
              R"(<emitter type="point"><point name="position" value="0.9 0 1.2"/>
      <rgb name="intensity" value="5"/></emitter>)",
          {"point.position", "point.intensity"},
          kGlow + 0.8 / std::numbers::pi * 5 * (1.2 / 1.5) / (1.5 * 1.5),
          {Strategy::light, Strategy::mis}};
}

/// A light of 1 by 0.5, one away from a camera that is turned round; its view is 2 by 1 times
/// `half_width` there, for a film twice as wide as high.
OffDefault camera(const std::string& axis, double half_width, bool upright = false) {
  const double view = 2 * half_width * 2 * half_width * (upright ? 2 : 0.5);
  return {"fov_along_" + axis + (upright ? "_of_an_upright_film" : ""),
          R"(<sensor type="perspective"><float name="fov" value="106.26020470831196"/>
      <string name="fov_axis" value=")" +
              axis + R"("/><transform name="to_world"><rotate y="1" angle="180"/></transform>
      <film type="hdrfilm"><integer name="width" value=")" +
              (upright ? "40" : "80") + R"("/><integer name="height" value=")" +
              (upright ? "80" : "40") + R"("/><rfilter type="box"/></film></sensor>
      <shape type="rectangle"><transform name="to_world"><scale x="0.5" y="0.25"/>
      <translate z="-1"/></transform>)" +
              area_light("6") + "</shape>",
          axis == "y" ? std::vector<std::string>{"perspective.fov", "perspective.fov_axis",
                                                 "perspective.to_world", "perspective.film",
                                                 "hdrfilm.width", "hdrfilm.height",
                                                 "hdrfilm.rfilter", "box"}
                      : std::vector<std::string>{},
          6 * 0.5 / view,
          {Strategy::bsdf},
          Measure::luminance,
          0.04};  // another axis would be off by a quarter at least
}

std::vector<OffDefault> cameras() {
  // tan of half the field of view is 4/3. The diagonal of a film twice as wide as high is √5/2 of
  // its width.
  const double t = 4.0 / 3;
  return {camera("x", t),
          camera("y", 2 * t),
          camera("diagonal", t * 2 / std::sqrt(5.0)),
          camera("smaller", 2 * t),
          camera("larger", t),
          camera("larger", t / 2, true),
          camera("smaller", t, true)};
}

OffDefault sample_count() {
  return {"sample_count",
          R"(<sensor type="perspective"><float name="fov" value="40"/><film type="hdrfilm">
      <rfilter type="box"/></film><sampler type="independent"><integer name="sample_count" value="7"/>
      </sampler></sensor>)" +
              sky("1"),
          {"independent.sample_count", "perspective.sampler"},
          7,
          {},
          Measure::samples};
}

}  // namespace

const std::map<std::string, std::string>& off_default_meshes() {
  static const std::map<std::string, std::string> meshes = {
      {"floor.obj", "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\n"},
      {"triangle.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n"}};
  return meshes;
}

std::vector<OffDefault> off_defaults() {
  std::vector<OffDefault> all = {placed_sphere(),
                                 flipped_sphere(),
                                 closed_sphere_of_three(),
                                 direct_integrator(),
                                 roulette_from_depth_40(),
                                 placed_rectangle(),
                                 two_sided_rectangle(),
                                 sheared_disk(),
                                 flipped_mesh(),
                                 mesh_under_sky(),
                                 light_by_solid_angle(),
                                 scaled_map(),
                                 compensated_map(),
                                 sun_and_sky(),
                                 sun_alone(),
                                 point_light(),
                                 sample_count()};
  for (const auto& more : {off_default_bsdfs(), cameras()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace plumbline::tests
