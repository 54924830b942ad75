#include "pairs/rejected_share.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "bernstein.h"
#include "pairs/binned_pair.h"
#include "pairs/mass_integral.h"
#include "streams.h"

namespace plumbline::verify {

namespace {

using Sampler = Many<std::optional<SampleRecord>(Uniforms)>;

constexpr double kShareLevel = 1e-3;
constexpr std::uint64_t kMostCounted = 1 << 24;

/// What the share has to be known to at 99.9 %, and how many probes show it where none is rejected.
struct Precision {
  double lines;    // to be worth their evaluations: as well as the mass of the density
  double counted;  // less than half of the promise that is made where samples alone show it

  Precision(const ContractOptions& options, double mass_error)
      : lines(mass_error),
        counted(std::max(mass_error, 0.4 * options.mass_tolerance.value_or(1e-3))) {}

  /// Of a part that has this probability. Shares of parts are independent: their variances, each
  /// times the square of the probability, add up to that of the whole.
  Precision of_part(double probability) const {
    Precision part = *this;
    part.lines /= std::sqrt(probability);
    part.counted /= std::sqrt(probability);
    return part;
  }

  std::uint64_t probes() const {
    return static_cast<std::uint64_t>(
        std::min<double>(kMostCounted, std::ceil(-std::log(kShareLevel) / lines)));
  }
};

/// The rejected part of lines of constant second number. Borders are bisected between random
/// places, and what lies unseen between those is added by random points that the borders were not
/// made from.
class RejectedLines {
 public:
  RejectedLines(const Sampler& sample, int numbers, double epsilon, double error,
                std::uint64_t seed)
      : sample_(sample),
        numbers_(numbers),
        error_(error),
        last_(1 - epsilon),
        epsilon_(epsilon),
        random_(random_for(seed, Stream::rejected)) {}

  RejectedShare measure() {
    MassQuestion question;
    question.integrand = [this](const Point2& p) { return length(p[0]); };
    question.dimension = 1;
    question.own = 0;
    question.spread = numbers_ == 1 ? 16 : 512;
    question.target = error_ / 2;
    question.max_evaluations = 6'000;
    question.seed = random_.bits();
    std::vector<Cell> strips;
    const int count = numbers_ == 1 ? 1 : 32;
    for (int i = 0; i < count; ++i) {
      strips.push_back({{{i / double(count), 0}, {(i + 1) / double(count), 1}}, 0});
    }
    const MassIntegral area = integrate_mass(question, strips);
    return {std::clamp(area.total, 0.0, 1.0), area.variance_of_total, area.largest_term, points_};
  }

 private:
  static constexpr int kSteps = 64, kRandomPoints = 16;

  /// Length of the rejected part of a line, unbiased.
  double length(double second) {
    std::vector<double> borders;  // alternately into and out of the rejected part
    bool inside = rejects(0, second);
    const bool at_start = inside;
    double from = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double to = i == kSteps ? last_ : (i + random_.uniform()) / kSteps * last_;
      if (rejects(to, second) != inside) {
        borders.push_back(bisect(from, to, inside, second));
        inside = !inside;
      }
      from = to;
    }
    const auto modelled = [&](double u) {
      const auto passed = std::upper_bound(borders.begin(), borders.end(), u) - borders.begin();
      return (passed % 2 == 0) == at_start;
    };
    double sum = 0, start = 0;
    bool rejected = at_start;
    for (const double b : borders) {
      if (rejected) sum += b - start;
      start = b;
      rejected = !rejected;
    }
    if (rejected) sum += 1 - start;
    double unseen = 0;
    for (int i = 0; i < kRandomPoints; ++i) {
      const double u = (i + random_.uniform()) / kRandomPoints;
      unseen += (rejects(u, second) ? 1.0 : 0.0) - (modelled(u) ? 1.0 : 0.0);
    }
    points_ += kRandomPoints;
    return sum + unseen / kRandomPoints;
  }

  double bisect(double from, double to, bool at_from, double second) {
    while (to - from > 4 * epsilon_) {
      const double middle = (from + to) / 2;
      (rejects(middle, second) == at_from ? from : to) = middle;
    }
    return (from + to) / 2;
  }

  bool rejects(double first, double second) {
    return !sample_({std::min(first, last_), std::min(second, last_), 0});
  }

