#pragma once

#include <type_traits>

#include <plumbline/reports/results.h>

#include "json_fields.h"

/// The fields of every format, in the order in which they are written.
namespace plumbline::reports::detail {

inline constexpr const char* kCheckFormat = "plumbline.check/1";
inline constexpr const char* kEnvironmentFormat = "plumbline.environment/1";
inline constexpr const char* kRenderFormat = "plumbline.render/1";
inline constexpr const char* kSpeedFormat = "plumbline.speed/1";
inline constexpr const char* kRayCostFormat = "plumbline.ray_cost/1";
inline constexpr const char* kBarFormat = "plumbline.bar/1";
inline constexpr const char* kStabilityFormat = "plumbline.stability/1";
inline constexpr const char* kCausesFormat = "plumbline.causes/1";
inline constexpr const char* kDuetFormat = "plumbline.duet/1";
inline constexpr const char* kFigureFormat = "plumbline.figure/1";
inline constexpr const char* kTableFormat = "plumbline.table/1";
inline constexpr const char* kDistributionFormat = "plumbline.distribution/1";
inline constexpr const char* kCounterFormat = "plumbline.counter/1";
inline constexpr const char* kSeedRunFormat = "plumbline.seed_run/1";

/// Whether `T`, const or not, is `Record`: one function serves the writer and the reader.
template <class T, class Record>
concept Is = std::is_same_v<std::remove_const_t<T>, Record>;

template <class Visitor, Is<RunEnvironment> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("version", r.version);
  visit("commit", r.commit);
  visit("dirty", r.dirty);
  visit("compiler", r.compiler);
  visit("flags", r.flags);
  visit("cpu", r.cpu);
  visit("cores", r.cores);
  visit("system", r.system);
  visit("load_average", r.load_average);
  visit("time", r.time);
  visit("libraries", r.libraries);
}

template <class Visitor, Is<SpeedPoint> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("scene", r.scene);
  visit("strategy", r.strategy);
  visit("heuristic", r.heuristic);
  visit("sampler", r.sampler);
  visit("spp", r.samples_per_pixel);
  visit("seconds", r.seconds);
  visit("rays", r.rays);
  visit("rel_mse", r.rel_mse);
  visit("rel_mse_low", r.rel_mse_low);
  visit("rel_mse_high", r.rel_mse_high);
  visit("replicates", r.replicates);
}

template <class Visitor, Is<RayCost> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("scene", r.scene);
  visit("rays", r.rays);
  visit("occluded_fraction", r.occluded_fraction);
  visit("width", r.width);
  visit("count", r.count);
  visit("intersect_ns", r.intersect_ns);
  visit("occluded_ns", r.occluded_ns);
  visit("ratio", r.ratio);
  visit("ratio_low", r.ratio_low);
  visit("ratio_high", r.ratio_high);
}

template <class Visitor, Is<Bar> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("name", r.name);
  visit("unit", r.unit);
  visit("at_least", r.at_least);
  visit("limit", r.limit);
  visit("measured", r.measured);
  visit("low", r.low);
  visit("high", r.high);
  visit("indicative", r.indicative);
  visit("comparison", r.comparison);
  visit("note", r.note);
}

/// The better side of a distribution is a word in its record.
enum class Better { lower, higher };

template <>
struct EnumWords<Better> {
  static constexpr std::array<std::pair<Better, const char*>, 2> kWords{
      {{Better::lower, "lower"}, {Better::higher, "higher"}}};
};

template <class Visitor, Is<Distribution> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("name", r.name);
  visit("unit", r.unit);
  Better better = r.lower_is_better ? Better::lower : Better::higher;
  visit("better", better);
  if constexpr (!std::is_const_v<Record>) r.lower_is_better = better == Better::lower;
  visit("values", r.values);
}

template <class Visitor, Is<Counter> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("name", r.name);
  visit("unit", r.unit);
  visit("value", r.value);
}

template <class Visitor, Is<SeedRun> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("seed", r.seed);
  visit("commit", r.commit);
  visit("time", r.time);
  visit("tests", r.tests);
  visit("failures", r.failures);
}

template <class Visitor, Is<StabilityRecord> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("bsdf", r.bsdf);
  visit("function", r.function);
  visit("points", r.points);
  visit("error", r.error);
  visit("tolerance", r.tolerance);
  visit("place", r.place);
  visit("ill_conditioned", r.ill_conditioned);
  visit("ill_conditioned_error", r.ill_conditioned_error);
  visit("condition", r.condition);
  visit("ill_conditioned_place", r.ill_conditioned_place);
}

template <class Visitor, Is<JudgedTwin> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("name", r.name);
  visit("fault", r.fault);
  visit("expected", r.expected);
  visit("named", r.named);
  visit("found", r.found);
}

template <class Visitor, Is<CausesRecord> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("set", r.set);
  visit("seed", r.seed);
  visit("twins", r.twins);
}

template <class Visitor, Is<DuetRecord> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("part", r.part);
  visit("revision_a", r.revision_a);
  visit("revision_b", r.revision_b);
  visit("identical_code", r.identical_code);
  visit("confidence", r.confidence);
  visit("ratio", r.ratio);
  visit("low", r.low);
  visit("high", r.high);
  visit("a_seconds", r.a_seconds);
  visit("b_seconds", r.b_seconds);
  visit("counters_a", r.counters_a);
  visit("counters_b", r.counters_b);
}

