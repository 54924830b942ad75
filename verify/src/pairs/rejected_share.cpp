#include "pairs/rejected_share.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bernstein.h"
#include "pairs/batches.h"
#include "pairs/binned_pair.h"
#include "pairs/mass_integral.h"
#include "streams.h"

namespace plumbline::verify {

namespace {

using Sampler = Many<Record(Uniforms)>;

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

/// A share as so many points show it.
RejectedShare shown(double value, double variance, double largest_term, double points) {
  if (value == 0) return {0, 0, 0, points, 1 / points};
  return {value, variance, largest_term, points, 0};
}

/// Whether the sampler rejects random numbers, of each whether.
std::vector<char> rejected_of(const Sampler& sample, const std::vector<Uniforms>& u) {
  std::vector<char> rejected(u.size());
  std::vector<Record> records(std::min(u.size(), sample.batch()));
  for (std::size_t first = 0; first < u.size(); first += sample.batch()) {
    const std::size_t now = std::min(sample.batch(), u.size() - first);
    sample(std::span(u).subspan(first, now), std::span(records).first(now));
    for (std::size_t i = 0; i < now; ++i) rejected[first + i] = records[i] ? 0 : 1;
  }
  return rejected;
}

/// A line of constant second number, with the random numbers that it takes.
struct RejectedLine {
  static constexpr std::size_t kSteps = 64, kRandomPoints = 16;

  double second = 0;
  std::array<double, kSteps + 2> places{};     // 0, then one in each step, then the end
  std::array<double, kRandomPoints> points{};  // that the borders are not made from
  bool at_start = false;                       // rejected there
  std::vector<double> borders;                 // alternately into and out of the rejected part

  RejectedLine(double second_number, double last, Random& random) : second(second_number) {
    for (std::size_t i = 0; i < kSteps; ++i) {
      places[i + 1] = (static_cast<double>(i) + random.uniform()) / kSteps * last;
    }
    places.back() = last;
    for (std::size_t i = 0; i < kRandomPoints; ++i) {
      points[i] = (static_cast<double>(i) + random.uniform()) / kRandomPoints;
    }
  }

  /// Of the rejected part between the borders.
  double length() const {
    double sum = 0, start = 0;
    bool rejected = at_start;
    for (const double b : borders) {
      if (rejected) sum += b - start;
      start = b;
      rejected = !rejected;
    }
    return rejected ? sum + 1 - start : sum;
  }

  bool within_borders(double u) const {
    const auto passed = std::upper_bound(borders.begin(), borders.end(), u) - borders.begin();
    return (passed % 2 == 0) == at_start;
  }
};

/// A border between two places of a line, one of which is rejected.
struct RejectedBorder {
  RejectedLine* line;
  double from, to;
  bool at_from;

  double middle() const { return (from + to) / 2; }
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
    // A line takes more than 80 random numbers by itself: some dozens are worth a call.
    question.integrand = {
        [this](std::span<const Point2> p, std::span<double> out) { measure_lengths(p, out); },
        std::max<std::size_t>(16, sample_.batch() / 64)};
    question.dimension = 1;
    question.own = 0;
    question.spread = numbers_ == 1 ? 16 : 512;
    question.target = error_ / 2;
    question.good_enough = std::numeric_limits<double>::infinity();  // a grid may do as well
    question.max_evaluations = 6'000;
    question.seed = random_.bits();
    std::vector<Cell> strips;
    const int count = numbers_ == 1 ? 1 : 32;
    for (int i = 0; i < count; ++i) {
      strips.push_back({{{i / double(count), 0}, {(i + 1) / double(count), 1}}, 0});
    }
    const MassIntegral area = integrate_mass(question, strips);
    return shown(std::clamp(area.total, 0.0, 1.0), area.variance_of_total, area.largest_term,
                 points_);
  }

 private:
  /// Lengths of the rejected parts of lines, unbiased.
  void measure_lengths(std::span<const Point2> seconds, std::span<double> lengths) {
    std::vector<RejectedLine> lines;
    for (const Point2& p : seconds) lines.emplace_back(p[0], last_, random_);
    find_borders(lines);
    std::vector<Uniforms> points;
    for (const RejectedLine& line : lines) {
      for (const double u : line.points) points.push_back(numbers_at(u, line.second));
    }
    const std::vector<char> rejected = rejected_of(sample_, points);
    std::size_t next = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      double unseen = 0;
      for (const double u : lines[i].points) {
        unseen += (rejected[next++] != 0 ? 1.0 : 0.0) - (lines[i].within_borders(u) ? 1.0 : 0.0);
      }
      lengths[i] = lines[i].length() + unseen / RejectedLine::kRandomPoints;
    }
    points_ += static_cast<double>(points.size());
  }

  void find_borders(std::vector<RejectedLine>& lines) {
    std::vector<Uniforms> places;
    for (const RejectedLine& line : lines) {
      for (const double u : line.places) places.push_back(numbers_at(u, line.second));
    }
    const std::vector<char> rejected = rejected_of(sample_, places);
    std::vector<RejectedBorder> borders;
    std::size_t next = 0;
    for (RejectedLine& line : lines) {
      line.at_start = rejected[next] != 0;
      for (std::size_t i = 0; i + 1 < line.places.size(); ++i) {
        const bool here = rejected[next + i] != 0, there = rejected[next + i + 1] != 0;
        if (here != there) borders.push_back({&line, line.places[i], line.places[i + 1], here});
      }
      next += line.places.size();
    }
    bisect(borders);
    for (const RejectedBorder& b : borders) b.line->borders.push_back(b.middle());
  }

