#include "likely_part.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <iterator>
#include <numbers>
#include <string_view>
#include <utility>

#include <plumbline/renderer/assembly/names.h>
#include "colour_check.h"

namespace plumbline::tests {
namespace {

using renderer::Backend;
using renderer::LightSelection;
using renderer::SamplerType;
using renderer::Strategy;
using verify::Interval;
using verify::Verdict;
using Ways = std::vector<WayVerdict>;

/// What a fault in one part does to a way.
enum class Effect { right, wrong, either };

struct Suspect {
  std::string name;
  std::function<Effect(const Way&)> effect;
  /// Takes a suspected option away; empty where none is suspected.
  std::function<void(Way&)> without = {};
};
using Suspects = std::vector<Suspect>;

Effect wrong_if(bool condition) { return condition ? Effect::wrong : Effect::right; }

bool is_mis(const Way& way) { return way.path.strategy == Strategy::mis; }
bool is_one_sample(const Way& way) { return way.path.strategy == Strategy::one_sample; }
bool combines(const Way& way) { return is_mis(way) || is_one_sample(way); }

bool samples_lights(const Way& way) {
  return way.path.strategy != Strategy::bsdf && way.path.strategy != Strategy::uniform;
}

/// Options of a way of which one value is wrong, whatever else the way does; what most ways have is
/// left to the techniques. Beyond one bounce roulette may or may not count where it sets in late.
Suspects of_options(bool one_bounce) {
  Suspects suspects = {
      {"the Sobol points: independent ones are right",
       [](const Way& w) { return wrong_if(w.sampler == SamplerType::sobol); },
       [](Way& w) { w.sampler = SamplerType::independent; }},
      {"points on lights by solid angle: those by area are right",
       [](const Way& w) { return wrong_if(w.by_solid_angle && samples_lights(w)); },
       [](Way& w) { w.by_solid_angle = false; }},
      {"Russian roulette from the first vertex on: from later ones it is right",
       [=](const Way& w) {
         if (w.roulette == Way::Roulette::scene && !one_bounce) return Effect::either;
         return wrong_if(w.roulette == Way::Roulette::early);
       },
       [](Way& w) { w.roulette = Way::Roulette::scene; }},
      {"the scalar backend: what the batched one traces is right",
       [](const Way& w) { return wrong_if(!w.is_batched()); },
       [](Way& w) { w.backend = Backend::batched; }}};
  for (const LightSelection selection : {LightSelection::power, LightSelection::area}) {
    std::string text("the choice of lights by ");
    text.append(renderer::name(selection)).append(": chosen otherwise they are right");
    suspects.push_back({text,
                        [selection](const Way& w) {
                          return wrong_if(w.selection == selection && samples_lights(w));
                        },
                        [](Way& w) { w.selection = LightSelection::uniform; }});
  }
  return suspects;
}

/// Special cases of what combines two techniques.
Suspects of_combinations() {
  Suspects suspects = {
      {"one-sample MIS: each technique alone, and mis, are right",
       [](const Way& w) { return wrong_if(is_one_sample(w)); }},
      {"the weights of several BSDF samples: one of each technique is right",
       [](const Way& w) { return wrong_if(is_mis(w) && w.path.bsdf_samples > 1); },
       [](Way& w) { w.path.bsdf_samples = 1; }},
      {"the weights of several light samples: one of each technique is right",
       [](const Way& w) { return wrong_if(is_mis(w) && w.path.light_samples > 1); },
       [](Way& w) { w.path.light_samples = 1; }}};
  for (const renderer::Heuristic heuristic : renderer::kHeuristics) {
    std::string text("the heuristic ");
    text.append(renderer::name(heuristic)).append(": others are right");
    suspects.push_back({text,
                        [heuristic](const Way& w) {
                          return wrong_if(combines(w) && w.path.heuristic.heuristic == heuristic);
                        },
                        [](Way& w) { w.path.heuristic = other_heuristic(w); }});
  }
  return suspects;
}

/// Techniques, and the weights in general. A combination may hide a wrong technique behind its
/// weight; beyond one bounce the samples of the BSDF lead on the paths of light sampling too.
Suspects of_techniques(bool one_bounce) {
  const auto mixed = [](const Way& w) {
    return combines(w) || w.path.strategy == Strategy::average;
  };
  return {{"the BSDF's samples: light samples alone are right",
           [=](const Way& w) {
             if (mixed(w) || (!one_bounce && w.path.strategy == Strategy::light)) {
               return Effect::either;
             }
             return wrong_if(w.path.strategy == Strategy::bsdf);
           }},
          {"the light samples: BSDF samples alone are right",
           [=](const Way& w) {
             return mixed(w) ? Effect::either : wrong_if(w.path.strategy == Strategy::light);
           }},
          {"the uniform samples: all others are right",
           [](const Way& w) { return wrong_if(w.path.strategy == Strategy::uniform); }},
          {"the BSDF's value: its own samples, which carry a weight, are right",
           [=](const Way& w) {
             return mixed(w) ? Effect::either : wrong_if(w.path.strategy != Strategy::bsdf);
           }},
          {"the MIS weights, or a density that only they use: each technique alone is right",
           [=](const Way& w) { return mixed(w) ? Effect::either : Effect::right; }}};
}

/// Whether a way that fails is right without the suspected option.
bool is_shown(const Suspect& suspect, const Ways& ways) {
  return std::any_of(ways.begin(), ways.end(), [&](const WayVerdict& seen) {
    Way without = seen.way;
    suspect.without(without);
    return seen.wrong() && std::any_of(ways.begin(), ways.end(), [&](const WayVerdict& other) {
             return other.right() && other.way.name() == without.name();
           });
  });
}

/// Whether every verdict is what the suspect has it to be.
bool explains(const Suspect& suspect, const Ways& ways) {
  if (suspect.without && !is_shown(suspect, ways)) return false;
  return std::all_of(ways.begin(), ways.end(), [&](const WayVerdict& seen) {
    const Effect effect = suspect.effect(seen.way);
    return effect == Effect::either || (effect == Effect::wrong) == seen.wrong();
  });
}

/// The one suspect that explains all ways, from the first list in which any does; empty where
/// several do, or none.
std::string only_explanation(const std::vector<Suspects>& lists, const Ways& ways) {
  for (const Suspects& suspects : lists) {
    std::string named;
    for (const Suspect& suspect : suspects) {
      if (!explains(suspect, ways)) continue;
      if (!named.empty()) return {};
      named = suspect.name;
    }
    if (!named.empty()) return named;
  }
  return {};
}

/// What is wrong in all ways alike.
std::string common_part(std::optional<int> first_wrong_depth) {
  if (!first_wrong_depth) {
    return "what all ways share: the BSDF's value, what lights emit, paths or the film";
  }
  if (*first_wrong_depth <= 1) return "what the camera sees directly: emission, camera or film";
  if (*first_wrong_depth == 2) return "reflection in all ways: the BSDF's value or its side";
  return "the bookkeeping of paths, or roulette: all ways are right up to depth " +
         std::to_string(*first_wrong_depth - 1);
}

/// The ratio that all failing channels may have; empty where there is none in common.
std::optional<Interval> common_ratio(const Ways& wrong) {
  std::optional<Interval> common;
  for (const WayVerdict& way : wrong) {
    for (const ChannelVerdict& channel : way.channels) {
      if (channel.verdict != Verdict::fail) continue;
      if (!channel.ratio) return std::nullopt;
      if (!common) common = channel.ratio;
      common->low = std::max(common->low, channel.ratio->low);
      common->high = std::min(common->high, channel.ratio->high);
    }
  }
  if (!common || !(common->low <= common->high)) return std::nullopt;
  return common;
}

/// ", off by a factor of 2 (1.98 to 2.03)", where just one usual constant lies in the interval.
std::string factor(const std::optional<Interval>& ratio) {
  using std::numbers::pi;
  constexpr std::array<std::pair<std::string_view, double>, 12> kUsual{{{"1/2", 0.5},
                                                                        {"2", 2},
                                                                        {"1/4", 0.25},
                                                                        {"4", 4},
                                                                        {"1/3", 1.0 / 3},
                                                                        {"3", 3},
                                                                        {"pi", pi},
                                                                        {"1/pi", 1 / pi},
                                                                        {"2 pi", 2 * pi},
                                                                        {"1/(2 pi)", 0.5 / pi},
                                                                        {"4 pi", 4 * pi},
                                                                        {"1/(4 pi)", 0.25 / pi}}};
  if (!ratio) return {};
  std::string_view only;
  for (const auto& [name, value] : kUsual) {
    if (value < ratio->low || value > ratio->high) continue;
    if (!only.empty()) return {};
    only = name;
  }
  if (only.empty()) return {};
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "; off by a factor of %s (%.4g to %.4g)",
                std::string(only).c_str(), ratio->low, ratio->high);
  return text.data();
}

/// "; in red alone", where the other channels of every way that fails are right.
std::string channels_alone(const Ways& wrong) {
  std::string text;
  int affected = 0;
  for (std::size_t i = 0; i < kChannels.size(); ++i) {
    bool fails = false;
    for (const WayVerdict& way : wrong) {
      const Verdict verdict = way.channels[i].verdict;
      if (verdict == Verdict::inconclusive) return {};
      fails = fails || verdict == Verdict::fail;
    }
    if (!fails) continue;
    text.append(affected++ == 0 ? "; in " : " and ").append(kChannels[i].name);
  }
  return affected == 3 ? std::string() : text + " alone";
}

template <class Condition>
Ways those(const Ways& ways, const Condition& condition) {
  Ways result;
  std::copy_if(ways.begin(), ways.end(), std::back_inserter(result), condition);
  return result;
}

/// Whether there are ways that have no technique in common.
bool show_all(const Ways& ways) {
  const auto has = [&](Strategy strategy) {
    return std::any_of(ways.begin(), ways.end(),
                       [&](const WayVerdict& w) { return w.way.path.strategy == strategy; });
  };
  return has(Strategy::light) && (has(Strategy::bsdf) || has(Strategy::uniform));
}

/// Whether what fails batched, and was traced once more by the scalar backend, is all right there.
bool batched_alone(const Ways& ways) {
  const Ways again = those(ways, [&](const WayVerdict& scalar) {
    Way batched = scalar.way;
    batched.backend = Backend::batched;
    return scalar.way.backend == Backend::scalar &&
           std::any_of(ways.begin(), ways.end(), [&](const WayVerdict& w) {
             return w.wrong() && w.way.name() == batched.name();
           });
  });
  return !again.empty() &&
         std::all_of(again.begin(), again.end(), [](const WayVerdict& w) { return w.right(); });
}

/// How many of the ways that fail are asked again: more say little more.
constexpr std::size_t kMostAskedAgain = 6;

}  // namespace

