#include "page_data.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plumbline/reports/power_fit.h>

#include "history_fields.h"
#include "record_fields.h"

namespace plumbline::reports::detail {
namespace {

/// Half-width of a 95 % interval of a normal distribution in standard errors.
constexpr double kNormal95 = 1.959963984540054;

Json summary_to_json(const Summary& summary) {
  return Json::object({{"passed", summary.passed},
                       {"failed_as_expected", summary.failed_as_expected},
                       {"inconclusive_as_expected", summary.inconclusive_as_expected},
                       {"waived", summary.waived},
                       {"unexpected", summary.unexpected},
                       {"unreadable", summary.unreadable},
                       {"good", summary.good()}});
}

/// A seed as text: JavaScript's numbers would round it.
template <class Record>
Json with_exact_seed(const Record& record) {
  Json json = record_to_json(record);
  json["seed"] = std::to_string(record.seed);
  return json;
}

Json checks_to_json(const std::vector<verify::CheckResult>& checks) {
  Json list = Json::array();
  for (const verify::CheckResult& check : checks) {
    Json json = with_exact_seed(check);
    json["as_expected"] = check.as_expected();
    list.push_back(std::move(json));
  }
  return list;
}

Json warnings_to_json(const std::vector<ReadWarning>& warnings) {
  Json list = Json::array();
  for (const ReadWarning& warning : warnings) {
    list.push_back(Json::object({{"file", warning.file.filename().string()},
                                 {"line", warning.line},
                                 {"what", warning.what}}));
  }
  return list;
}

/// What is said of an image; its pixels stand beside the data (page_pixels).
Json image_to_json(const PageImage& image) {
  return Json::object({{"group", image.group},
                       {"name", image.name},
                       {"width", image.width},
                       {"height", image.height}});
}

template <class Record>
Json list_to_json(const std::vector<Record>& records) {
  Json list = Json::array();
  for (const Record& record : records) list.push_back(record_to_json(record));
  return list;
}

/// The points of one scene that belong on one line.
struct SpeedCurve {
  std::string strategy, heuristic, sampler;
  std::vector<SpeedPoint> points;

