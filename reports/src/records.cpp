#include "record_fields.h"

namespace plumbline::reports {
namespace {

void require_same_lengths(const Figure& figure) {
  for (const FigureSeries& series : figure.series) {
    const std::size_t n = series.x.size();
    const bool bars = !series.low.empty() || !series.high.empty();
    if (series.y.size() != n || (bars && (series.low.size() != n || series.high.size() != n))) {
      throw FormatError("figure \"" + figure.title + "\", series \"" + series.name +
                        "\": x, y and intervals differ in length");
    }
  }
}

void require_full_rows(const Table& table) {
  for (const std::vector<std::string>& row : table.rows) {
    if (row.size() != table.columns.size()) {
      throw FormatError("table \"" + table.title + "\": a row is not as long as the columns");
    }
  }
}

void require_expected_causes(const CausesRecord& record) {
  for (const JudgedTwin& twin : record.twins) {
    if (twin.name.empty()) {
      throw FormatError("causes of the set \"" + record.set + "\": a twin has no name");
    }
    if (twin.expected.empty()) throw FormatError("twin \"" + twin.name + "\" expects no cause");
  }
}

void require_pairs(const DuetRecord& record) {
  if (record.a_seconds.size() != record.b_seconds.size()) {
    throw FormatError("duet of \"" + record.part + "\": the sides have not as many times");
  }
}

}  // namespace

std::string to_json(const verify::CheckResult& result) {
  return detail::document(detail::kCheckFormat, result);
}

verify::CheckResult parse_check(std::string_view json) {
  return detail::parse_document<verify::CheckResult>(detail::kCheckFormat, json);
}

std::string to_json(const RunEnvironment& environment) {
  return detail::document(detail::kEnvironmentFormat, environment);
}

RunEnvironment parse_environment(std::string_view json) {
  return detail::parse_document<RunEnvironment>(detail::kEnvironmentFormat, json);
}

std::string to_json(const RenderRecord& record) {
  return detail::document(detail::kRenderFormat, record);
}

RenderRecord parse_render_record(std::string_view json) {
  return detail::parse_document<RenderRecord>(detail::kRenderFormat, json);
}

std::string to_json(const SpeedPoint& point) {
  return detail::document(detail::kSpeedFormat, point);
}

SpeedPoint parse_speed_point(std::string_view json) {
  return detail::parse_document<SpeedPoint>(detail::kSpeedFormat, json);
}

std::string to_json(const RayCost& cost) { return detail::document(detail::kRayCostFormat, cost); }

RayCost parse_ray_cost(std::string_view json) {
  return detail::parse_document<RayCost>(detail::kRayCostFormat, json);
}

std::string to_json(const Bar& bar) { return detail::document(detail::kBarFormat, bar); }

Bar parse_bar(std::string_view json) {
  return detail::parse_document<Bar>(detail::kBarFormat, json);
}

std::string_view verdict(const Bar& bar) {
  if (bar.indicative) return "indicative";
  if (!(bar.low <= bar.measured && bar.measured <= bar.high)) return "open";
  if (bar.at_least ? bar.low >= bar.limit : bar.high <= bar.limit) return "met";
  const bool missed = bar.at_least ? bar.high < bar.limit : bar.low > bar.limit;
  return missed ? "missed" : "open";
}

std::string to_json(const StabilityRecord& record) {
  return detail::document(detail::kStabilityFormat, record);
}

StabilityRecord parse_stability_record(std::string_view json) {
  return detail::parse_document<StabilityRecord>(detail::kStabilityFormat, json);
}

std::string to_json(const CausesRecord& record) {
  require_expected_causes(record);
  return detail::document(detail::kCausesFormat, record);
}

CausesRecord parse_causes_record(std::string_view json) {
  CausesRecord record = detail::parse_document<CausesRecord>(detail::kCausesFormat, json);
  require_expected_causes(record);
  return record;
}

std::string to_json(const DuetRecord& record) {
  require_pairs(record);
  return detail::document(detail::kDuetFormat, record);
}

DuetRecord parse_duet_record(std::string_view json) {
  DuetRecord record = detail::parse_document<DuetRecord>(detail::kDuetFormat, json);
  require_pairs(record);
  return record;
}

std::string_view verdict(const DuetRecord& record) {
  if (record.a_seconds.empty()) return record.identical_code ? "identical code" : "not timed";
  constexpr double kMost = 1 + kDuetMargin, kLeast = 1 / kMost;
  if (record.low > kMost) return "slower";
  if (record.high < kLeast) return "faster";
  return record.low >= kLeast && record.high <= kMost ? "no change" : "undecided";
}

std::string to_json(const Figure& figure) {
  require_same_lengths(figure);
  return detail::document(detail::kFigureFormat, figure);
}

Figure parse_figure(std::string_view json) {
  Figure figure = detail::parse_document<Figure>(detail::kFigureFormat, json);
  require_same_lengths(figure);
  return figure;
}

std::string to_json(const Table& table) {
  require_full_rows(table);
  return detail::document(detail::kTableFormat, table);
}

Table parse_table(std::string_view json) {
  Table table = detail::parse_document<Table>(detail::kTableFormat, json);
  require_full_rows(table);
  return table;
}

}  // namespace plumbline::reports
