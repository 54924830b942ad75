#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <plumbline/verify/history/change_points.h>
#include <plumbline/verify/history/distribution_shift.h>
#include <plumbline/verify/history/regressions.h>

#include "distributions.h"
#include "history/nights.h"
#include "history/ramp.h"

namespace plumbline::verify::history {

namespace {

constexpr std::size_t kFewestNights = 10;
// A step is placed by three nights and counts with five: bad stretches of a machine are shorter.
constexpr std::size_t kFewestToPlace = 3;
constexpr std::size_t kFewestAtALevel = 5;
constexpr std::size_t kWindow = 60;
// Of the second detector: its nights on each side, its level and its permutations.
constexpr std::size_t kNightsCompared = 20;
constexpr double kDistributionLevel = 0.01;
constexpr int kPermutations = 999;
constexpr std::size_t kShortestDrift = 5;
// Of Schwarz's criterion: strong evidence by Kass, Raftery 1995 (JASA 90:430), Section 3.2.
constexpr double kDriftIsBetter = 6;
// How many times its level a year of looks may give a false alarm: measured, with a margin
// (docs/statistics.md, "Over nights").
constexpr double kLooks = 2000;

double inflation(const HistoryOptions& options) {
  return (1 + options.night_correlation) / (1 - options.night_correlation);
}

void check_history_options(const HistoryOptions& o) {
  if (o.tracked_numbers < 1 || !(o.false_alarms_per_year > 0) ||
      !(o.night_correlation >= 0 && o.night_correlation < 1) || !(o.smallest_change >= 0) ||
      !(o.confidence > 0 && o.confidence < 1)) {
    throw std::invalid_argument(
        "history: needs a tracked number, a positive rate of false alarms, a correlation in [0, 1),"
        " a smallest change of at least 0 and a confidence in (0, 1)");
  }
}

/// A point that both detectors found.
struct Agreed {
  ChangePoint point;
  double distribution_p_value = 1;
};

std::optional<Agreed> agree(const Series& series, const KeptNights& kept, const ChangePoint& point,
                            std::uint64_t seed) {
  const auto nights = [&](std::size_t begin, std::size_t end) {
    std::vector<std::vector<double>> result;
    for (std::size_t i = begin; i < end; ++i) result.push_back(series.nights[kept.index[i]].values);
    return result;
  };
  const std::size_t k = point.index;
  const std::size_t begin = std::max(point.segment_begin, k - std::min(k, kNightsCompared));
  const std::size_t end = std::min(point.segment_end, k + kNightsCompared);
  const DistributionShift shift =
      distribution_shift(nights(begin, k), nights(k, end), kPermutations, seed);
  const bool same_side = (shift.larger > 0.5) == (point.mean_after > point.mean_before);
  if (!same_side || shift.p_value > kDistributionLevel) return std::nullopt;
  return Agreed{point, shift.p_value};
}

std::vector<Agreed> agreed_points(const Series& series, const KeptNights& kept,
                                  const HistoryOptions& options) {
  if (kept.level.size() < kFewestNights) return {};
  ChangePointOptions search;
  search.window = kWindow;
  search.max_p_value = change_level(options);
  search.min_segment = kFewestToPlace;
  search.variance_inflation = inflation(options);
  std::vector<Agreed> result;
  for (const ChangePoint& point : find_change_points(kept.level, search)) {
    if (const auto agreed = agree(series, kept, point, options.seed)) result.push_back(*agreed);
  }
  return result;
}

/// Neighbouring points that go the same way, with the stretch of levels around them.
struct Way {
  std::vector<Agreed> points;
  std::size_t begin = 0, end = 0;
};

std::vector<Way> ways_up_and_down(const std::vector<Agreed>& points) {
  const auto rises = [](const Agreed& a) { return a.point.mean_after > a.point.mean_before; };
  std::vector<Way> result;
  for (const Agreed& next : points) {
    const bool goes_on = !result.empty() && result.back().end >= next.point.index &&
                         rises(result.back().points.back()) == rises(next);
    if (!goes_on) result.push_back({{}, next.point.segment_begin, 0});
    result.back().points.push_back(next);
    result.back().end = next.point.segment_end;
  }
  return result;
}

/// Whether the levels on both sides have lasted.
bool lasts(const Way& way) {
  return way.points.front().point.index - way.begin >= kFewestAtALevel &&
         way.end - way.points.back().point.index >= kFewestAtALevel;
}

/// Squared deviations from the levels between the points of a way.
double squares_of_steps(const std::vector<double>& levels, const Way& way) {
  double result = 0;
  std::size_t begin = way.begin;
  for (std::size_t k = 0; k <= way.points.size(); ++k) {
    const std::size_t end = k < way.points.size() ? way.points[k].point.index : way.end;
    double mean = 0;
    for (std::size_t i = begin; i < end; ++i) mean += levels[i] / static_cast<double>(end - begin);
    for (std::size_t i = begin; i < end; ++i) result += (levels[i] - mean) * (levels[i] - mean);
    begin = end;
  }
  return result;
}

/// The ramp that explains a way better than its steps do, if there is one.
std::optional<Ramp> drift_of(const std::vector<double>& levels, const Way& way, double inflated) {
  const std::span<const double> part = std::span(levels).subspan(way.begin, way.end - way.begin);
  if (part.size() <= kShortestDrift) return std::nullopt;
  Ramp ramp = best_ramp(part, kShortestDrift);
  const double steps = static_cast<double>(way.points.size());
  // Schwarz's criterion, of as many nights as the correlated ones are worth: steps have a place and
  // a level each, and one level more; a ramp has two ends and two levels.
  const double n = static_cast<double>(part.size()) / inflated;
  const double better = n * std::log(squares_of_steps(levels, way) / ramp.squares) +
                        (2 * steps + 1 - 4) * std::log(n);
  if (!(better > kDriftIsBetter)) return std::nullopt;
  ramp.last_before += way.begin;
  ramp.first_after += way.begin;
  return ramp;
}

/// Sizes from levels that are logarithms.
void set_log_sizes(const Series& series, const HistoryOptions& options, double before, double after,
                   double error, double degrees, Change& change) {
  const double quantile = student_quantile((1 - options.confidence) / 2, std::max(1.0, degrees));
  set_sizes(series, std::exp(before), std::exp(after), change);
  change.low = std::expm1(after - before - quantile * error);
  change.high = std::expm1(after - before + quantile * error);
}

Change drift(const Series& series, const KeptNights& kept, const Way& way, const Ramp& ramp,
             const HistoryOptions& options) {
  Change change = change_between(series, kept.index[ramp.last_before],
                                 kept.index[ramp.last_before + 1], kept.index[ramp.first_after]);
  change.shape = ChangeShape::drift;
  const double degrees = static_cast<double>(way.end - way.begin) / inflation(options) - 4;
  set_log_sizes(series, options, ramp.before, ramp.after,
                ramp.error * std::sqrt(inflation(options)), degrees, change);
  const auto strongest = std::min_element(
      way.points.begin(), way.points.end(),
      [](const Agreed& a, const Agreed& b) { return a.point.p_value < b.point.p_value; });
  change.means_p_value = strongest->point.p_value;
  change.distribution_p_value = strongest->distribution_p_value;
  return change;
}

Change step(const Series& series, const KeptNights& kept, const Agreed& agreed,
            const HistoryOptions& options) {
  const ChangePoint& p = agreed.point;
  Change change =
      change_between(series, kept.index[p.index - 1], kept.index[p.index], kept.index[p.index]);
  const double degrees =
      static_cast<double>(p.segment_end - p.segment_begin - 2) / inflation(options);
  set_log_sizes(series, options, p.mean_before, p.mean_after, p.error, degrees, change);
  change.means_p_value = p.p_value;
  change.distribution_p_value = agreed.distribution_p_value;
  return change;
}

std::vector<Change> measured_changes(const Series& series, const KeptNights& kept,
                                     const HistoryOptions& options) {
  std::vector<Change> result;
  for (const Way& way : ways_up_and_down(agreed_points(series, kept, options))) {
    if (!lasts(way)) continue;
    if (const std::optional<Ramp> ramp = drift_of(kept.level, way, inflation(options))) {
      result.push_back(drift(series, kept, way, *ramp, options));
      continue;
    }
    for (const Agreed& agreed : way.points) result.push_back(step(series, kept, agreed, options));
  }
  return result;
}

}  // namespace

double change_level(const HistoryOptions& options) {
  check_history_options(options);
  return std::min(0.01, options.false_alarms_per_year / options.tracked_numbers / kLooks);
}

HistoryJudgement judge_history(const Series& series, const HistoryOptions& options) {
  check_history_options(options);
  HistoryJudgement result;
  if (series.kind == NumberKind::counter) {
    result.changes = counter_changes(series);
  } else {
    KeptNights kept = keep_nights(series);
    result.changes = measured_changes(series, kept, options);
    result.odd_nights = std::move(kept.odd);
  }
  std::erase_if(result.changes, [&](const Change& change) {
    return std::abs(change.relative) < options.smallest_change;
  });
  result.nights = static_cast<std::size_t>(
      std::count_if(series.nights.begin(), series.nights.end(),
                    [](const Night& night) { return !night.values.empty(); }));
  return result;
}

}  // namespace plumbline::verify::history
