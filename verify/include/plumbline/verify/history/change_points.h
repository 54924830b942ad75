#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace plumbline::verify::history {

/// How change points are looked for.
struct ChangePointOptions {
  std::size_t window = 50;      ///< values looked at together, ≥ 2; windows overlap by half
  double max_p_value = 0.001;   ///< of Student's t between neighbouring segments, in (0, 1)
  double min_magnitude = 0;     ///< smallest relative change of the mean that is kept
  std::size_t min_segment = 1;  ///< values on each side of a split, ≥ 1
  double variance_inflation = 1;  ///< of a mean, by correlation of neighbours: (1 + φ)/(1 − φ); ≥ 1

  /// Gives what Apache Otava gives: variances of segments without Bessel's correction, and of the
  /// points beside a dropped one only the later is tested again.
  bool as_otava = false;
};

/// A place from which on a series has another mean.
struct ChangePoint {
  std::size_t index = 0;                   ///< first value of the new segment
  std::size_t segment_begin = 0;           ///< first value of the segment before
  std::size_t segment_end = 0;             ///< one past the last value of the segment after
  double mean_before = 0, mean_after = 0;  ///< of the two segments
  double error = 0;                        ///< standard error of mean_after − mean_before
  double p_value = 1;                      ///< of equal means; after a search no error rate

  /// The larger of the relative changes there and back; 0 where a mean is 0.
  double magnitude() const;
};

/// Change points of a series, in its order: E-divisive means, with Student's t-test for the
/// significance of a split.
///
/// Each window is split where the energy distance between both sides is largest, as long as the
/// t-test of the sides gives at most ten times max_p_value (twice from 0.05 on), then its parts;
/// of the union of all windows' points the least significant is dropped until all are below
/// max_p_value, then the smallest until all are above min_magnitude.
///
/// A p-value after a search over all splits is no error rate: `judge_history` says what is.
///
/// @param series  finite
/// @throws std::invalid_argument for options out of their ranges or values that are not finite
/// @source Matteson, James 2014 (JASA 109:505), Eqs. 5 and 7 with α = 1 · Fleming et al. 2023
///         (ICPE), "Hunter", Section 3
std::vector<ChangePoint> find_change_points(std::span<const double> series,
                                            const ChangePointOptions& options);

}  // namespace plumbline::verify::history