std::vector<Way> ways_to_ask(const std::vector<WayVerdict>& seen) {
  const Ways wrong = those(seen, [](const WayVerdict& w) { return w.wrong(); });
  std::vector<Way> ask;
  for (std::size_t i = 0; i < std::min(wrong.size(), kMostAskedAgain); ++i) {
    const std::vector<Way> others = without_one_option(wrong[i].way);
    ask.insert(ask.end(), others.begin(), others.end());
  }
  const auto batched = [](const WayVerdict& w) { return w.way.is_batched(); };
  if (std::any_of(wrong.begin(), wrong.end(), batched)) return ask;
  for (const WayVerdict& right : those(seen, batched)) {
    ask.push_back(right.way);
    ask.back().backend = Backend::scalar;
  }
  return ask;
}

ChannelVerdict verdict_of(const verify::CheckResult& result) {
  ChannelVerdict seen{result.verdict, std::nullopt};
  if (result.interval && result.reference && *result.reference > 0) {
    seen.ratio = Interval{result.interval->low / *result.reference,
                          result.interval->high / *result.reference};
  }
  return seen;
}

bool WayVerdict::right() const {
  return std::all_of(channels.begin(), channels.end(),
                     [](const ChannelVerdict& c) { return c.verdict == Verdict::pass; });
}

