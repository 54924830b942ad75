#include "placed_scene.h"

#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace plumbline::tests {
namespace {

using renderer::Rgbd;
using renderer::Vec3d;

constexpr double kFar = 20;              // centres of the two black spheres, in every coordinate
constexpr double kBlackRadius = 0.0075;  // that is PlacedShape::kRadius scaled by a hundredth
constexpr double kEdge = 1e-3;

/// ITU-R BT.709-6, Section 3.2.
double brightness(const Rgbd& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

PlacedShape sphere_at(const Vec3d& center, double scale) {
  return {Model::sphere,
          {{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}, center - PlacedShape::kCenter * scale},
          false};
}

std::string rgb(const char* name, const Rgbd& c) {
  return fmt::format("<rgb name=\"{}\" value=\"{} {} {}\"/>", name, c.r, c.g, c.b);
}

}  // namespace

std::string PlacedEmitter::xml() const {
  constexpr const char* kTypes[] = {"sphere", "rectangle", "disk", "obj"};
  const Model model = shape.model();
  std::string text = fmt::format("<shape type=\"{}\">{}", kTypes[static_cast<int>(model)],
                                 shape.placement().xml());
  if (model == Model::sphere) {
    const Vec3d c = PlacedShape::kCenter;
    text += fmt::format("<point name=\"center\" value=\"{} {} {}\"/>", c.x, c.y, c.z);
    text += fmt::format("<float name=\"radius\" value=\"{}\"/>", PlacedShape::kRadius);
  }
  if (model == Model::mesh) {
    text += "<string name=\"filename\" value=\"mesh.obj\"/>";
    text += "<boolean name=\"face_normals\" value=\"true\"/>";
  }
  if (shape.flip_normals()) text += "<boolean name=\"flip_normals\" value=\"true\"/>";
  if (emits()) {
    text += "<emitter type=\"area\">" + rgb("radiance", radiance);
    if (by_solid_angle) text += "<string name=\"sampling\" value=\"solid_angle\"/>";
    if (two_sided) text += "<boolean name=\"two_sided\" value=\"true\"/>";
    text += "</emitter>";
  }
  return text + "</shape>\n";
}

PlacedScene::PlacedScene(const PlacedEmitter& target) {
  emitters.push_back(target);
  emitters.push_back({sphere_at({12, 1, -2}, 2), {0.5, 2, 4}});
  const double scale = kBlackRadius / PlacedShape::kRadius;
  emitters.push_back({sphere_at({kFar, kFar, kFar}, scale)});
  emitters.push_back({sphere_at({-kFar, -kFar, -kFar}, scale)});
}

std::string PlacedScene::xml() const {
  std::string text;
  for (const PlacedEmitter& emitter : emitters) text += emitter.xml();
  text += fmt::format(
      "<emitter type=\"point\"><point name=\"position\" value=\"{} {} {}\"/>{}</emitter>\n",
      point.x, point.y, point.z, rgb("intensity", intensity));
  return text + "<emitter type=\"constant\">" + rgb("radiance", environment) + "</emitter>\n";
}

double PlacedScene::radius() const { return std::sqrt(3.0) * (kFar + kBlackRadius); }

std::optional<FirstMet> PlacedScene::first(const Vec3d& ref, const Vec3d& wi, double edge) const {
  std::optional<FirstMet> nearest;
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    for (const Meeting& meeting : emitters[i].shape.meetings(ref, wi, edge)) {
      if (!nearest || meeting.distance < nearest->meeting.distance) nearest = {i, meeting};
    }
  }
  return nearest;
}

bool PlacedScene::clear(const Vec3d& ref, const Vec3d& wi) const {
  const auto wide = first(ref, wi, kEdge), narrow = first(ref, wi, -kEdge);
  if (!wide || !narrow) return wide.has_value() == narrow.has_value();
  return wide->emitter == narrow->emitter && wide->meeting.part == narrow->meeting.part &&
         dot(wide->meeting.normal, wi) * dot(narrow->meeting.normal, wi) > 0;
}

std::uint32_t PlacedScene::light_of(std::size_t emitter, std::size_t part) const {
  std::size_t before = part;
  for (std::size_t i = 0; i < emitter; ++i) {
    if (emitters[i].emits()) before += emitters[i].shape.parts();
  }
  return static_cast<std::uint32_t>(before);
}

std::uint32_t PlacedScene::point_light() const { return light_of(emitters.size(), 0); }

double PlacedScene::pmf(renderer::LightSelection selection, std::uint32_t light) const {
  std::vector<double> shares;  // of the shapes that emit, the point and the environment
  for (const PlacedEmitter& e : emitters) {
    if (!e.emits()) continue;
    const double sides = e.two_sided ? 2 : 1;
    const bool by_area = selection == renderer::LightSelection::area;
    shares.push_back(by_area ? e.shape.area()
                             : sides * renderer::pi<double>() * e.shape.area() *
                                   brightness(e.radiance));
  }
  const double mean_area = (shares[0] + shares[1]) / 2;
  if (selection == renderer::LightSelection::area) {
    shares.insert(shares.end(), 2, mean_area);  // those without count like the average
  } else {
    shares.push_back(4 * renderer::pi<double>() * brightness(intensity));
    shares.push_back(4 * renderer::pi<double>() * brightness(environment) * renderer::pi<double>() *
                     radius() * radius());
  }
  if (selection == renderer::LightSelection::uniform) shares.assign(4, 1);
  const double total = std::accumulate(shares.begin(), shares.end(), 0.0);

  const std::size_t parts = emitters.front().shape.parts();
  if (light >= parts) return shares[light - parts + 1] / total;
  return shares[0] / total * emitters.front().shape.area(light) / emitters.front().shape.area();
}

}  // namespace plumbline::tests
