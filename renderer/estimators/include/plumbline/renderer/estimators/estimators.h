#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>

#include <plumbline/renderer/estimators/mis_weights.h>

/// Ways to estimate an integral with several sampling techniques, free of any scene.
///
/// Every function draws one estimate; averaging many is the caller's. A sample that a technique
/// fails to produce counts as 0.
namespace plumbline::renderer {

/// An integrand with the techniques that sample it.
///
/// A point on which a technique has an atom has `value` f as a mass (f of the discrete part), and
/// `density` says so.
template <class P, class Random>
concept SamplingProblem = requires(const P& problem, std::size_t i, const typename P::Point& x,
                                   Random& random) {
  { problem.size() } -> std::convertible_to<std::size_t>;    // M ≤ kMaxTechniques
  { problem.value(x) } -> std::same_as<typename P::Scalar>;  // f(x)
  { problem.sample(i, random) } -> std::same_as<std::optional<typename P::Point>>;
  {
    problem.density(i, x)
    } -> std::same_as<TechniqueDensity<typename P::Scalar>>;  // count is ignored
  { random() } -> std::convertible_to<typename P::Scalar>;    // uniform in [0, 1)
};

namespace mis_detail {

/// Densities of all techniques at x, each with its count.
template <class P>
class DensitiesAt {
 public:
  using T = typename P::Scalar;

  DensitiesAt(const P& problem, std::span<const T> counts, const typename P::Point& x)
      : size_(problem.size()) {
    for (std::size_t k = 0; k < size_; ++k) {
      densities_[k] = problem.density(k, x);
      densities_[k].count = counts[k];
    }
  }

  std::span<const TechniqueDensity<T>> span() const { return {densities_.data(), size_}; }
  const T& pdf(std::size_t i) const { return densities_[i].pdf; }

  /// Σ n_k p_k
  T mixture() const {
    T sum(0);
    for (const auto& d : span()) sum = sum + d.count * d.pdf;
    return sum;
  }

  /// Σ α_k p_k
  T combination(std::span<const T> alpha) const {
    T sum(0);
    for (std::size_t k = 0; k < size_; ++k) sum = sum + alpha[k] * densities_[k].pdf;
    return sum;
  }

