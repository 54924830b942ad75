#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace plumbline::verify::history {

/// What one night measured of one number.
struct Night {
  std::string commit;          ///< that was measured
  std::vector<double> values;  ///< in units of the number; may depend on each other; empty: missing
};

/// Which way is good.
enum class Better { lower, higher };

/// Whether a number is the same every time (rays, samples to decide, bytes, instructions) or has
/// noise (times).
enum class NumberKind { counter, measured };

/// One tracked number over the nights, the oldest first.
struct Series {
  std::string name;
  NumberKind kind = NumberKind::measured;
  Better better = Better::lower;
  std::vector<Night> nights;
};

/// How often a history may be wrong, and what it expects of its nights.
struct HistoryOptions {
  int tracked_numbers = 100;         ///< that are judged every night, of kind `measured`; ≥ 1
  double false_alarms_per_year = 1;  ///< of all of them together, judged each of 365 nights
  double night_correlation = 0.3;    ///< of neighbouring nights, in [0, 1)
  double smallest_change = 0;        ///< relative; smaller ones are not reported
  double confidence = 0.95;          ///< of the interval of a size, two-sided
  std::uint64_t seed = 1;            ///< of the permutations of the second detector
};

/// How a number moved.
enum class ChangeShape {
  step,  ///< between two nights
  drift  ///< over five nights or more
};

/// A change that both detectors found, or a counter that is another.
struct Change {
  ChangeShape shape = ChangeShape::step;
  bool regression = false;      ///< else an improvement
  std::size_t first_night = 0;  ///< at the new level; of a drift the first that moved
  std::size_t last_night = 0;   ///< of a drift the first at the new level; of a step the same night
  std::string commit_before;    ///< the last one measured before: not the cause
  std::string commit_first;     ///< that of first_night: the cause lies after commit_before, up to
  std::string commit_last;      ///< this: that of last_night
  double before = 0, after = 0;  ///< mean level of best values on each side, in units of the number
  double relative = 0;           ///< after/before − 1
  double low = 0, high = 0;      ///< its interval; of a counter the value itself
  double means_p_value = 0;      ///< first detector: E-divisive means with Student's t; counter: 0
  double distribution_p_value = 0;  ///< second: energy distance of nights; counter: 0
};

/// What a series shows.
struct HistoryJudgement {
  std::vector<Change> changes;          ///< by their first nights
  std::vector<std::size_t> odd_nights;  ///< left out: far from their neighbours on both sides
  std::size_t nights = 0;               ///< measured
};

/// The p-value of the first detector below which a change counts: calibrated so that all tracked
/// numbers together give the stated false alarms in a year (docs/statistics.md, "Over nights").
///
/// @throws std::invalid_argument for options out of their ranges
double change_level(const HistoryOptions& options);

/// The changes in the history of one number.
///
/// A counter changes with the first night that counts otherwise; it needs one night.
///
/// A measured number is judged by each night's best value, as a logarithm: what disturbs a machine
/// makes programs slower, never faster. Nights that lie far from their neighbours on both sides
/// (six robust standard deviations from the median of five) are left out, and a change takes five
/// nights: fewer bad ones are none. E-divisive means with Student's t propose changes, with the
/// errors that correlated nights have, at `change_level`; one is reported where the distributions
/// of up to twenty nights on each side differ too (energy distance, whole nights permuted, p ≤
/// 0.01), to the same side. Less than ten nights show nothing. Where several steps, or one, fit
/// worse than a ramp over five nights or more (BIC), it is one drift.
///
/// To keep the stated rate, all of a number's nights are given each time, or always those from the
/// same night on; what has been reported before is reported again.
///
/// @throws std::invalid_argument for options out of their ranges, a measured value that is not
///         positive and finite, or a counter that is not finite or not the same all night
HistoryJudgement judge_history(const Series& series, const HistoryOptions& options = {});

}  // namespace plumbline::verify::history
