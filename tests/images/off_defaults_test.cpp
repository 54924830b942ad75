#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/image_io/exr.h>
#include <plumbline/renderer/scene_file/load_scene.h>
#include <plumbline/verify/mean.h>
#include <plumbline_tests/support.h>
#include "likely_part.h"
#include "off_defaults.h"
#include "path_samples.h"

/// Every parameter of every element of a scene, as the loader's tables list them, is off its
/// default in a scene whose answer is known and depends on it.
namespace plumbline::tests {
namespace {

using renderer::SceneDescription;
using renderer::Strategy;

SceneDescription load_off_default(const std::string& scene) {
  const ScratchDirectory directory;
  for (const auto& [name, text] : off_default_meshes()) directory.write(name, text);
  renderer::Image image{4, 2, {}, {}, {}, {}};
  for (const float grey : kOffDefaultMap) image.pixels.push_back({grey, grey, grey});
  write_exr(directory.path() / "map.exr", image);
  return renderer::load_scene(
      directory.write("scene.xml", "<scene version=\"3.0.0\">" + scene + "</scene>"));
}

/// What a scene says of itself, where nothing is estimated.
double measured(Measure measure, const SceneDescription& description) {
  const renderer::Scene scene = renderer::make_scene(one_pixel(description));
  if (measure == Measure::light_pdf) {
    return static_cast<double>(
        scene.lights().pdf_at_hit(0, renderer::Vec3f{}, renderer::Vec3f{0, 0, 1}));
  }
  renderer::RenderOptions options;
  options.samples_per_pixel = static_cast<std::uint32_t>(description.samples_per_pixel);
  options.path = {.strategy = Strategy::bsdf,
                  .max_depth = description.integrator.max_depth,
                  .rr_depth = description.integrator.rr_depth};
  const renderer::RenderResult result = render(scene, options);
  if (measure == Measure::samples) return result.film.at(0, 0).count;
  return static_cast<double>(result.counters.bounce_rays) /
         static_cast<double>(result.counters.camera_rays);
}

verify::CheckResult luminance_check(const OffDefault& known, const SceneDescription& description,
                                    Strategy strategy, std::uint64_t max_samples) {
  verify::MeanOptions options;
  options.subject = "off default/" + known.name + "/";
  options.subject.append(name(strategy));
  options.reference = known.answer;
  options.tolerance = nightly() ? known.tolerance / 5 : known.tolerance;
  options.max_samples = max_samples;
  options.seed = check_seed(options.subject);
  const renderer::Scene scene = renderer::make_scene(one_pixel(description));
  const renderer::PathOptions path{.strategy = strategy,
                                   .max_depth = description.integrator.max_depth,
                                   .rr_depth = description.integrator.rr_depth};
  return check_mean(options, luminance_samples(scene, path, options.seed));
}

/// "type.property", or "type" where it has none, with what the loader's table says of it.
struct Parameter {
  std::string tag, type;
  std::optional<renderer::SupportedProperty> property;

  std::string name() const { return property ? type + "." + property->name : type; }

  /// One of a single value cannot be off its default, and what has no effect changes no answer.
  bool has_a_choice() const {
    return !property ||
           (property->range != property->absent && property->absent != "without effect");
  }
};

std::vector<Parameter> all_parameters() {
  std::vector<Parameter> all;
  for (const char* tag :
       {"integrator", "sensor", "film", "rfilter", "sampler", "bsdf", "shape", "emitter"}) {
    for (const renderer::SupportedType& type : renderer::supported_types(tag)) {
      if (type.properties.empty()) all.push_back({tag, type.name, {}});
      for (const auto& property : type.properties) all.push_back({tag, type.name, property});
    }
  }
  return all;
}

const Parameter& parameter_called(const std::string& name) {
  static const std::vector<Parameter> all = all_parameters();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.name() == name; });
  if (found == all.end()) throw std::logic_error("the loader knows no parameter " + name);
  return *found;
}

/// Whether a child of an element gives a property.
bool gives(const pugi::xml_node& child, const renderer::SupportedProperty& property) {
  if (property.kind != "object") return child.attribute("name").value() == property.name;
  const std::string tag = child.name();
  return tag == property.name || (property.name == "bsdf" && tag == "ref");
}

/// Numbers of a value, commas or not; none where it is no list of numbers.
std::vector<double> numbers_in(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double x; stream >> x;) numbers.push_back(x);
  return stream.eof() ? numbers : std::vector<double>{};
}

/// Whether what an element says is not what its absence would say.
bool is_off_default(const pugi::xml_node& child, const renderer::SupportedProperty& property) {
  if (property.kind == "object" || property.absent == "required") return true;
  if (property.kind == "transform") return static_cast<bool>(child.first_child());
  const std::vector<double> absent = numbers_in(property.absent);
  for (const pugi::xml_attribute attribute : child.attributes()) {
    const std::string text = attribute.value();
    if (std::string(attribute.name()) == "name") continue;
    const std::vector<double> given = numbers_in(text);
    if (given.empty() || absent.size() != 1) return text != property.absent;
    if (std::any_of(given.begin(), given.end(), [&](double x) { return x != absent[0]; }))
      return true;
  }
  return false;
}

