#pragma once

#include <span>

namespace plumbline::verify::history {

/// Times of one pair of runs that shared a slot of the machine: side by side, or one right after
/// the other.
struct DuetPair {
  double a_seconds = 0, b_seconds = 0;  ///< both positive and finite
};

/// How much slower b is than a, with its interval.
struct DuetRatio {
  double ratio = 1;          ///< b/a, of the typical pair
  double low = 1;            ///< interval of the ratio, at `confidence`
  double high = 1;           ///< its other end
  double confidence = 0;     ///< two-sided, of the interval
  double log_error = 0;      ///< standard error of log(ratio)
  int pairs = 0;             ///< that entered: an even number
  double cost_of_first = 1;  ///< a run's time as first of its pair over that as second, if a began
};

/// The ratio of two programs' times from pairs that took turns in going first: b/a with an
/// interval.
///
/// What disturbs both runs of a pair cancels in its logarithmic ratio; what being first costs
/// cancels in the mean of two neighbouring pairs (even pairs start with a, odd ones with b; it does
/// not matter to the ratio which of the two is called a). Those means are put into at most 20
/// batches of neighbours, so that what drifts over several pairs is seen in the scatter of the
/// batches. Each batch gives its median, and the interval is Student's on the trimmed mean of the
/// batches (a fifth off each end): a fifth of the batches may be spoiled, however badly.
///
/// @param pairs       in the order in which they ran, at least 16; of an odd number the last is
///                    left out
/// @param confidence  two-sided, in (0, 1)
/// @throws std::invalid_argument for fewer pairs, times that are not positive and finite, or a
///         confidence outside (0, 1)
/// @source Bulej, Horký, Tůma, Farquet, Prokopec 2020 (ICPE), "Duet Benchmarking" · Tukey,
///         McLaughlin 1963 (Sankhyā A 25:3), trimmed mean with the winsorised variance
DuetRatio duet_ratio(std::span<const DuetPair> pairs, double confidence = 0.99);

/// What a duet says of "b takes at least (1 + x) times as long as a".
enum class DuetVerdict {
  slower,      ///< it does: the whole interval lies above 1 + x
  not_slower,  ///< it does not: the whole interval lies at or below 1 + x
  undecided    ///< the interval holds 1 + x: more pairs are needed
};

/// Judges "slower by at least x". With x = 0 any slowdown is asked for, and b = a is called slower
/// in half of (1 − confidence) of all duets.
///
/// @param slowdown  x, a share of a's time: 0.02 is 2 %; > −1
/// @throws std::invalid_argument for a slowdown that is not finite and above −1
DuetVerdict judge_duet(const DuetRatio& duet, double slowdown);

}  // namespace plumbline::verify::history