bool WayVerdict::wrong() const {
  return std::any_of(channels.begin(), channels.end(),
                     [](const ChannelVerdict& c) { return c.verdict == Verdict::fail; });
}

std::string likely_part(const SceneVerdicts& scene) {
  Ways ways = those(scene.ways, [](const WayVerdict& w) { return w.right() || w.wrong(); });
  const bool batched = batched_alone(ways);
  // What the scalar backend traces is right then, and says nothing of the fault.
  if (batched) ways = those(ways, [](const WayVerdict& w) { return w.way.is_batched(); });
  const Ways wrong = those(ways, [](const WayVerdict& w) { return w.wrong(); });
  if (wrong.empty()) return {};
  const bool shared = wrong.size() == ways.size();
  if (shared && !batched && !show_all(ways)) return {};
  std::string part = shared ? common_part(scene.first_wrong_depth)
                            : only_explanation({of_options(scene.one_bounce), of_combinations(),
                                                of_techniques(scene.one_bounce)},
                                               ways);
  if (part.empty() && !batched) return {};
  if (batched) part = "the batched backend" + (part.empty() ? part : ", there " + part);
  return part + factor(common_ratio(wrong)) + channels_alone(wrong);
}

std::string part_that_sees(renderer::Strategy strategy) {
  if (strategy == renderer::Strategy::average) {
    return "likely wrong: the weights, since of light that one technique alone can find, the "
           "average "
           "of both is half";
  }
  return "likely wrong: which lights a technique is taken to find, since light that it cannot find "
         "is in its answer";
}

}  // namespace plumbline::tests