  /// All at once: each asks for its middle until it is known.
  void bisect(std::vector<RejectedBorder>& borders) {
    std::vector<RejectedBorder*> open;
    for (RejectedBorder& b : borders) open.push_back(&b);
    while (true) {
      std::erase_if(open, [&](const RejectedBorder* b) { return b->to - b->from <= 4 * epsilon_; });
      if (open.empty()) return;
      std::vector<Uniforms> middles;
      for (const RejectedBorder* b : open) {
        middles.push_back(numbers_at(b->middle(), b->line->second));
      }
      const std::vector<char> rejected = rejected_of(sample_, middles);
      for (std::size_t i = 0; i < open.size(); ++i) {
        (((rejected[i] != 0) == open[i]->at_from) ? open[i]->from : open[i]->to) =
            open[i]->middle();
      }
    }
  }

  Uniforms numbers_at(double first, double second) const {
    return {std::min(first, last_), std::min(second, last_), 0};
  }

  const Sampler& sample_;
  int numbers_;
  double error_;
  double last_, epsilon_;
  Random random_;
  double points_ = 0;
};

/// Share among random numbers of one after the other.
///
/// @param rejected_among  how many of so many more
template <class Rejected>
RejectedShare count(const Rejected& rejected_among, std::uint64_t at_most,
                    const Precision& precision) {
  double rejected = 0;
  std::uint64_t before = 0;
  for (std::uint64_t n = precision.probes();; n = std::min(2 * n, at_most)) {
    rejected += static_cast<double>(rejected_among(n - before));
    before = n;
    const double points = static_cast<double>(n), value = rejected / points;
    const RejectedShare share = shown(value, value * (1 - value) / points, 1 / points, points);
    if (share.error(kShareLevel) <= precision.counted || n >= at_most) return share;
  }
}

/// The same of a sampler that takes a generator.
template <class Draw>
RejectedShare count_drawn(const Draw& draw, Random& random, const Precision& precision) {
  const auto rejected_among = [&](std::uint64_t more) {
    std::uint64_t rejected = 0;
    for (std::uint64_t i = 0; i < more; ++i) rejected += draw(random) ? 0U : 1U;
    return rejected;
  };
  return count(rejected_among, kMostCounted, precision);
}

/// Two random points in each cell of a grid over the square or cube.
RejectedShare on_grid(const Sampler& sample, int numbers, int per_side, double epsilon,
                      Random& random) {
  const int layers = numbers == 2 ? 1 : per_side;
  double sum = 0, squares = 0;
  std::vector<Uniforms> points;
  const auto add_points = [&](const std::array<int, 3>& cell) {
    for (int twice = 0; twice < 2; ++twice) {
      Uniforms u{};
      for (std::size_t d = 0; d < static_cast<std::size_t>(numbers); ++d) {
        u[d] = std::min((cell[d] + random.uniform()) / per_side, 1 - epsilon);
      }
      points.push_back(u);
    }
  };
  const auto add_up = [&] {
    const std::vector<char> rejected = rejected_of(sample, points);
    for (std::size_t i = 0; i + 1 < rejected.size(); i += 2) {
      const double a = rejected[i], b = rejected[i + 1];
      sum += (a + b) / 2;
      squares += (a - b) * (a - b) / 4;
    }
    points.clear();
  };
  for (int i = 0; i < per_side; ++i) {
    for (int j = 0; j < per_side; ++j) {
      for (int k = 0; k < layers; ++k) add_points({i, j, k});
      if (points.size() >= sample.batch()) add_up();
    }
  }
  add_up();
  const double cells = static_cast<double>(per_side) * per_side * layers;
  return shown(sum / cells, squares / (cells * cells), 0.5 / cells, 2 * cells);
}

RejectedShare of_numbers(const Sampler& sample, int numbers, double epsilon,
                         const Precision& precision, std::uint64_t seed) {
  Random random = random_for(seed, Stream::probes);
  const auto rejected_among = [&](std::uint64_t more) {
    std::uint64_t rejected = 0;
    std::vector<Uniforms> batch;
    for (std::uint64_t i = 0; i < more; ++i) {
      Uniforms& u = batch.emplace_back();
      for (int d = 0; d < numbers; ++d) {
        u[static_cast<std::size_t>(d)] = std::min(random.uniform(), 1 - epsilon);
      }
      if (batch.size() < sample.batch() && i + 1 < more) continue;
      for (const char r : rejected_of(sample, batch)) rejected += r != 0 ? 1U : 0U;
      batch.clear();
    }
    return rejected;
  };
  const RejectedShare probed = count(rejected_among, precision.probes(), precision);
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
  if (value == 0) return -std::log(level) * unseen_term;
  if (unseen_term == 0) return bernstein(variance, largest_term, level);
  return bernstein(variance, largest_term, level / 2) - std::log(level / 2) * unseen_term;
}

RejectedShare RejectedShare::scaled(double factor) const {
  return {factor * value, factor * factor * variance, factor * largest_term, points / factor,
          factor * unseen_term};
}

void RejectedShare::add(const RejectedShare& part) {
  value += part.value;
  variance += part.variance;
  largest_term = std::max(largest_term, part.largest_term);
  points = points == 0 ? part.points : std::min(points, part.points);
  // Shares s_k of parts with probabilities p_k show nothing in n_k points each with a chance of at
  // most exp(−Σ n_k s_k), so that Σ p_k s_k ≤ −ln(level)·max p_k/n_k.
  unseen_term = std::max(unseen_term, part.unseen_term);
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
                       : count_drawn(lobe.draw, random, of_lobe))
              .scaled(lobe.probability);
      sum.add(share);
    }
    return sum;
  }
  if (pair.draw) {
    Random random = random_for(seed, Stream::probes);
    return count_drawn(pair.draw, random, precision);
  }
  return of_numbers(pair.sample, pair.numbers, pair.epsilon, precision, seed);
}

}  // namespace plumbline::verify
