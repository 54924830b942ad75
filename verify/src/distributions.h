#pragma once

/// The few distribution functions that the checks use, so that Boost.Math is compiled once.
namespace plumbline::verify {

/// P(Z > z), standard normal. Accurate in the far tail.
double normal_tail(double z);

/// z with P(Z > z) = level, for level in (0, 1).
double normal_quantile(double level);

/// t with P(T > t) = level, Student's t with `degrees` degrees of freedom.
double student_quantile(double level, double degrees);

/// P(|T| > |t|).
double student_two_sided(double t, double degrees);

/// P(X > x), chi-square with `degrees` degrees of freedom.
double chi_square_tail(double x, double degrees);

/// x with P(X > x) = level.
double chi_square_quantile(double level, double degrees);

/// x with P(X < x) = probability, beta distribution.
double beta_quantile(double probability, double a, double b);

/// P(X >= hits), binomial.
double binomial_at_least(double hits, double trials, double probability);

/// Probability, of both sides, to be as far from its mean as `hits` is: twice the smaller tail of
/// the binomial distribution, at most 1. Exact where little is expected.
double binomial_two_sided(double hits, double trials, double probability);

/// P(X > x) for Pearson's statistic of counts that are Poisson-distributed: its variance is
/// 2 degrees + Σ 1/expected, which a scaled chi-square distribution takes up.
///
/// @source Satterthwaite 1946 (Biometrics Bulletin 2:6)
double pearson_tail(double x, double degrees, double sum_of_inverse_expected);

/// Upper confidence limit of the noncentrality of a chi-square variable seen at x: the λ for which
/// P(X ≤ x | λ) = level; 0 where even λ = 0 makes x improbably small.
double noncentrality_limit(double x, double degrees, double level);

}  // namespace plumbline::verify
