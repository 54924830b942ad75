#pragma once

#include <plumbline/calibration/samplers.h>

/// The estimators that the calibration is made with serve the tests of single checks too.
namespace plumbline::tests {

using calibration::Bernoulli;
using calibration::Exponential;
using calibration::Lognormal;
using calibration::Pareto;
using calibration::sampler;

}  // namespace plumbline::tests
