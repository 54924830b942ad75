#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <plumbline/verify/budget.h>
#include <plumbline/verify/result.h>
#include <plumbline/verify/sampling_pair.h>

namespace plumbline::verify {

/// How hard a sampling pair is looked at.
struct ContractOptions {
  std::uint64_t seed = 1;
  ErrorBudget budget;

  // Deterministic checks.
  int points = 10'000;          ///< of the pointwise checks
  int jacobian_points = 2'000;  ///< at most

  /// |∫pdf + atoms + rejected − 1| that a pass allows. What rounding of the points may do to the
  /// pdf is measured and added: nothing to speak of in double, 1e-3 for a lobe as narrow as float
  /// resolves.
  double mass_tolerance = 5e-5;

  // Chi-square.
  std::uint64_t first_look = 100'000;
  std::uint64_t samples = 1'000'000;  ///< at the last look
  int finest_bins = 4096;             ///< of about equal expected mass; coarser levels are merged

  /// A pass proves that the relative deviation of the samples' density from the pdf, root mean
  /// square over the 64 bins of the coarsest level, is at most this.
  double deviation = 0.0125;
};

/// The whole battery on one sampling pair: record and weight pointwise, support, Jacobian,
/// integral, chi-square. Results are named pair/check; a check that the pair has no ground for is
/// left out, one that it asks to skip says so (inconclusive, as expected).
///
/// On failure the results carry a diagnosis: the observed/expected ratio is fitted against the
/// usual suspects and the best is named with how well it fits, or none where none fits.
std::vector<CheckResult> check_pair(const SamplingPair& pair, const ContractOptions& options = {});

/// pdf · |∂x/∂u| = 1 by extrapolated differences, lobe by lobe. Points at a fold or seam of the
/// map, where differences do not converge, are counted and left out. A pass bounds the relative
/// error by 1e-4 for code in double and by 5e-3 for code in float, whose rounding differences
/// magnify.
///
/// @source Ridders 1982 (Adv. Eng. Software 4:2)
CheckResult check_jacobian(const SamplingPair& pair, const ContractOptions& options = {});

/// The density that the record states equals `pdf`; weight · pdf equals `value`; the density is
/// finite, not negative, and positive wherever the value is; points lie in the domain, also at the
/// corners of the unit square. What rounding of the point itself may change is allowed for.
std::vector<CheckResult> check_pointwise(const SamplingPair& pair,
                                         const ContractOptions& options = {});

/// ∫pdf + atoms + rejected share = 1, by adaptive cubature seeded from samples, with its error.
CheckResult check_integral(const SamplingPair& pair, const ContractOptions& options = {});

/// Chi-square test of samples against the integral of their density over bins that follow it.
///
/// The domain is halved at medians of pilot samples until each bin holds about the same mass, and
/// the density is integrated over each bin by adaptive cubature with an error estimate. Bins are
/// tested coarse to fine under one level, at growing sample counts. Pooled bins keep what is left
/// over; a bin where the pdf is 0 fails on its first sample, as does any sample where the pdf is 0;
/// rejected samples and atoms are categories of their own.
///
/// `fail` at the level of the error budget; `pass` if the deviation is proven below `deviation` and
/// the masses add up; else `inconclusive`, also where the cubature cannot certify its error.
CheckResult check_chi_square(const SamplingPair& pair, const ContractOptions& options = {});

}  // namespace plumbline::verify