  const Sampler& sample_;
  int numbers_;
  double error_;
  double last_, epsilon_;
  Random random_;
  double points_ = 0;
};

/// Share among random numbers of one after the other.
template <class Rejects>
RejectedShare count(const Rejects& rejects, std::uint64_t at_most, const Precision& precision) {
  RejectedShare share;
  double rejected = 0;
  for (std::uint64_t n = precision.probes();; n = std::min(2 * n, at_most)) {
    while (share.points < static_cast<double>(n)) {
      rejected += rejects() ? 1 : 0;
      share.points += 1;
    }
    share.value = rejected / share.points;
    share.variance = share.value * (1 - share.value) / share.points;
    share.largest_term = 1 / share.points;
    if (share.error(kShareLevel) <= precision.counted || n >= at_most) return share;
  }
}

/// Two random points in each cell of a grid over the square or cube.
RejectedShare on_grid(const Sampler& sample, int numbers, int per_side, double epsilon,
                      Random& random) {
  const int layers = numbers == 2 ? 1 : per_side;
  const auto rejected = [&](int i, int j, int k) {
    const std::array<int, 3> cell{i, j, k};
    Uniforms u{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(numbers); ++d) {
      u[d] = std::min((cell[d] + random.uniform()) / per_side, 1 - epsilon);
    }
    return sample(u) ? 0.0 : 1.0;
  };
  double sum = 0, squares = 0;
  for (int i = 0; i < per_side; ++i) {
    for (int j = 0; j < per_side; ++j) {
      for (int k = 0; k < layers; ++k) {
        const double a = rejected(i, j, k), b = rejected(i, j, k);
        sum += (a + b) / 2;
        squares += (a - b) * (a - b) / 4;
      }
    }
  }
  const double cells = static_cast<double>(per_side) * per_side * layers;
  return {sum / cells, squares / (cells * cells), 0.5 / cells, 2 * cells};
}

RejectedShare of_numbers(const Sampler& sample, int numbers, double epsilon,
                         const Precision& precision, std::uint64_t seed) {
  Random random = random_for(seed, Stream::probes);
  const auto rejects = [&] {
    Uniforms u{};
    for (int d = 0; d < numbers; ++d) {
      u[static_cast<std::size_t>(d)] = std::min(random.uniform(), 1 - epsilon);
    }
    return !sample(u);
  };
  const RejectedShare probed = count(rejects, precision.probes(), precision);
  if (probed.value == 0) return probed;
  RejectedShare best = probed;
  if (numbers < 3) {
    best = RejectedLines(sample, numbers, epsilon, precision.lines, seed).measure();
    if (numbers == 1 || best.error(kShareLevel) <= precision.lines) return best;
  }
  // Borders that no lines follow, many thin strips: points do as well, and cost less.
  // A border of dimension d − 1 crosses a share of the cells in proportion to 1/side, which makes
  // the error side^-(d + 1)/2.
  int side = numbers == 2 ? 128 : 24;
  const int most = numbers == 2 ? 768 : 96;
  const double power = 2.0 / (numbers + 1);
  while (!(best.error(kShareLevel) <= precision.counted)) {
    const RejectedShare grid = on_grid(sample, numbers, side, epsilon, random);
    const double error = grid.error(kShareLevel);
    if (error < best.error(kShareLevel)) best = grid;
    if (side == most) break;
    const double enough = 1.1 * side * std::pow(error / precision.counted, power);
    side = static_cast<int>(std::min<double>(most, std::ceil(std::max(enough, 1.2 * side))));
  }
  return best;
}

}  // namespace

double RejectedShare::error(double level) const {
  if (points == 0) return 0;
  if (value == 0) return -std::log(level) / points;
  return bernstein(variance, largest_term, level);
}

RejectedShare RejectedShare::scaled(double factor) const {
  return {factor * value, factor * factor * variance, factor * largest_term, points / factor};
}

RejectedShare measure_rejected(const SamplingPair& pair, const ContractOptions& options,
                               double mass_error) {
  const Precision precision(options, mass_error);
  const std::uint64_t seed = options.seed;
  if (!pair.lobes.empty()) {
    // A lobe's own square shows what is narrow in the share of the whole square that it has.
    RejectedShare sum;
    Random seeds = random_for(seed, Stream::lobe_seeds);
    for (const PairLobe& lobe : pair.lobes) {
      if (!(lobe.probability > 0)) continue;
      const std::uint64_t lobe_seed = seeds.bits();
      Random random = random_for(lobe_seed, Stream::probes);
      const Precision of_lobe = precision.of_part(lobe.probability);
      const RejectedShare share =
          (lobe.sample ? of_numbers(lobe.sample, 2, pair.epsilon, of_lobe, lobe_seed)
                       : count([&] { return !lobe.draw(random); }, kMostCounted, of_lobe))
              .scaled(lobe.probability);
      sum.value += share.value;
      sum.variance += share.variance;
      sum.largest_term = std::max(sum.largest_term, share.largest_term);
      sum.points = sum.points == 0 ? share.points : std::min(sum.points, share.points);
    }
    return sum;
  }
  if (pair.draw) {
    Random random = random_for(seed, Stream::probes);
    return count([&] { return !pair.draw(random); }, kMostCounted, precision);
  }
  return of_numbers(pair.sample, pair.numbers, pair.epsilon, precision, seed);
}

}  // namespace plumbline::verify
