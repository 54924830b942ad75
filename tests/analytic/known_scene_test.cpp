#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <plumbline/analytic/known_scene.h>

namespace plumbline::analytic {
namespace {

pugi::xml_document load(const KnownScene& scene) {
  pugi::xml_document document;
  const auto result = document.load_file(scene_file(scene.name).c_str());
  EXPECT_TRUE(result) << scene.name << ": " << result.description();
  return document;
}

/// @param scene  whose parameters stand in the text as $name
Vec3 parse_vector(const KnownScene& scene, std::string text) {
  for (const Parameter& parameter : scene.parameters) {
    std::string name("$");
    name.append(parameter.name);
    const std::size_t at = text.find(name);
    if (at != std::string::npos) text.replace(at, name.size(), to_text(parameter.value));
  }
  for (char& c : text) c = c == ',' ? ' ' : c;
  std::istringstream stream(text);
  Vec3 v;
  EXPECT_TRUE(stream >> v.x >> v.y >> v.z) << text;
  return v;
}

double named_value(const pugi::xml_node& parent, const char* type, const char* name) {
  const pugi::xml_node node = parent.find_child([&](const pugi::xml_node& child) {
    return std::string(child.name()) == type &&
           std::string(child.attribute("name").value()) == name;
  });
  EXPECT_TRUE(node) << name;
  return std::strtod(node.attribute("value").value(), nullptr);
}

TEST(KnownScenes, AreSortedAndComplete) {
  std::set<std::string> in_files, here;
  for (const auto& entry :
       std::filesystem::directory_iterator(scene_file("sidewalk").parent_path())) {
    if (entry.path().extension() == ".xml") in_files.insert(entry.path().stem().string());
  }
  for (const KnownScene& scene : known_scenes()) here.emplace(scene.name);
  ASSERT_EQ(here, in_files);
  for (std::size_t i = 1; i < known_scenes().size(); ++i) {
    EXPECT_LT(known_scenes()[i - 1].name, known_scenes()[i].name);
  }
  for (const KnownScene& scene : known_scenes()) {
    EXPECT_EQ(&known_scene(scene.name), &scene);
    EXPECT_FALSE(scene.answer.empty()) << scene.name;
    for (const Parameter& parameter : scene.parameters) EXPECT_FALSE(parameter.meaning.empty());
    for (const Strategy strategy : kStrategies) {
      const Expectation& expectation = scene.expectation(strategy);
      EXPECT_EQ(expectation.reason.empty(), expectation.verdict == Expected::pass)
          << scene.name << ' ' << to_string(strategy);
    }
  }
}

TEST(KnownScenes, VariantsNameParametersThatTheSceneHasAndGiveTheirReasons) {
  for (const KnownScene& scene : known_scenes()) {
    for (const Variant& variant : scene.variants) {
      EXPECT_NO_THROW(make_oracle(scene, variant.parameters, FilmSize{4, 3}))
          << scene.name << ' ' << variant.name;
      for (const Expectation& exception : variant.exceptions) {
        EXPECT_FALSE(exception.reason.empty()) << scene.name << ' ' << variant.name;
        EXPECT_EQ(&scene.expectation(exception.strategy, &variant), &exception);
      }
    }
  }
}

TEST(KnownScenes, MisIsDecidableEverywhere) {
  for (const KnownScene& scene : known_scenes()) {
    EXPECT_EQ(scene.expectation(Strategy::mis).verdict, Expected::pass) << scene.name;
    for (const Variant& variant : scene.variants) {
      EXPECT_EQ(scene.expectation(Strategy::mis, &variant).verdict, Expected::pass) << scene.name;
    }
  }
}

TEST(KnownScenes, DefaultsAreThoseOfTheSceneFile) {
  for (const KnownScene& scene : known_scenes()) {
    const pugi::xml_document document = load(scene);
    std::map<std::string, std::string> in_file;
    for (const pugi::xml_node& node : document.child("scene").children("default")) {
      std::string value = node.attribute("value").value();
      value.erase(std::remove(value.begin(), value.end(), ' '), value.end());
      in_file[node.attribute("name").value()] = value;
    }
    std::map<std::string, std::string> here;
    for (const Parameter& p : scene.parameters) here[std::string(p.name)] = to_text(p.value);
    EXPECT_EQ(here, in_file) << scene.name;
  }
}

TEST(KnownScenes, CameraFilmAndDepthAreThoseOfTheSceneFile) {
  for (const KnownScene& scene : known_scenes()) {
    SCOPED_TRACE(std::string(scene.name));
    const pugi::xml_document document = load(scene);
    const pugi::xml_node root = document.child("scene");
    EXPECT_EQ(std::string(root.attribute("version").value()), "3.0.0");
    EXPECT_EQ(named_value(root.child("integrator"), "integer", "max_depth"), scene.max_depth);
    const pugi::xml_node sensor = root.child("sensor");
    EXPECT_EQ(named_value(sensor, "float", "fov"), scene.view.fov_x_degrees);
    const pugi::xml_node lookat = sensor.child("transform").child("lookat");
    EXPECT_EQ(parse_vector(scene, lookat.attribute("origin").value()), scene.view.origin);
    EXPECT_EQ(parse_vector(scene, lookat.attribute("target").value()), scene.view.target);
    EXPECT_EQ(parse_vector(scene, lookat.attribute("up").value()), scene.view.up);
    const pugi::xml_node film = sensor.child("film");
    EXPECT_EQ(named_value(film, "integer", "width"), scene.film.width);
    EXPECT_EQ(named_value(film, "integer", "height"), scene.film.height);
    EXPECT_EQ(std::string(film.child("rfilter").attribute("type").value()), "box");
  }
}

/// A fault that mixes up two channels changes every answer by more than a check's tolerance.
bool channels_differ(const Colour& answer) {
  const auto differ = [](double a, double b) { return std::abs(a - b) > 0.02 * std::max(a, b); };
  return differ(answer.r, answer.g) && differ(answer.g, answer.b) && differ(answer.b, answer.r);
}

TEST(KnownScenes, OraclesGivePixelsOfAnyResolutionInThreeDifferentChannels) {
  for (const KnownScene& scene : known_scenes()) {
    const auto oracle = make_oracle(scene, {}, FilmSize{8, 6});
    EXPECT_EQ(oracle->image().size(), 48U) << scene.name;
    const Average mean = oracle->image_mean();
    EXPECT_TRUE(in_every_channel([](double x, double e) { return x > 0 && e <= 1e-5 * x; },
                                 mean.value, mean.error))
        << scene.name;
    EXPECT_TRUE(channels_differ(mean.value)) << scene.name << ": " << to_text(mean.value);
  }
}

TEST(KnownScenes, ParametersReachTheOracle) {
  const auto oracle =
      make_oracle(known_scene("furnace_sphere"), {{"albedo", 0.75}, {"radiance", 3.0}});
  EXPECT_DOUBLE_EQ(oracle->pixel_mean(3, 4).value.b, 12);
  const auto truncated =
      make_oracle(known_scene("furnace_cube"), {{"radiance", 1.0}}, std::nullopt, 3);
  EXPECT_DOUBLE_EQ(truncated->image_mean().value.g, 1.75);
}

TEST(KnownScenes, InGreyGiveTheGreenChannel) {
  for (const KnownScene& scene : known_scenes()) {
    for (const auto& [name, value] : in_grey(scene)) {
      EXPECT_TRUE(value.is_grey()) << scene.name << ' ' << name;
    }
  }
  for (const char* name : {"furnace_sphere", "lights_overlap", "sidewalk"}) {
    const KnownScene& scene = known_scene(name);
    const Colour grey = make_oracle(scene, in_grey(scene))->image_mean().value;
    EXPECT_TRUE(grey.is_grey()) << name;
    const Colour colour = make_oracle(scene)->image_mean().value;
    EXPECT_NEAR(grey.g, colour.g, 1e-9 * colour.g) << name;
  }
}

TEST(KnownScenes, ForPbrtAreInGreyAndSaySo) {
  for (const KnownScene& scene : known_scenes()) {
    std::filesystem::path pbrt = scene_file(scene.name);
    std::ifstream in(pbrt.replace_extension(".pbrt"));
    if (!in) continue;  // which there are is held by ShippedScenes
    std::string text;
    for (std::string line; std::getline(in, line);) text += line + "\n";
    EXPECT_NE(text.find("in grey, its green channel in all three:"), std::string::npos) << pbrt;
    for (const Parameter& p : scene.parameters) {
      if (p.value.is_grey()) continue;
      std::string definition = " -D ";
      definition.append(p.name).append("=").append(to_text(p.value.g));
      EXPECT_NE(text.find(definition), std::string::npos) << pbrt << definition;
    }
  }
}

TEST(KnownScenes, RefuseWhatTheyDoNotKnow) {
  EXPECT_EQ(find_known_scene("cornell"), nullptr);
  EXPECT_THROW(known_scene("cornell"), std::invalid_argument);
  EXPECT_THROW(scene_file("../furnace_open"), std::invalid_argument);
  EXPECT_THROW(make_oracle(known_scene("furnace_open"), {{"albdo", 0.5}}), std::invalid_argument);
  EXPECT_THROW(make_oracle(known_scene("sphere_light"), {{"height", Colour{1, 2, 3}}}),
               std::invalid_argument);
  EXPECT_THROW(make_oracle(known_scene("furnace_open"), {}, FilmSize{0, 4}), std::invalid_argument);
  EXPECT_THROW(make_oracle(known_scene("furnace_open"), {}, std::nullopt, -2),
               std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::analytic
