#include <plumbline/reports/history_report.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <plumbline/verify/history/regressions.h>

#include "history_sequences.h"

namespace plumbline::reports {
namespace {

namespace over_nights = verify::history;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// The places of runs on the axis.
using Axis = std::map<std::int64_t, std::size_t>;

/// Of sorted values, linear between them.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

TrackedNumber empty_number(std::string name, std::string unit, std::size_t nights) {
  TrackedNumber number;
  number.name = std::move(name);
  number.unit = std::move(unit);
  number.median.resize(nights, kMissing);
  number.low = number.high = number.median;
  return number;
}

HistoryChange record_of(const over_nights::Change& change) {
  HistoryChange record;
  record.drift = change.shape == over_nights::ChangeShape::drift;
  record.regression = change.regression;
  record.first_night = change.first_night;
  record.last_night = change.last_night;
  record.commit_before = change.commit_before;
  record.commit_first = change.commit_first;
  record.commit_last = change.commit_last;
  record.before = change.before;
  record.after = change.after;
  record.relative = change.relative;
  record.low = change.low;
  record.high = change.high;
  record.means_p_value = change.means_p_value;
  record.distribution_p_value = change.distribution_p_value;
  return record;
}

/// Fills in what a night shows, and what all of them do.
void judge(TrackedNumber& number, const over_nights::Series& series,
           const over_nights::HistoryOptions& options) {
  for (std::size_t night = 0; night < series.nights.size(); ++night) {
    std::vector<double> values = series.nights[night].values;
    if (values.empty()) continue;
    std::sort(values.begin(), values.end());
    number.median[night] = quantile(values, 0.5);
    number.low[night] = quantile(values, 0.25);
    number.high[night] = quantile(values, 0.75);
  }
  const over_nights::HistoryJudgement judgement = over_nights::judge_history(series, options);
  for (const over_nights::Change& change : judgement.changes) {
    number.changes.push_back(record_of(change));
  }
  number.odd_nights.assign(judgement.odd_nights.begin(), judgement.odd_nights.end());
}

over_nights::Series empty_series(const std::string& name, const std::vector<HistoryRun>& runs) {
  over_nights::Series series;
  series.name = name;
  for (const HistoryRun& run : runs) series.nights.push_back({run.environment.commit, {}});
  return series;
}

std::vector<TrackedNumber> track_distributions(const History& history, const RunFilter& filter,
                                               const std::vector<HistoryRun>& runs,
                                               const Axis& axis) {
  const std::vector<DistributionSeries> all = history.distribution_series(filter);
  over_nights::HistoryOptions options;
  options.tracked_numbers = std::max(1, static_cast<int>(all.size()));
  std::vector<TrackedNumber> numbers;
  for (const DistributionSeries& measured : all) {
    over_nights::Series series = empty_series(measured.name, runs);
    series.better =
        measured.lower_is_better ? over_nights::Better::lower : over_nights::Better::higher;
    for (const DistributionSeries::Run& run : measured.runs) {
      for (const double value : run.values) {
        // Times are judged by their logarithms; a clock that stood still has measured nothing.
        if (!(value > 0 && std::isfinite(value))) continue;
        series.nights[axis.at(run.id)].values.push_back(value);
      }
    }
    TrackedNumber number = empty_number(measured.name, measured.unit, runs.size());
    number.lower_is_better = measured.lower_is_better;
    judge(number, series, options);
    numbers.push_back(std::move(number));
  }
  return numbers;
}

std::vector<TrackedNumber> track_counters(const History& history, const RunFilter& filter,
                                          const std::vector<HistoryRun>& runs, const Axis& axis) {
  std::vector<TrackedNumber> numbers;
  for (const CounterSeries& counted : history.counter_series(filter)) {
    over_nights::Series series = empty_series(counted.name, runs);
    series.kind = over_nights::NumberKind::counter;
    for (const CounterSeries::Run& run : counted.runs) {
      series.nights[axis.at(run.id)].values = {static_cast<double>(run.value)};
    }
    TrackedNumber number = empty_number(counted.name, counted.unit, runs.size());
    number.counter = true;
    judge(number, series, {});
    numbers.push_back(std::move(number));
  }
  return numbers;
}

HistoryNight night_of(const History& history, const HistoryRun& run) {
  HistoryNight night;
  night.run = static_cast<std::uint64_t>(run.id);
  night.time = run.environment.time;
  night.commit = run.environment.commit;
  night.dirty = run.environment.dirty;
  night.sources = run.sources;
  const CheckCounts counts = history.count_checks(run.id);
  night.checks = counts.checks;
  night.unexpected = counts.unexpected;
  night.parts = run.parts;
  for (const HistoryPart& part : run.parts) {
    if (part.status == PartStatus::skipped) {
      ++night.skipped_parts;
    } else if (part.status != PartStatus::passed) {
      ++night.failed_parts;
    }
  }
  night.gate_runs = run.seed_runs.size();
  for (const SeedRun& seed_run : run.seed_runs) {
    if (!seed_run.failures.empty()) ++night.failing_gate_runs;
  }
  return night;
}

}  // namespace

HistoryRecord judge_runs(const History& history, const std::string& machine,
                         const std::string& kind) {
  const RunFilter filter{kind, machine};
  const std::vector<HistoryRun> runs = history.runs(filter);
  HistoryRecord record;
  record.machine = machine;
  record.kind = kind;
  Axis axis;
  for (const HistoryRun& run : runs) {
    axis.emplace(run.id, axis.size());
    record.nights.push_back(night_of(history, run));
    for (const SeedRun& seed_run : run.seed_runs) {
      if (!seed_run.failures.empty()) record.failing_gate_runs.push_back(seed_run);
    }
  }
  record.numbers = track_distributions(history, filter, runs, axis);
  for (TrackedNumber& counter : track_counters(history, filter, runs, axis)) {
    record.numbers.push_back(std::move(counter));
  }
  record.sequences = detail::follow_checks(history, runs);
  return record;
}

}  // namespace plumbline::reports
