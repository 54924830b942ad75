#pragma once

#include <span>
#include <vector>

/// Averages that a few wild values do not move, and their errors.
namespace plumbline::verify::history {

/// Median; of an even number the mean of the two in the middle.
///
/// @param values  at least one, finite
double median(std::vector<double> values);

/// Mean of what is left without the g smallest and g largest values, g a fifth of them rounded
/// down.
struct TrimmedMean {
  double mean = 0;
  double error = 0;    ///< its standard error, from the winsorised variance
  double degrees = 0;  ///< of freedom, of Student's t for (mean − truth)/error
};

/// @param values  at least five, finite; independent, or batches that are nearly so
/// @source Tukey, McLaughlin 1963 (Sankhyā A 25:3), Section 4
TrimmedMean trimmed_mean(std::vector<double> values);

}  // namespace plumbline::verify::history