template <>
struct EnumWords<verify::Verdict> {
  static constexpr std::array<std::pair<verify::Verdict, const char*>, 3> kWords{
      {{verify::Verdict::pass, "pass"},
       {verify::Verdict::fail, "fail"},
       {verify::Verdict::inconclusive, "inconclusive"}}};
};

template <>
struct EnumWords<verify::CheckKind> {
  static std::string_view word(verify::CheckKind kind) { return verify::to_string(kind); }
  static std::optional<verify::CheckKind> value(std::string_view word) {
    return verify::check_kind(word);
  }
};

/// An interval is written as two numbers, both null where there is none.
template <class Visitor, Is<std::optional<verify::Interval>> Interval>
void visit_interval(Visitor& visit, Interval& interval) {
  std::optional<double> low, high;
  if (interval) {
    low = interval->low;
    high = interval->high;
  }
  visit("interval_low", low);
  visit("interval_high", high);
  if constexpr (!std::is_const_v<Interval>) {
    interval.reset();
    if (low && high) interval = {*low, *high};
  }
}

/// Figures are written by name.
template <class Visitor, Is<std::vector<verify::FigureValue>> Figures>
void visit_figures(Visitor& visit, Figures& figures) {
  std::vector<std::pair<std::string, double>> named;
  for (const verify::FigureValue& figure : figures) named.emplace_back(figure.name(), figure.value);
  visit("figures", named);
  if constexpr (!std::is_const_v<Figures>) {
    figures.clear();
    for (const auto& [name, value] : named) figures.emplace_back(name, value);
  }
}

/// Each as seven numbers: ends in x, ends in y, expected samples, their error, observed ones.
template <class Visitor, class Bins>
void visit_bins(Visitor& visit, Bins& bins) {
  if (!visit.wants("bins", !bins.empty())) return;
  std::vector<std::vector<double>> rows;
  for (const verify::Bin& b : bins) {
    rows.push_back(
        {b.x.low, b.x.high, b.y.low, b.y.high, b.expected, b.expected_error, b.observed});
  }
  visit("bins", rows);
  if constexpr (!std::is_const_v<Bins>) {
    bins.clear();
    for (const std::vector<double>& row : rows) {
      if (row.size() != 7) throw FormatError("field \"bins\": a bin is not seven numbers");
      bins.push_back({{row[0], row[1]}, {row[2], row[3]}, row[4], row[5], row[6]});
    }
  }
}

template <class Visitor, Is<verify::CheckResult> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("check", r.kind);
  visit("subject", r.subject);
  visit("verdict", r.verdict);
  visit("expected", r.expected);
  visit("estimate", r.estimate);
  visit("reference", r.reference);
  visit("tolerance", r.tolerance);
  visit("bound", r.bound);
  visit("detectable", r.detectable);
  visit("p_value", r.p_value);
  visit_interval(visit, r.interval);
  visit("samples", r.samples);
  visit("seconds", r.seconds);
  visit("leaned_on", r.leaned_on);
  visit("reason", r.reason);
  visit("diagnosis", r.diagnosis);
  if (visit.wants("advice", !r.advice.empty())) visit("advice", r.advice);
  if (visit.wants("waived", !r.waived.empty())) visit("waived", r.waived);
  visit("seed", r.seed);
  visit("replay", r.replay);
  visit_figures(visit, r.figures);
  visit_bins(visit, r.bins);
}

template <class Visitor, Is<RenderRecord> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("scene", r.scene);
  visit("strategy", r.strategy);
  visit("heuristic", r.heuristic);
  visit("sampler", r.sampler);
  visit("replicates", r.replicates);
  visit("light_selection", r.light_selection);
  if (visit.wants("accelerator", !r.accelerator.empty())) visit("accelerator", r.accelerator);
  visit("spp", r.samples_per_pixel);
  if (visit.wants("adaptive", r.adaptive)) visit("adaptive", r.adaptive);
  if (visit.wants("end_sample", r.end_sample > 0)) {
    visit("first_sample", r.first_sample);
    visit("end_sample", r.end_sample);
  }
  visit("seconds", r.seconds);
  visit("camera_rays", r.camera_rays);
  visit("bounce_rays", r.bounce_rays);
  visit("shadow_rays", r.shadow_rays);
  visit("rejected", r.rejected);
  visit("non_finite", r.non_finite);
  visit("mean", r.mean);
  visit("seed", r.seed);
  visit("version", r.version);
  visit("max_depth", r.max_depth);
  visit("width", r.width);
  visit("height", r.height);
  visit("threads", r.threads);
  visit("image", r.image);
  visit("parameters", r.parameters);
}

template <>
struct EnumWords<SeriesStyle> {
  static constexpr std::array<std::pair<SeriesStyle, const char*>, 3> kWords{
      {{SeriesStyle::points, "points"},
       {SeriesStyle::line, "line"},
       {SeriesStyle::dashed, "dashed"}}};
};

template <class Visitor, Is<FigureAxis> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("label", r.label);
  visit("log", r.log);
}

template <class Visitor, Is<FigureSeries> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("name", r.name);
  visit("style", r.style);
  visit("x", r.x);
  visit("y", r.y);
  visit("low", r.low);
  visit("high", r.high);
}

template <class Visitor, Is<Figure> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("group", r.group);
  visit("title", r.title);
  visit("caption", r.caption);
  visit("x_axis", r.x);
  visit("y_axis", r.y);
  visit("series", r.series);
}

template <class Visitor, Is<Table> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("group", r.group);
  visit("title", r.title);
  visit("caption", r.caption);
  visit("columns", r.columns);
  visit("rows", r.rows);
}

}  // namespace plumbline::reports::detail
