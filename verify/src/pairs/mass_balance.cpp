#include "pairs/mass_balance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "distributions.h"
#include "streams.h"

namespace plumbline::verify {

namespace {

/// Area of the rejected set: along lines of constant second number the borders are bisected, and
/// the lengths are integrated over the lines, halving where they are not smooth.
///
/// Random numbers that are rejected show where the set is thinner than the steps along a line, or
/// lies between two lines (a tongue a thousandth wide at grazing angles): lines look there too, and
/// strips that show too little for their points are halved.
class RejectedArea {
 public:
  using Sampler = std::function<std::optional<SampleRecord>(const Uniforms&)>;

  RejectedArea(const Sampler& sample, double epsilon, std::uint64_t seed)
      : sample_(sample), epsilon_(epsilon) {
    Random random = random_for(seed, Stream::rejected);
    for (int i = 0; i < kProbes; ++i) {
      const Point2 p{random.uniform(), random.uniform()};
      if (rejects(p[0], p[1])) probes_.push_back(p);
    }
    std::sort(probes_.begin(), probes_.end(),
              [](const Point2& a, const Point2& b) { return a[1] < b[1]; });
  }

  RejectedShare measure() {
    constexpr int kStrips = 64;
    samples_ = 0;
    double last = length(0);
    for (int i = 0; i < kStrips; ++i) {
      const double low = i / double{kStrips}, high = (i + 1) / double{kStrips};
      const double next = length(high);
      integrate(low, high, last, next, 0);
      last = next;
    }
    return {area_, error_, true};
  }

 private:
  // A set of 4e-5 is missed by all of them in one run of 200.
  static constexpr int kProbes = 1 << 17;
  static constexpr int kMaxDepth = 14;
  static constexpr std::uint64_t kMaxSamples = 400'000;
  static constexpr double kTolerance = 1e-6;  // of the area

  /// Simpson's rule on three lines, unless they do not lie on a straight line.
  void integrate(double low, double high, double at_low, double at_high, int depth) {
    const double middle = (low + high) / 2;
    const double at_middle = length(middle);
    const double width = high - low;
    const double area = width * (at_low + 4 * at_middle + at_high) / 6;
    const double bend = std::abs(at_middle - (at_low + at_high) / 2) * width;
    const bool smooth = bend <= kTolerance * std::sqrt(width) && !too_little(area, low, high);
    if (smooth || depth == kMaxDepth || samples_ > kMaxSamples) {
      area_ += area;
      error_ += bend / 3;
      return;
    }
    integrate(low, middle, at_low, at_middle, depth + 1);
    integrate(middle, high, at_middle, at_high, depth + 1);
  }

  /// The first probe that is not below a line.
  std::vector<Point2>::const_iterator probe_at(double second) const {
    return std::lower_bound(probes_.begin(), probes_.end(), second,
                            [](const Point2& p, double value) { return p[1] < value; });
  }

  /// With λ expected, c points come with probability below 0.05 if λ < (c − 0.8)/4.
  bool too_little(double area, double low, double high) const {
    const auto count = static_cast<double>(probe_at(high) - probe_at(low));
    return area * kProbes < (count - 0.8) / 4;
  }

  /// Where to look on a line: the ends, the middles of equal steps between them, and where the
  /// nearest probes were rejected.
  std::vector<double> places(double second) const {
    constexpr int kSteps = 128;
    constexpr std::ptrdiff_t kNearest = 8;
    std::vector<double> at;
    for (int i = 1; i < kSteps; ++i) at.push_back((i - 0.5) / (kSteps - 1));
    const auto here = probe_at(second);
    const auto from = here - std::min(kNearest, here - probes_.begin());
    const auto to = here + std::min(kNearest, probes_.end() - here);
    for (auto p = from; p != to; ++p) at.push_back((*p)[0]);
    std::sort(at.begin(), at.end());
    at.push_back(1 - epsilon_);
    return at;
  }

  /// Length of the rejected part of the line.
  double length(double second) {
    double sum = 0, from = 0;
    bool inside = rejects(0, second);
    for (const double to : places(second)) {
      const bool then = rejects(to, second);
      const double border = then == inside ? to : bisect(from, to, inside, second);
      if (inside) sum += border - from;
      if (then && !inside) sum += to - border;
      from = to;
      inside = then;
    }
    return sum;
  }

  double bisect(double from, double to, bool at_from, double second) {
    while (to - from > 4 * epsilon_) {
      const double middle = (from + to) / 2;
      (rejects(middle, second) == at_from ? from : to) = middle;
    }
    return (from + to) / 2;
  }

  bool rejects(double first, double second) {
    ++samples_;
    return !sample_({std::min(first, 1 - epsilon_), std::min(second, 1 - epsilon_), 0});
  }

  const Sampler& sample_;
  double epsilon_;
  std::vector<Point2> probes_;  // rejected ones, by their second number
  std::uint64_t samples_ = 0;
  double area_ = 0, error_ = 0;
};

}  // namespace

double MassBalance::expected_rejected(double tolerance) const {
  const double room = 1 - integral - atoms;
  const double slack = integral_error + tolerance;
  return std::clamp(rejected.value, room - slack, room + slack);
}

RejectedShare measure_rejected(const SamplingPair& pair, std::uint64_t seed) {
  if (pair.draw || pair.numbers != 2) return {};
  if (pair.lobes.empty()) return RejectedArea(pair.sample, pair.epsilon, seed).measure();
  for (const PairLobe& lobe : pair.lobes) {
    if (!lobe.sample) return {};
  }
  // A lobe's own square shows what is narrow in the share of the whole square that it has.
  RejectedShare sum{0, 0, true};
  for (const PairLobe& lobe : pair.lobes) {
    if (!(lobe.probability > 0)) continue;
    const RejectedShare share = RejectedArea(lobe.sample, pair.epsilon, seed).measure();
    sum.value += lobe.probability * share.value;
    sum.error += lobe.probability * share.error;
  }
  return sum;
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
  const double share = static_cast<double>(pair.counts().rejected) / n;
  const double error =
      share == 0 ? 0 : normal_quantile(level / 2) * std::sqrt(share * (1 - share) / n) + 1 / n;
  balance.rejected = {share, error, false};
  // What no sample has shown may still have a share of −log(level)/n.
  const double possible = share == 0 ? -std::log(level) / n : error;
  // An area that the samples contradict has missed part of the set.
  const bool consistent = std::abs(measured.value - share) <= possible + measured.error + 10 / n;
  if (measured.measured && consistent && measured.error < possible) balance.rejected = measured;
  return balance;
}

}  // namespace plumbline::verify
