#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <plumbline/verify/mean.h>

/// Agreement of two estimators in several quantities that one sample gives at once: the shares of
/// regions and channels, several lights.
namespace plumbline::verify {

/// Moments of each quantity over the same samples. Most are 0 in most samples, and those need not
/// be added.
class JointMoments {
 public:
  explicit JointMoments(std::size_t quantities) : of_(quantities) {}

  /// At most once in a sample.
  void add(std::size_t quantity, double x) { of_[quantity].add(x); }

  /// Makes all quantities have `samples`: what was not added was 0.
  void fill(std::uint64_t samples);

  const Moments& operator[](std::size_t quantity) const { return of_[quantity]; }

 private:
  std::vector<Moments> of_;
};

/// Samples at the first look, for code that may be tailed heavily: gross errors are found in
/// milliseconds all the same.
inline constexpr std::uint64_t kFirstJointLook = 20'000;

/// Adds `count` more samples.
using JointSampler = std::function<void(std::uint64_t count, JointMoments& moments)>;

struct JointQuantity {
  std::string name;       ///< what reasons call it
  std::size_t whole = 0;  ///< quantity that tolerance and rounding allowance are relative to
};

/// check_agreement in each quantity. Fails where one does, passes where each has passed at some
/// look; levels are split over the quantities, so that the verdict has those of one check. The
/// numbers of the result are those of the quantity that is worst off.
///
/// Of `options` count subject, tolerance (relative to the mean of both estimates of the whole),
/// rounding_allowance, n0, max_samples, expected, seed and budget.
CheckResult agree_jointly(const MeanOptions& options, const std::vector<JointQuantity>& quantities,
                          const JointSampler& a, const JointSampler& b);

}  // namespace plumbline::verify
