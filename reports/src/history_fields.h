#pragma once

#include <optional>
#include <string_view>

#include <plumbline/reports/history_record.h>

#include "record_fields.h"

/// The fields of a history, in the order in which they are written.
namespace plumbline::reports::detail {

inline constexpr const char* kHistoryFormat = "plumbline.history/1";

template <>
struct EnumWords<PartStatus> {
  static std::string_view word(PartStatus status) { return to_string(status); }
  static std::optional<PartStatus> value(std::string_view word) { return part_status(word); }
};

template <class Visitor, Is<HistoryPart> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("name", r.name);
  visit("status", r.status);
  visit("seconds", r.seconds);
  visit("note", r.note);
}

template <class Visitor, Is<HistoryNight> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("run", r.run);
  visit("time", r.time);
  visit("commit", r.commit);
  visit("dirty", r.dirty);
  visit("sources", r.sources);
  visit("checks", r.checks);
  visit("unexpected", r.unexpected);
  visit("failed_parts", r.failed_parts);
  visit("skipped_parts", r.skipped_parts);
  visit("gate_runs", r.gate_runs);
  visit("failing_gate_runs", r.failing_gate_runs);
  if (visit.wants("parts", !r.parts.empty())) visit("parts", r.parts);
}

template <class Visitor, Is<HistoryChange> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("drift", r.drift);
  visit("regression", r.regression);
  visit("first_night", r.first_night);
  visit("last_night", r.last_night);
  visit("commit_before", r.commit_before);
  visit("commit_first", r.commit_first);
  visit("commit_last", r.commit_last);
  visit("before", r.before);
  visit("after", r.after);
  visit("relative", r.relative);
  visit("low", r.low);
  visit("high", r.high);
  visit("means_p_value", r.means_p_value);
  visit("distribution_p_value", r.distribution_p_value);
}

template <class Visitor, Is<TrackedNumber> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("name", r.name);
  visit("unit", r.unit);
  visit("counter", r.counter);
  visit("lower_is_better", r.lower_is_better);
  visit("median", r.median);
  visit("low", r.low);
  visit("high", r.high);
  visit("changes", r.changes);
  visit("odd_nights", r.odd_nights);
}

template <class Visitor, Is<TrackedSequence> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("check", r.check);
  visit("subject", r.subject);
  visit("verdict", r.verdict);
  visit("nights", r.nights);
  visit("tolerance", r.tolerance);
  visit("bound", r.bound);
  visit("evidence", r.evidence);
  visit("reason", r.reason);
}

template <class Visitor, Is<HistoryRecord> Record>
void visit_fields(Visitor& visit, Record& r) {
  visit("machine", r.machine);
  visit("kind", r.kind);
  visit("nights", r.nights);
  visit("numbers", r.numbers);
  visit("sequences", r.sequences);
  visit("failing_gate_runs", r.failing_gate_runs);
}

}  // namespace plumbline::reports::detail
