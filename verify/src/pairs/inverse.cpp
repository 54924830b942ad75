#include "pairs/inverse.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/detail/stopwatch.h>

#include "pairs/batches.h"
#include "pairs/uniforms.h"
#include "streams.h"
#include "text.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

// Rounding errors that a map and its inverse of a few dozen operations pile up, in units of
// epsilon, and how many times the change between neighbours they may be beyond that.
constexpr double kRoundings = 256, kSpreads = 16;
// Neighbours of a point, and of its numbers, whose round trips show what rounding does.
constexpr std::size_t kSides = 4;

/// A point that is looked at.
struct Trip {
  Vec3 x{};
  double off = 0;     ///< of the point that its numbers lead to
  double spread = 0;  ///< of that difference between neighbours
  bool lost = false;  ///< its numbers lead nowhere
};

class RoundTrips {
 public:
  explicit RoundTrips(const SamplingPair& pair) : pair_(pair) {}

  std::vector<Trip> of(const std::vector<Vec3>& points) const {
    std::vector<Trip> trips(points.size());
    const std::vector<Uniforms> numbers = ask(pair_.inverse, points);
    const std::vector<Record> back = ask(pair_.sample, numbers);
    std::vector<std::size_t> doubtful;
    for (std::size_t i = 0; i < points.size(); ++i) {
      trips[i].x = points[i];
      trips[i].lost = !in_square(numbers[i]) || !has_density(back[i]);
      if (!trips[i].lost) trips[i].off = length(difference(back[i], points[i]));
      if (trips[i].lost || trips[i].off > rounding_at(points[i])) doubtful.push_back(i);
    }
    look_around(doubtful, numbers, back, trips);
    return trips;
  }

  double rounding_at(const Vec3& x) const {
    return kRoundings * pair_.epsilon * std::max(1.0, length(x));
  }

 private:
  bool in_square(const Uniforms& u) const {
    for (std::size_t d = 0; d < static_cast<std::size_t>(pair_.numbers); ++d) {
      if (!(u[d] >= 0 && u[d] <= 1)) return false;
    }
    return true;
  }

  static Vec3 difference(const Record& to, const Vec3& x) { return sum(to->x, scaled(x, -1)); }

  /// Round trips from neighbours of the points, and samples beside their numbers. A trip that is
  /// lost where one from beside it is not was lost by rounding.
  void look_around(const std::vector<std::size_t>& doubtful, const std::vector<Uniforms>& numbers,
                   const std::vector<Record>& back, std::vector<Trip>& trips) const {
    std::vector<Vec3> beside;
    std::vector<Uniforms> moved;
    for (const std::size_t i : doubtful) {
      for (std::size_t k = 0; k < kSides; ++k) {
        beside.push_back(point_beside(trips[i].x, k));
        moved.push_back(numbers_beside(numbers[i], k));
      }
    }
    const std::vector<Uniforms> back_to = ask(pair_.inverse, beside);
    const std::vector<Record> from_beside = ask(pair_.sample, back_to);
    const std::vector<Record> at_moved = ask(pair_.sample, moved);
    for (std::size_t j = 0; j < beside.size(); ++j) {
      const std::size_t i = doubtful[j / kSides];
      Trip& trip = trips[i];
      if (trip.lost) {
        trip.lost = !in_square(back_to[j]) || !has_density(from_beside[j]);
        continue;
      }
      if (!has_density(back[i])) continue;
      if (has_density(from_beside[j])) {
        const Vec3 change =
            sum(difference(from_beside[j], beside[j]), scaled(difference(back[i], trip.x), -1));
        trip.spread = std::max(trip.spread, length(change));
      }
      if (has_density(at_moved[j])) {
        trip.spread = std::max(trip.spread, length(difference(at_moved[j], back[i]->x)));
      }
    }
  }

  Vec3 point_beside(const Vec3& x, std::size_t side) const {
    const double angle = static_cast<double>(side) * std::numbers::pi / 2;
    return pair_.domain.chart().near(x, 8 * pair_.epsilon, angle);
  }

  /// In each number, to both sides.
  Uniforms numbers_beside(Uniforms u, std::size_t side) const {
    const std::size_t d = side % static_cast<std::size_t>(std::min(pair_.numbers, 2));
    const double step = (side < kSides / 2 ? 2 : -2) * pair_.epsilon;
    u[d] = std::clamp(u[d] + step, 0.0, 1 - pair_.epsilon);
    return u;
  }

  const SamplingPair& pair_;
};

/// Half of them samples, half anywhere in the domain where the density is positive.
std::vector<Vec3> points_of(const SamplingPair& pair, const ContractOptions& options) {
  Random random = random_for(options.seed, Stream::inverse);
  const auto each = static_cast<std::size_t>(options.jacobian_points);
  std::vector<Uniforms> u(each);
  for (Uniforms& numbers : u) numbers = draw_uniforms(random, pair.numbers, pair.epsilon);
  std::vector<Vec3> points;
  for (const Record& sample : ask(pair.sample, u)) {
    if (has_density(sample)) points.push_back(sample->x);
  }
  std::vector<Vec3> anywhere(each);
  for (Vec3& x : anywhere) {
    x = pair.domain.chart().from_square({random.uniform(), random.uniform()});
  }
  const std::vector<double> densities = ask(pair.pdf, anywhere);
  for (std::size_t i = 0; i < each; ++i) {
    if (densities[i] > 0) points.push_back(anywhere[i]);
  }
  return points;
}

}  // namespace

CheckResult judge_inverse(const SamplingPair& pair, const ContractOptions& options) {
  const Stopwatch watch;
  CheckResult r;
  r.kind = CheckKind::inverse;
  r.subject = pair.name + "/inverse";
  r.seed = options.seed;
  r.reference = 0;
  r.leaned_on = "points tested";
  const RoundTrips round_trips(pair);
  std::size_t failing = 0;
  double worst = 0;
  const std::vector<Trip> trips = round_trips.of(points_of(pair, options));
  for (const Trip& trip : trips) {
    const double allowed = round_trips.rounding_at(trip.x) + kSpreads * trip.spread;
    if (!trip.lost && trip.off <= allowed) {
      worst = std::max(worst, trip.off);
      continue;
    }
    if (failing++ > 0) continue;
    r.reason = trip.lost
                   ? "the inverse of " + place(trip.x) + " leads nowhere"
                   : "sample(inverse(x)) is off by " + number(trip.off) + " at " + place(trip.x);
  }
  r.samples = trips.size();
  r.estimate = r.bound = worst;
  r.figures = {{"points tried", static_cast<double>(trips.size())},
               {"failing", static_cast<double>(failing)}};
  if (trips.empty()) {
    r.reason = "the map gave no point of a density";
    r.expected = Verdict::inconclusive;
  } else if (failing > 0) {
    r.verdict = Verdict::fail;
    r.reason += " (" + number(std::uint64_t{failing}) + " of " +
                number(std::uint64_t{trips.size()}) + " points fail)";
  } else {
    r.verdict = Verdict::pass;
  }
  r.seconds = watch.seconds();
  return r;
}

CheckResult check_inverse(const SamplingPair& pair, const ContractOptions& options) {
  if (!has_inverse(pair)) {
    throw std::invalid_argument(pair.name +
                                ": a round trip needs `inverse` and a `sample` of numbers");
  }
  return judge_inverse(pair, options);
}

}  // namespace plumbline::verify
