#include "mass_balance.h"

#include <algorithm>
#include <cmath>

#include "distributions.h"

namespace plumbline::verify {

namespace {

/// Halves squares of u on the border between rejected and accepted ones.
class RejectedArea {
 public:
  explicit RejectedArea(const SamplingPair& pair) : pair_(pair) {}

  RejectedShare measure() {
    constexpr int kGrid = 64;
    for (int i = 0; i < kGrid; ++i) {
      for (int j = 0; j < kGrid; ++j) add({i / double{kGrid}, j / double{kGrid}}, 1.0 / kGrid, 0);
    }
    // Squares left on the border are known to about half their area each, with random sign.
    return {area_, 4 * std::sqrt(uncertain_), true};
  }

 private:
  static constexpr int kMaxDepth = 7;  // 8192 squares along each side

  void add(const Point2& corner, double size, int depth) {
    const double share = rejected_share(corner, size);
    const bool border = share > 0 && share < 1;
    if (!border || depth == kMaxDepth) {
      area_ += share * size * size;
      if (border) uncertain_ += size * size * size * size / 4;
      return;
    }
    for (const double x : {0.0, 0.5}) {
      for (const double y : {0.0, 0.5}) {
        add({corner[0] + x * size, corner[1] + y * size}, size / 2, depth + 1);
      }
    }
  }

  double rejected_share(const Point2& corner, double size) const {
    constexpr Point2 kProbes[] = {
        {0.5, 0.5}, {0.02, 0.03}, {0.97, 0.02}, {0.03, 0.98}, {0.98, 0.97}};
    int rejected = 0;
    for (const Point2& p : kProbes) {
      rejected += pair_.sample({corner[0] + p[0] * size, corner[1] + p[1] * size, 0}) ? 0 : 1;
    }
    return rejected / 5.0;
  }

  const SamplingPair& pair_;
  double area_ = 0, uncertain_ = 0;
};

}  // namespace

double MassBalance::expected_rejected(double tolerance) const {
  const double room = 1 - integral - atoms;
  const double slack = integral_error + tolerance;
  return std::clamp(rejected.value, room - slack, room + slack);
}

RejectedShare measure_rejected(const SamplingPair& pair) {
  if (pair.draw || pair.numbers != 2) return {};
  return RejectedArea(pair).measure();
}

MassBalance balance_mass(const BinnedPair& pair, const RejectedShare& measured, double level) {
  MassBalance balance;
  balance.integral = pair.expected().total;
  balance.integral_error = pair.expected().total_error;
  for (const AtomCount& a : pair.counts().atoms) balance.atoms += a.atom.mass;
  const double n = static_cast<double>(pair.counts().drawn);
  if (n == 0) {
    balance.rejected = measured;
    return balance;
  }
  // A rejection that no sample has shown may still have a share of −log(level)/n.
  const double share = static_cast<double>(pair.counts().rejected) / n;
  const double error =
      share == 0 ? 0 : normal_quantile(level / 2) * std::sqrt(share * (1 - share) / n) + 1 / n;
  balance.rejected = {share, error, false};
  // An area that the samples contradict has missed part of the set.
  const bool consistent = std::abs(measured.value - share) <= error + measured.error + 10 / n;
  if (measured.measured && consistent && measured.error < error) balance.rejected = measured;
  return balance;
}

}  // namespace plumbline::verify
