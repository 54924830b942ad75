#pragma once

#include <vector>

#include <plumbline/analytic/estimator_moments.h>

namespace plumbline::analytic {

/// Where the weights of a rule jump: for `maximum` the crossings of two densities q = factor·p, for
/// `cutoff` where one falls to the cutoff fraction of another. Empty for the smooth rules.
std::vector<double> weight_breaks(const Integral1d& integral, const WeightRule& rule,
                                  const std::vector<double>& factors);

}  // namespace plumbline::analytic