  bool takes(const SpeedPoint& p) const {
    return p.strategy == strategy && p.heuristic == heuristic && p.sampler == sampler;
  }
};

struct SpeedScene {
  std::string name;
  std::vector<SpeedCurve> curves;
};

template <class Range, class Condition>
auto* find_where(Range& range, const Condition& condition) {
  for (auto& element : range) {
    if (condition(element)) return &element;
  }
  return static_cast<decltype(&*range.begin())>(nullptr);
}

std::vector<SpeedScene> curves_by_scene(const std::vector<SpeedPoint>& points) {
  std::vector<SpeedScene> scenes;
  for (const SpeedPoint& point : points) {
    SpeedScene* scene =
        find_where(scenes, [&](const SpeedScene& s) { return s.name == point.scene; });
    if (scene == nullptr) scene = &scenes.emplace_back(SpeedScene{point.scene, {}});
    SpeedCurve* curve =
        find_where(scene->curves, [&](const SpeedCurve& c) { return c.takes(point); });
    if (curve == nullptr) {
      curve = &scene->curves.emplace_back(
          SpeedCurve{point.strategy, point.heuristic, point.sampler, {}});
    }
    curve->points.push_back(point);
  }
  return scenes;
}

/// Error is the root of relMSE, so that its slope against time is −1/2 for a plain estimator.
PowerFit fit_error_against_time(const SpeedCurve& curve) {
  std::vector<PowerFitPoint> points;
  for (const SpeedPoint& p : curve.points) {
    const double log_width = std::log(p.rel_mse_high) - std::log(p.rel_mse_low);
    points.push_back({p.seconds, std::sqrt(p.rel_mse), log_width / (2 * kNormal95) / 2});
  }
  return fit_power(points);
}

Json curve_to_json(const SpeedCurve& curve) {
  const PowerFit fit = fit_error_against_time(curve);
  return Json::object({{"strategy", curve.strategy},
                       {"heuristic", curve.heuristic},
                       {"sampler", curve.sampler},
                       {"points", list_to_json(curve.points)},
                       {"factor", json_from_double(fit.factor)},
                       {"slope", json_from_double(fit.exponent)},
                       {"slope_error", json_from_double(fit.exponent_error)}});
}

Json speed_to_json(const std::vector<SpeedPoint>& points) {
  Json scenes = Json::array();
  for (const SpeedScene& scene : curves_by_scene(points)) {
    Json curves = Json::array();
    for (const SpeedCurve& curve : scene.curves) curves.push_back(curve_to_json(curve));
    scenes.push_back(Json::object({{"scene", scene.name}, {"curves", std::move(curves)}}));
  }
  return scenes;
}

Json bars_to_json(const std::vector<Bar>& bars) {
  Json list = Json::array();
  for (const Bar& bar : bars) {
    Json json = record_to_json(bar);
    json["verdict"] = verdict(bar);
    list.push_back(std::move(json));
  }
  return list;
}

template <class Record>
Json list_with_exact_seeds(const std::vector<Record>& records) {
  Json list = Json::array();
  for (const Record& record : records) list.push_back(with_exact_seed(record));
  return list;
}

/// What a page shows of a duet: how many pairs there were, not each of them. A hash of results is
/// more than JavaScript's numbers hold; whether it differs is what it is for.
Json duets_to_json(const std::vector<DuetRecord>& duets) {
  Json list = Json::array();
  for (DuetRecord duet : duets) {
    const std::size_t pairs = duet.a_seconds.size();
    const std::string_view said = verdict(duet);
    const bool differ = duet.counters_a["result"] != duet.counters_b["result"];
    for (auto* counters : {&duet.counters_a, &duet.counters_b}) counters->erase("result");
    duet.a_seconds.clear();
    duet.b_seconds.clear();
    Json json = record_to_json(duet);
    json["pairs"] = std::uint64_t{pairs};
    json["verdict"] = said;
    json["results_differ"] = differ;
    list.push_back(std::move(json));
  }
  return list;
}

/// Significant digits of what is plotted: more than a plot shows, in a third of the space or less.
constexpr int kDigitsOfNumbers = 5, kDigitsOfBounds = 3;

void round_for_plots(std::vector<double>& values, int digits) {
  for (double& value : values) {
    if (!std::isfinite(value)) continue;
    std::array<char, 32> text;
    const auto written = std::to_chars(text.data(), text.data() + text.size(), value,
                                       std::chars_format::scientific, digits - 1);
    std::from_chars(text.data(), written.ptr, value);
  }
}

HistoryRecord rounded_for_plots(HistoryRecord history) {
  for (TrackedNumber& number : history.numbers) {
    if (number.counter) continue;
    for (std::vector<double>* values : {&number.median, &number.low, &number.high}) {
      round_for_plots(*values, kDigitsOfNumbers);
    }
  }
  for (TrackedSequence& sequence : history.sequences) {
    round_for_plots(sequence.bound, kDigitsOfBounds);
    round_for_plots(sequence.evidence, kDigitsOfBounds);
  }
  return history;
}

Json histories_to_json(const std::vector<HistoryRecord>& histories) {
  Json list = Json::array();
  for (const HistoryRecord& history : histories) {
    Json json = record_to_json(rounded_for_plots(history));
    json["failing_gate_runs"] = list_with_exact_seeds(history.failing_gate_runs);
    list.push_back(std::move(json));
  }
  return list;
}

Json answers_to_json(const std::map<std::string, std::string>& answers) {
  Json json = Json::object();
  for (const auto& [scene, answer] : answers) json[scene] = answer;
  return json;
}

}  // namespace

std::string page_data(const PageInput& input) {
  const Results& results = input.results;
  Json images = Json::array();
  for (const PageImage& image : input.images) images.push_back(image_to_json(image));
  const Json data = Json::object({{"summary", summary_to_json(summarise(results))},
                                  {"environments", list_to_json(results.environments)},
                                  {"warnings", warnings_to_json(results.warnings)},
                                  {"checks", checks_to_json(results.checks)},
                                  {"images", std::move(images)},
                                  {"answers", answers_to_json(input.answers)},
                                  {"renders", list_with_exact_seeds(results.renders)},
                                  {"speed", speed_to_json(results.speed)},
                                  {"ray_costs", list_to_json(results.ray_costs)},
                                  {"bars", bars_to_json(results.bars)},
                                  {"causes", list_with_exact_seeds(results.causes)},
                                  {"stability", list_to_json(results.stability)},
                                  {"history", histories_to_json(results.histories)},
                                  {"duets", duets_to_json(results.duets)},
                                  {"figures", list_to_json(results.figures)},
                                  {"tables", list_to_json(results.tables)}});
  return data.dump();
}

}  // namespace plumbline::reports::detail