/// The scene with a parameter left out wherever it stands off its default; how often that was.
struct Without {
  std::string scene;
  int count = 0;
};

Without without(const std::string& scene, const Parameter& parameter) {
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_string(("<all>" + scene + "</all>").c_str()));
  Without result;
  for (const pugi::xpath_node& place :
       xml.select_nodes(("//" + parameter.tag + "[@type='" + parameter.type + "']").c_str())) {
    pugi::xml_node element = place.node();
    std::vector<pugi::xml_node> given;
    for (const pugi::xml_node& child : element.children()) {
      if (parameter.property && gives(child, *parameter.property) &&
          is_off_default(child, *parameter.property)) {
        given.push_back(child);
      }
    }
    for (const pugi::xml_node& child : given) element.remove_child(child);
    result.count += static_cast<int>(given.size());
    if (!parameter.property) {
      element.parent().remove_child(element);
      ++result.count;
    }
  }
  std::ostringstream text;
  for (const pugi::xml_node& node : xml.first_child().children()) node.print(text);
  result.scene = text.str();
  return result;
}

class OffDefaults : public testing::TestWithParam<OffDefault> {
 protected:
  /// The answer by every strategy that finds all light; those that fail say what all together show.
  static void expect_answer_in_every_way(const SceneDescription& description) {
    std::vector<verify::CheckResult> results;
    SceneVerdicts seen;
    seen.one_bounce = description.integrator.max_depth == 2;
    for (const Strategy strategy : GetParam().strategies) {
      results.push_back(luminance_check(GetParam(), description, strategy, 1 << 26));
      const ChannelVerdict luminance = verdict_of(results.back());
      seen.ways.push_back({{.path = {.strategy = strategy}}, {luminance, luminance, luminance}});
    }
    const std::string part = likely_part(seen);
    for (verify::CheckResult& result : results) {
      if (!result.as_expected()) result.diagnosis = part;
      expect_verdict(result);
    }
  }

  /// The answer is another one without the parameter, or there is none.
  static void expect_dependence(const Parameter& parameter) {
    const Without rest = without(GetParam().scene, parameter);
    ASSERT_GT(rest.count, 0) << parameter.name() << " is not off its default here";
    std::optional<SceneDescription> description;
    try {
      description = load_off_default(rest.scene);
      renderer::make_scene(one_pixel(*description));
    } catch (const renderer::InputError& error) {
      // A light without its transform may lie in the floor, which is refused.
      const std::string what = error.what();
      const std::string name = parameter.property ? parameter.property->name : parameter.tag;
      EXPECT_TRUE(what.find(name) != std::string::npos ||
                  (name == "to_world" && what.find("two surfaces in one place") < what.size()))
          << what;
      return;
    }
    if (GetParam().measure != Measure::luminance) {
      EXPECT_GT(std::abs(measured(GetParam().measure, *description) / GetParam().answer - 1), 0.01)
          << "the answer does not depend on " << parameter.name();
      return;
    }
    // That samples which are all alike do not hide a rare one takes a million of them: here it is
    // enough that those there are exclude the answer.
    constexpr std::uint64_t kFew = 20'000;
    const verify::CheckResult r =
        luminance_check(GetParam(), *description, GetParam().strategies.back(), kFew);
    EXPECT_NE(r.verdict, verify::Verdict::pass) << parameter.name();
    ASSERT_TRUE(r.interval) << describe(r);
    EXPECT_TRUE(r.interval->high < GetParam().answer || r.interval->low > GetParam().answer)
        << "the answer does not depend on " << parameter.name() << ": " << describe(r);
  }
};

TEST_P(OffDefaults, GiveTheirAnswerAndAnotherWithoutAnyParameterOfTheirs) {
  const SceneDescription description = load_off_default(GetParam().scene);
  if (GetParam().measure == Measure::luminance) expect_answer_in_every_way(description);
  if (GetParam().measure != Measure::luminance) {
    // Counts, and a solid angle in float.
    EXPECT_NEAR(measured(GetParam().measure, description) / GetParam().answer, 1, 1e-6);
  }
  for (const std::string& name : GetParam().covers) expect_dependence(parameter_called(name));
}

std::string scene_name(const testing::TestParamInfo<OffDefault>& known) { return known.param.name; }

INSTANTIATE_TEST_SUITE_P(All, OffDefaults, testing::ValuesIn(off_defaults()), scene_name);

TEST(OffDefaults, CoverEveryParameterOfEveryElement) {
  std::set<std::string> covered;
  for (const OffDefault& known : off_defaults()) {
    covered.insert(known.covers.begin(), known.covers.end());
  }
  int without_choice = 0;
  for (const Parameter& parameter : all_parameters()) {
    without_choice += parameter.has_a_choice() ? 0 : 1;
    EXPECT_TRUE(!parameter.has_a_choice() || covered.count(parameter.name()) > 0)
        << "parameter " << (parameter.property ? parameter.property->name : "(none)") << " of <"
        << parameter.tag << " type=\"" << parameter.type
        << "\"> has no known answer off its default: add one to tests/images/off_defaults.cpp";
  }
  // The film's formats of pixels, of components and of files; the camera's near_clip, far_clip and
  // focus_distance.
  EXPECT_EQ(without_choice, 6);
}

}  // namespace
}  // namespace plumbline::tests
