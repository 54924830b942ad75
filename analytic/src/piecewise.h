#pragma once

#include <functional>
#include <vector>

namespace plumbline::analytic {

struct Quadrature {
  double value = 0;
  double error = 0;  ///< estimated, absolute
};

/// ∫ f over [a, b], for a function that is smooth inside, by adaptive Gauss–Kronrod.
///
/// @param noise  error that need not be undercut: what rounding in f leaves anyway
Quadrature integrate_smooth(const std::function<double(double)>& f, double a, double b,
                            double noise = 0);

/// ∫ f from the first to the last of the sorted `cuts`, piece by piece: f is smooth between them.
Quadrature integrate_pieces(const std::function<double(double)>& f, const std::vector<double>& cuts,
                            double noise = 0);

/// Sorted, without duplicates, and only what lies in [low, high]; `low` and `high` included.
std::vector<double> make_cuts(double low, double high, const std::vector<double>& inner);

}  // namespace plumbline::analytic
