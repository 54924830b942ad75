#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include <plumbline/renderer/estimators/estimators.h>

/// Optimal MIS weights: the balance heuristic with a combination of the pdfs as control variate.
///
/// w_i = α_i p_i/f + n_i p_i/Σ n p · (1 − Σ α p/f). They sum to 1, may be negative, and minimise
/// the variance among all weights when α solves A α = b with a_ik = ∫ p_i p_k/Σ n p, b_i = ∫ f
/// p_i/Σ n p. A f that is a combination of the pdfs has zero variance.
///
/// @source Kondapaneni et al. 2019, "Optimal multiple importance sampling" (ACM TOG 38:4), Section
///         4
namespace plumbline::renderer {

/// The technique matrix A and contribution vector b, from quadrature or from samples.
///
/// α must not depend on the samples that it is then used with: the estimate would be biased.
template <class T>
class OptimalSystem {
 public:
  using Vector = std::array<T, kMaxTechniques>;

  /// @param size  M techniques, at most kMaxTechniques
  explicit OptimalSystem(std::size_t size) : size_(size) {}

  T& matrix(std::size_t i, std::size_t k) { return matrix_[i][k]; }
  T& vector(std::size_t i) { return vector_[i]; }

  /// Adds n_i samples of each technique i to an estimate of A and b:
  /// a_ik = E Σ p_i p_k/(Σ n p)², b_i = E Σ f p_i/(Σ n p)².
  template <class P, class Random>
  requires SamplingProblem<P, Random>
  void add_samples(const P& problem, std::span<const T> counts, Random& random) {
    mis_detail::sum_over_samples(
        problem, counts, random, [&](std::size_t, const typename P::Point& x) {
          const mis_detail::DensitiesAt<P> at(problem, counts, x);
          const T mixture = at.mixture();
          const T f = problem.value(x) / mixture;
          for (std::size_t i = 0; i < size_; ++i) {
            const T share = at.pdf(i) / mixture;
            vector_[i] = vector_[i] + f * share;
            for (std::size_t k = 0; k < size_; ++k) {
              matrix_[i][k] = matrix_[i][k] + share * (at.pdf(k) / mixture);
            }
          }
          return T(0);
        });
  }

  /// α of A α = b. The scale of A and b together does not matter, so sums over any number of sample
  /// sets will do.
  ///
  /// A is positive semidefinite, and singular where pdfs depend linearly on each other: Cholesky
  /// with diagonal pivoting stops at the numerical rank and leaves the rest at α = 0, which is a
  /// solution.
  Vector solve() const;

 private:
  std::size_t size_;
  std::array<Vector, kMaxTechniques> matrix_{};
  Vector vector_{};
};

/// Σ α_i + Σ_i Σ_j (f − Σ α_k p_k)/Σ n_k p_k, n_i samples of technique i. Densities only.
///
/// @param counts  n_i ≥ 1, whole numbers
/// @param alpha   any values leave it unbiased, as long as they do not come from these samples
template <class P, class Random>
requires SamplingProblem<P, Random>
typename P::Scalar optimal(const P& problem, std::span<const typename P::Scalar> counts,
                           std::span<const typename P::Scalar> alpha, Random& random) {
  using T = typename P::Scalar;
  T sum = mis_detail::sum_over_samples(
      problem, counts, random, [&](std::size_t, const typename P::Point& x) {
        const mis_detail::DensitiesAt<P> at(problem, counts, x);
        return (problem.value(x) - at.combination(alpha)) / at.mixture();
      });
  for (std::size_t k = 0; k < problem.size(); ++k) sum = sum + alpha[k];
  return sum;
}

template <class T>
typename OptimalSystem<T>::Vector OptimalSystem<T>::solve() const {
  using std::sqrt;
  auto a = matrix_;  // the leading columns become the factor L, row by row in pivot order
  auto b = vector_;
  std::array<std::size_t, kMaxTechniques> order{};
  for (std::size_t i = 0; i < size_; ++i) order[i] = i;
  T first_pivot(0);
  std::size_t rank = 0;
  for (; rank < size_; ++rank) {
    std::size_t best = rank;
    for (std::size_t i = rank + 1; i < size_; ++i) {
      if (a[order[i]][order[i]] > a[order[best]][order[best]]) best = i;
    }
    std::swap(order[rank], order[best]);
    const std::size_t p = order[rank];
    if (rank == 0) first_pivot = a[p][p];
    // Rounding leaves a few ulp of the first pivot where the exact one is 0.
    if (!(a[p][p] > first_pivot * T(1e3) * std::numeric_limits<T>::epsilon())) break;
    const T root = sqrt(a[p][p]);
    b[p] = b[p] / root;
    for (std::size_t i = rank + 1; i < size_; ++i) {
      const std::size_t r = order[i];
      a[r][p] = a[r][p] / root;
      b[r] = b[r] - a[r][p] * b[p];
    }
    for (std::size_t i = rank + 1; i < size_; ++i) {
      for (std::size_t k = rank + 1; k < size_; ++k) {
        a[order[i]][order[k]] = a[order[i]][order[k]] - a[order[i]][p] * a[order[k]][p];
      }
    }
    a[p][p] = root;
  }
  Vector alpha{};
  for (std::size_t i = rank; i-- > 0;) {
    const std::size_t p = order[i];
    T sum = b[p];
    for (std::size_t k = i + 1; k < rank; ++k) sum = sum - a[order[k]][p] * alpha[order[k]];
    alpha[p] = sum / a[p][p];
  }
  return alpha;
}

}  // namespace plumbline::renderer
