#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <plumbline/analytic/integral1d.h>

/// What every way of combining techniques must give on an integral: mean, variance and fourth
/// moment, by quadrature of the definitions with weights of its own.
namespace plumbline::analytic {

/// Weights q_i^β/Σ q_k^β and their relatives, with q_i = n_i p_i. Written plainly, in double: this
/// is the oracle, not the implementation.
struct WeightRule {
  enum class Kind { balance, power, cutoff, maximum };
  Kind kind = Kind::balance;
  double parameter = 0;  ///< β of power; α of cutoff, the fraction of the largest below which w = 0
};

/// w_i(x) for densities q (each with its count); equal maxima share.
///
/// @source Veach 1997: balance Eq. 9.8, the others Section 9.2.3
double weight(const WeightRule& rule, const std::vector<double>& q, std::size_t i);

/// Of one evaluation F of an estimator: its mean μ and central moments E[(F − μ)^k]. Those above
/// the first are infinite where the variance is.
struct Moments {
  double mean = 0;
  double variance = 0;
  double third = 0;
  double fourth = 0;
  double sixth = 0;
  double variance_error = 0;  ///< quadrature's estimate, absolute
};

/// f(x)/p_i(x), x from p_i. Its mean is the integral over the support of p_i only.
Moments single_moments(const Integral1d& integral, std::size_t i);

/// (1/M) Σ f(x_i)/p_i(x_i): as bad as the worst of them.
Moments naive_average_moments(const Integral1d& integral);

/// Σ f(x_i)/p_i(x_i): M times too large.
Moments plain_sum_moments(const Integral1d& integral);

/// Σ_i (1/n_i) Σ_j w_i(x_ij) f(x_ij)/p_i(x_ij), Veach 1997, Eq. 9.4, with weights that may depend
/// on the counts.
Moments multi_sample_moments(const Integral1d& integral, const WeightRule& rule,
                             const std::vector<int>& counts);

/// w_i(x) f(x)/(c_i p_i(x)), technique i chosen with probability c_i; Veach 1997, Section 9.2.4.
Moments one_sample_moments(const Integral1d& integral, const WeightRule& rule,
                           const std::vector<double>& selection);

/// f(x)/Σ α_k p_k(x), x from that mixture.
Moments mixture_moments(const Integral1d& integral, const std::vector<double>& fractions);

/// Multi-sample estimator for any weights w(i, x) ≥ 0 that sum to 1 wherever f ≠ 0; `breaks` lists
/// where they jump.
Moments weighted_moments(const Integral1d& integral, const std::vector<int>& counts,
                         const std::function<double(std::size_t, double)>& weight_of,
                         const std::vector<double>& breaks);

/// The linear system A α = b behind the optimal weights, technique matrix and contribution vector:
/// a_ik = ∫ p_i p_k/Σ n p, b_i = ∫ f p_i/Σ n p.
///
/// The estimator below has the second moment ∫ (f − Σ α_k p_k)²/Σ n p up to terms in its own means,
/// and this is least where its gradient in α, 2 (A α − b), vanishes.
/// @source Kondapaneni et al. 2019, Section 4
struct OptimalSystem {
  std::vector<std::vector<double>> matrix;
  std::vector<double> vector;
};
OptimalSystem optimal_system(const Integral1d& integral, const std::vector<int>& counts);

/// Estimator Σ α_i + Σ_ij (f − Σ α_k p_k)/Σ n_k p_k: balance with Σ α_k p_k as control variate.
Moments control_variate_moments(const Integral1d& integral, const std::vector<int>& counts,
                                const std::vector<double>& alpha);

/// Mixture fractions that minimise the variance of `mixture_moments`.
///
/// The variance is convex in the fractions; the multiplicative update α_i ← α_i √(∫ f² p_i/p̄²),
/// normalised, decreases it in every step and stops where the integrals agree for all α_i > 0.
std::vector<double> best_fractions(const Integral1d& integral);

}  // namespace plumbline::analytic
