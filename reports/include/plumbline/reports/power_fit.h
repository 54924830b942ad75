#pragma once

#include <span>

namespace plumbline::reports {

/// y = factor · x^exponent, fitted in log–log space.
struct PowerFit {
  double factor = 0;
  double exponent = 0;
  double exponent_error = 0;  ///< standard error of the exponent; NaN where nothing gives a scale
  int points = 0;             ///< used
};

/// One measured point with the standard error of log(y): 0 where it is unknown.
struct PowerFitPoint {
  double x = 0, y = 0, log_y_error = 0;
};

/// Weighted least squares line through (log x, log y), weights 1/log_y_error². Where an error is
/// unknown all points weigh the same, and the scatter about the line sets the standard error.
/// Points that are not finite and > 0 are left out; fewer than two distinct x give NaN.
///
/// @source Bevington & Robinson 2003, chapter 6 (least-squares fit to a straight line)
PowerFit fit_power(std::span<const PowerFitPoint> points);

}  // namespace plumbline::reports