 private:
  std::array<TechniqueDensity<T>, kMaxTechniques> densities_{};
  std::size_t size_;
};

/// Sum over all samples of all techniques, n_i of technique i, of what `contribution(i, x)` gives.
template <class P, class Random, class F>
typename P::Scalar sum_over_samples(const P& problem, std::span<const typename P::Scalar> counts,
                                    Random& random, F contribution) {
  using T = typename P::Scalar;
  T sum(0);
  for (std::size_t i = 0; i < problem.size(); ++i) {
    for (T j(0); j < counts[i]; j = j + T(1)) {
      if (const auto x = problem.sample(i, random)) sum = sum + contribution(i, *x);
    }
  }
  return sum;
}

/// Index i with probability selection[i]; they sum to 1.
template <class T, class Random>
std::size_t select(std::span<const T> selection, Random& random) {
  T u = random();
  for (std::size_t i = 0; i + 1 < selection.size(); ++i) {
    if (u < selection[i]) return i;
    u = u - selection[i];
  }
  return selection.size() - 1;
}

template <class T>
std::array<T, kMaxTechniques> filled_with(const T& value) {
  std::array<T, kMaxTechniques> values;
  values.fill(value);
  return values;
}

}  // namespace mis_detail

/// w_i(x) f(x)/(n_i p_i(x)): what a sample x of technique i adds to a multi-sample estimate, and,
/// with selection probabilities for counts, what it gives as a one-sample estimate.
///
/// @source Veach 1997, Eq. 9.4 and Section 9.2.4
template <class P>
typename P::Scalar mis_contribution(const P& problem, const Weighting& weighting,
                                    std::span<const typename P::Scalar> counts, std::size_t i,
                                    const typename P::Point& x) {
  const mis_detail::DensitiesAt<P> at(problem, counts, x);
  // Divided one after the other: the product n_i p_i may overflow.
  return mis_weight(weighting, at.span(), i) * (problem.value(x) / at.pdf(i)) / counts[i];
}

/// f/p_i by one technique alone; misses what the technique cannot sample.
template <class P, class Random>
requires SamplingProblem<P, Random>
typename P::Scalar single(const P& problem, std::size_t i, Random& random) {
  using T = typename P::Scalar;
  const auto x = problem.sample(i, random);
  return x ? T(problem.value(*x) / problem.density(i, *x).pdf) : T(0);
}

/// Σ f/p_i over one sample of each technique: M times too large. A negative control.
template <class P, class Random>
requires SamplingProblem<P, Random>
typename P::Scalar plain_sum(const P& problem, Random& random) {
  typename P::Scalar sum(0);
  for (std::size_t i = 0; i < problem.size(); ++i) sum = sum + single(problem, i, random);
  return sum;
}

/// The mean of f/p_i over one sample of each technique: right only if every technique alone is, and
/// as bad as the worst of them. A negative control.
template <class P, class Random>
requires SamplingProblem<P, Random>
typename P::Scalar naive_average(const P& problem, Random& random) {
  return plain_sum(problem, random) / typename P::Scalar(problem.size());
}

/// Σ_i Σ_j w_i f/(n_i p_i), n_i samples of technique i.
///
/// @param counts  n_i ≥ 1, whole numbers, one for each technique
/// @source Veach 1997, Eq. 9.4
template <class P, class Random>
requires SamplingProblem<P, Random>
typename P::Scalar multi_sample(const P& problem, const Weighting& weighting,
                                std::span<const typename P::Scalar> counts, Random& random) {
  return mis_detail::sum_over_samples(problem, counts, random,
                                      [&](std::size_t i, const typename P::Point& x) {
                                        return mis_contribution(problem, weighting, counts, i, x);
                                      });
}

/// w_i f/(c_i p_i), technique i chosen with probability c_i.
///
/// @param selection  c_i > 0, one for each technique, summing to 1
/// @source Veach 1997, Section 9.2.4
template <class P, class Random>
requires SamplingProblem<P, Random>
typename P::Scalar one_sample(const P& problem, const Weighting& weighting,
                              std::span<const typename P::Scalar> selection, Random& random) {
  using T = typename P::Scalar;
  const std::size_t i = mis_detail::select(selection, random);
  const auto x = problem.sample(i, random);
  return x ? mis_contribution(problem, weighting, selection, i, *x) : T(0);
}

/// f over the average of the pdfs, of which one, picked at random, drew the sample. Densities only.
///
/// @source Marschner, "Multiple Importance Sampling" (lecture notes): g_m = 2 f/(p_b + p_l)
template <class P, class Random>
requires SamplingProblem<P, Random>
typename P::Scalar coin_flip(const P& problem, Random& random) {
  using T = typename P::Scalar;
  const T share = T(1) / T(problem.size());
  const auto shares = mis_detail::filled_with(share);
  const std::span<const T> fractions(shares.data(), problem.size());
  const auto x = problem.sample(mis_detail::select(fractions, random), random);
  if (!x) return T(0);
  return problem.value(*x) / mis_detail::DensitiesAt<P>(problem, fractions, *x).mixture();
}

/// Mean of f/Σ α_k p_k with α_k = n_k/N, over exactly n_k samples of technique k. Densities only.
///
/// @param counts  n_i ≥ 1, whole numbers
/// @source Sbert et al., "Root adaptive MIS" (Eqs. 1 and 2), with N₁ = αN
template <class P, class Random>
requires SamplingProblem<P, Random>
typename P::Scalar deterministic_mixture(const P& problem,
                                         std::span<const typename P::Scalar> counts,
                                         Random& random) {
  using T = typename P::Scalar;
  T total(0);
  for (std::size_t k = 0; k < problem.size(); ++k) total = total + counts[k];
  std::array<T, kMaxTechniques> alpha{};
  for (std::size_t k = 0; k < problem.size(); ++k) alpha[k] = counts[k] / total;
  const std::span<const T> fractions(alpha.data(), problem.size());
  const T sum = mis_detail::sum_over_samples(
      problem, counts, random, [&](std::size_t, const typename P::Point& x) {
        return problem.value(x) / mis_detail::DensitiesAt<P>(problem, fractions, x).mixture();
      });
  return sum / total;
}

}  // namespace plumbline::renderer
