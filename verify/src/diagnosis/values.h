#pragma once

#include <vector>

#include "diagnosis/direct.h"
#include "diagnosis/hypothesis.h"

/// Causes in f and in weights, from the ratio of f both ways and from albedos.
namespace plumbline::verify {

/// Residuals of f(wo, wi)/η_o² over f(wi, wo)/η_i² that an f without the factor leaves.
bool reciprocity_fails(const ReportEvidence& evidence);

/// What makes f(wo, wi) and f(wi, wo) differ: the simplest that explains all pairs.
std::vector<Finding> explain_asymmetry(const ReportEvidence& evidence);

bool energy_fails(const ReportEvidence& evidence);

/// What makes albedos differ from the known ones, or exceed 1.
std::vector<Finding> explain_energy(const ReportEvidence& evidence);

/// Whether a factor X(wo, wi) missing from f leaves f as asymmetric as it was seen to be.
///
/// @param prediction  X times the base of a place
bool explains_reciprocity(const ReportEvidence& evidence, const Prediction& prediction,
                          std::span<const double> numbers);

}  // namespace plumbline::verify
