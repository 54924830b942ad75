#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/estimators/allocation.h>
#include <plumbline/renderer/scene_file/load_scene.h>

#include "command.h"

namespace plumbline::tools {
namespace {

struct Entry {
  std::string name, meaning;
};

/// Something that can be listed.
struct Topic {
  std::string name, title;
  std::vector<Entry> entries;
};

std::string parameters_of(const analytic::KnownScene& scene) {
  std::string text;
  for (const analytic::Parameter& parameter : scene.parameters) {
    text += fmt::format("\n    -D {}={}  {}", parameter.name, to_text(parameter.value),
                        parameter.meaning);
  }
  return text;
}

Topic scenes() {
  Topic topic{"scenes", "scenes whose answer is known", {}};
  for (const analytic::KnownScene& scene : analytic::known_scenes()) {
    topic.entries.push_back(
        {std::string(scene.name), std::string(scene.answer) + parameters_of(scene)});
  }
  return topic;
}

std::string meaning(renderer::Strategy strategy) {
  switch (strategy) {
    case renderer::Strategy::bsdf:
      return "directions from the BSDF only";
    case renderer::Strategy::light:
      return "points on lights only";
    case renderer::Strategy::uniform:
      return "directions uniform on the hemisphere only";
    case renderer::Strategy::mis:
      return "light and BSDF samples (--counts; one each without it), weighted by a heuristic";
    case renderer::Strategy::one_sample:
      return "light or BSDF, chosen at random (--light-probability), weighted by a heuristic";
    case renderer::Strategy::average:
      return "half of each, whatever their densities: a negative control, wrong where one is blind";
  }
  return {};
}

Topic strategies() {
  Topic topic{"strategies", "strategies for direct light at every vertex", {}};
  for (const renderer::Strategy strategy : renderer::kStrategies) {
    topic.entries.push_back({std::string(name(strategy)), meaning(strategy)});
  }
  return topic;
}

std::string meaning(renderer::Heuristic heuristic) {
  switch (heuristic) {
    case renderer::Heuristic::balance:
      return "q / sum of q, with q = count * pdf";
    case renderer::Heuristic::power:
      return "q^b / sum of q^b; power=b, 2 without it";
    case renderer::Heuristic::cutoff:
      return "balance among those with q >= a * the largest; cutoff=a, 0.1 without it";
    case renderer::Heuristic::maximum:
      return "1 for the largest q";
  }
  return {};
}

std::string meaning(renderer::Allocation policy) {
  switch (policy) {
    case renderer::Allocation::equal:
      return "as many BSDF as light samples";
    case renderer::Allocation::lu:
      return "one Newton step from equal counts (Lu et al. 2013)";
    case renderer::Allocation::sbert_moment:
      return "shares by inverse second moments (Sbert et al. 2018)";
    case renderer::Allocation::sbert_variance:
      return "shares by inverse variances (Sbert et al. 2018)";
    case renderer::Allocation::root_v1:
      return "Newton's method on V', each technique by its own samples (Root Adaptive MIS)";
    case renderer::Allocation::root_v2:
      return "Newton's method on V', by all samples of an iteration (Root Adaptive MIS)";
    case renderer::Allocation::root_nodes:
      return "root of V' between nodes at which all samples so far estimate it";
    case renderer::Allocation::cost_aware:
      return "the same for variance x time, with --cost-ratio";
  }
  return {};
}

Topic allocations() {
  Topic topic{"allocations", "allocations of direct light samples to BSDF and lights", {}};
  for (const renderer::Allocation policy : renderer::kAllocations) {
    topic.entries.push_back({std::string(name(policy)), meaning(policy)});
  }
  return topic;
}

Topic heuristics() {
  Topic topic{"heuristics", "heuristics for the weights of mis and one-sample", {}};
  for (const renderer::Heuristic heuristic : renderer::kHeuristics) {
    topic.entries.push_back({std::string(name(heuristic)), meaning(heuristic)});
  }
  return topic;
}

/// What a scene file may name as the type of an element.
Topic types(const std::string& topic_name, const std::string& tag) {
  Topic topic{topic_name, fmt::format("<{} type=…> in a scene file", tag), {}};
  for (const renderer::SupportedType& type : renderer::supported_types(tag)) {
    topic.entries.push_back({type.name, {}});
  }
  return topic;
}

std::vector<Topic> topics() {
  return {scenes(),
          strategies(),
          heuristics(),
          allocations(),
          types("bsdfs", "bsdf"),
          types("lights", "emitter"),
          types("shapes", "shape"),
          types("integrators", "integrator")};
}

void print(const Topic& topic, bool names_only) {
  if (!names_only) fmt::print("{}:\n", topic.title);
  for (const Entry& entry : topic.entries) {
    if (names_only) {
      fmt::print("{}\n", entry.name);
    } else if (entry.meaning.empty()) {
      fmt::print("  {}\n", entry.name);
    } else {
      fmt::print("  {:<16} {}\n", entry.name, entry.meaning);
    }
  }
}

struct ListArguments {
  std::string topic;
  bool names_only = false;
};

int run_list(const ListArguments& arguments) {
  for (const Topic& topic : topics()) {
    if (arguments.topic.empty() || topic.name == arguments.topic) {
      print(topic, arguments.names_only);
    }
  }
  return kExitFine;
}

}  // namespace

void add_list_command(options::CommandLine& line) {
  const auto arguments = std::make_shared<ListArguments>();
  options::Command command = line.add_command("list", "List what can be rendered, and how");
  std::vector<std::string> names;
  for (const Topic& topic : topics()) names.push_back(topic.name);
  command
      .add("topic", arguments->topic,
           fmt::format("One of {}; everything without it", fmt::join(names, ", ")))
      .one_of(names)
      .type("");
  command.add_flag("--names", arguments->names_only, "Names only, one on a line");
  command.footer("Example:\n  plumbline list scenes --names");
  command.runs([arguments] { return run_list(*arguments); });
}

}  // namespace plumbline::tools
