#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace plumbline::verify {

/// Running moments of samples, in double and mergeable: what every check of a mean works on.
///
/// A sample is one evaluation of an estimator. A rejected sample (the sampler returned nothing) is
/// an estimate of 0 and is counted as such; a non-finite sample enters the count of non-finite
/// samples only, and no check passes while that is not 0.
///
/// @source Welford 1962 (mean, m2); merging: Chan, Golub, LeVeque 1979, Eq. 2.1; third moment:
///         Pébay 2008 (SAND2008-6212), Eqs. 2.1 and 3.1
class Moments {
 public:
  /// Adds one sample.
  void add(double x);

  /// Adds a sample that produced nothing: value 0, counted as rejected.
  void add_rejected();

  /// Adds all samples of another set. Merging in a fixed order gives the same bits whatever the
  /// threads did.
  void merge(const Moments& other);

  std::uint64_t count() const { return count_; }  ///< finite samples, rejected ones included
  std::uint64_t rejected() const { return rejected_; }
  std::uint64_t non_finite() const { return non_finite_; }

  double mean() const { return mean_; }

  /// Sum of squared deviations from the mean.
  double m2() const { return m2_; }

  /// Sum of cubed deviations from the mean.
  double m3() const { return m3_; }

  double smallest() const { return smallest_; }  ///< +infinity without samples
  double largest() const { return largest_; }    ///< -infinity without samples

  /// Unbiased variance of one sample; 0 for fewer than two.
  double variance() const;

  /// Standard deviation of the mean; 0 for fewer than two samples.
  double standard_error() const;

  /// Skewness of one sample; 0 where the variance is 0.
  double skewness() const;

  /// Share of m2 that the single most deviating sample carries, in [0, 1]; 0 where m2 is 0.
  double largest_share() const;

  /// Lower confidence limit (two standard errors) of the tail index a: P(|x| > t) falls like t^-a
  /// among the largest samples, the thousandth of them or, where those fall off faster (three
  /// standard errors), the largest 64 or more. At or below 2 the variance looks infinite. +infinity
  /// where the tail is bounded, or where fewer than 100,000 samples say too little.
  double tail_index() const;

 private:
  // Samples by binary exponent of |x|, −64 to 63 (beyond: the outermost).
  static constexpr int kOctaves = 128;

  std::uint64_t count_ = 0, rejected_ = 0, non_finite_ = 0;
  double mean_ = 0, m2_ = 0, m3_ = 0;
  double smallest_ = std::numeric_limits<double>::infinity();
  double largest_ = -std::numeric_limits<double>::infinity();
  std::array<std::uint64_t, kOctaves> octaves_{};
};

}  // namespace plumbline::verify
