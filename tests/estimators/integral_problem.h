#pragma once

#include <cstddef>
#include <optional>

#include <plumbline/analytic/integral1d.h>
#include <plumbline/renderer/estimators/estimators.h>
#include <plumbline/verify/detail/random.h>

namespace plumbline::tests {

/// Uniform numbers for the estimators, from the harness's generator.
template <class T>
class Uniform {
 public:
  explicit Uniform(verify::Random& random) : random_(random) {}
  T operator()() { return verify::uniform<T>(random_); }

 private:
  verify::Random& random_;
};

/// An analytic integral as the estimators see it, in the scalar T.
template <class T>
class IntegralProblem {
 public:
  using Scalar = T;
  using Point = T;

  explicit IntegralProblem(const analytic::Integral1d& integral) : integral_(integral) {}

  std::size_t size() const { return integral_.densities.size(); }

  T value(T x) const { return static_cast<T>(integral_.f(static_cast<double>(x))); }

  template <class Random>
  std::optional<T> sample(std::size_t i, Random& random) const {
    // Quantiles are defined inside (0, 1): 0 becomes half the smallest step of double.
    const auto u = static_cast<double>(random());
    return static_cast<T>(integral_.densities[i].quantile(u > 0 ? u : 0x1p-54));
  }

  renderer::TechniqueDensity<T> density(std::size_t i, T x) const {
    return {static_cast<T>(integral_.densities[i].pdf_x(static_cast<double>(x)))};
  }

 private:
  const analytic::Integral1d& integral_;
};

}  // namespace plumbline::tests
