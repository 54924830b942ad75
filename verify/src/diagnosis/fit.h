#pragma once

#include <vector>

#include "diagnosis/observations.h"

namespace plumbline::verify {

/// Free numbers of a prediction by least squares on every other point (Levenberg and Marquardt),
/// from the best of the starts.
///
/// @param view  fitted to this view alone; −1: to all
std::vector<double> fit_parameters(const Observations& observations, const Prediction& prediction,
                                   const std::vector<std::vector<double>>& starts, int view);

/// Solves a small symmetric positive definite system. What is singular gets 0 there.
std::vector<double> solve_definite(std::vector<std::vector<double>> a, std::vector<double> b);

}  // namespace plumbline::verify
