#include "diagnosis/parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

#include "diagnosis/ask.h"
#include "diagnosis/fit.h"
#include "pairs/branches.h"
#include "pairs/differences.h"
#include "text.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

constexpr std::uint64_t kSeed = 0x5eed, kStream = 47;
constexpr std::size_t kMostParts = 12;
// Views that are taken apart, and points of each part.
constexpr std::size_t kViews = 2;
constexpr int kPointsPerPart = 16;
// A fold that differences do not see, or a branch that the search misses: among so many points few.
constexpr double kMissed = 0.06;

double distance(const std::optional<SampleRecord>& a, const std::optional<SampleRecord>& b) {
  return length(sum(a->x, scaled(b->x, -1)));
}

bool has_density(const std::optional<SampleRecord>& s) {
  return s && s->mass == 0 && is_finite(s->x);
}

double tolerance_of(const SamplingPair& pair) { return pair.epsilon > 0x1p-40 ? 1e-2 : 1e-4; }

/// Values of a number at which samples jump, the other numbers given.
class Line {
 public:
  Line(const SamplingPair& pair, std::size_t number, const Uniforms& others)
      : pair_(pair), number_(number), others_(others) {}

  std::vector<double> jumps() const {
    constexpr int kSteps = 1024;
    std::vector<double> at;
    std::vector<std::optional<SampleRecord>> samples;
    for (int i = 0; i < kSteps; ++i) {
      at.push_back((i + 0.5) / kSteps);
      samples.push_back(sample(at.back()));
    }
    std::vector<double> found;
    const auto step = [&](std::size_t i) {
      return i + 1 < samples.size() && has_density(samples[i]) && has_density(samples[i + 1])
                 ? distance(samples[i], samples[i + 1])
                 : -1.0;
    };
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
      const double around = std::max(i > 0 ? step(i - 1) : 0.0, step(i + 1));
      if (!(step(i) > 1e-3 && step(i) > 1.2 * around)) continue;
      if (const auto border = bisect(at[i], at[i + 1])) found.push_back(*border);
    }
    return found;
  }

 private:
  std::optional<SampleRecord> sample(double u) const {
    Uniforms all = others_;
    all[number_] = u;
    return pair_.sample(all);
  }

  /// nullopt: it becomes smooth on the way.
  std::optional<double> bisect(double from, double to) const {
    auto low = sample(from), high = sample(to);
    const double jump = distance(low, high);
    const double least = pair_.epsilon > 0x1p-40 ? 1e-6 : 1e-9;
    while (to - from > least) {
      const double middle = (from + to) / 2;
      const auto there = sample(middle);
      if (!has_density(there)) return std::nullopt;
      if (distance(low, there) < distance(there, high)) {
        from = middle;
        low = there;
      } else {
        to = middle;
        high = there;
      }
    }
    if (distance(low, high) < jump / 4) return std::nullopt;
    return (from + to) / 2;
  }

  const SamplingPair& pair_;
  std::size_t number_;
  Uniforms others_;
};

/// A part's map from its own numbers in [0, 1), as many as the domain has dimensions.
class PartMap {
 public:
  PartMap(const SamplingPair& pair, const Parts& parts, std::size_t part)
      : pair_(pair),
        parts_(parts),
        part_(part),
        map_([this](const Uniforms& u) { return pair_.sample(whole(u)); }) {
    find_numbers();
    if (usable()) search_.emplace(map_, pair_.domain.dimension(), pair_.epsilon);
  }
  PartMap(const PartMap&) = delete;
  PartMap& operator=(const PartMap&) = delete;

  bool usable() const { return numbers_.size() == dimension(); }
  const Map& map() const { return map_; }

  Uniforms draw(Random& random) const {
    Uniforms u{};
    for (std::size_t d = 0; d < dimension(); ++d) u[d] = random.uniform();
    return u;
  }

  /// Densities at a point that the numbers that lead to it bring, one each; nullopt where one of
  /// them is not known.
  std::optional<std::vector<DensityAt>> densities(const Vec3& x) const {
    std::vector<DensityAt> all;
    for (const Uniforms& u : search_->preimages(x)) {
      const auto d = density_by_differences(map_, u, pair_.domain.dimension(), pair_.epsilon);
      if (!d || !(d->relative_error <= tolerance_of(pair_) / 4)) return std::nullopt;
      all.push_back(*d);
    }
    return all;
  }

  double accepted() const {
    constexpr int kTries = 2000;
    Random random(kSeed, kStream + 1);
    int accepted = 0;
    for (int i = 0; i < kTries; ++i) accepted += has_density(map_(draw(random))) ? 1 : 0;
    return accepted / double{kTries};
  }

 private:
  std::size_t dimension() const { return static_cast<std::size_t>(pair_.domain.dimension()); }

  /// All numbers of the pair, from those of the part.
  Uniforms whole(const Uniforms& u) const {
    Uniforms all{0.37, 0.61, 0.43};
    const double from = parts_.borders[part_], share = parts_.share(part_);
    all[parts_.chooser] = from + 0.5 * share;
    for (std::size_t d = 0; d < numbers_.size(); ++d) {
      const std::size_t n = numbers_[d];
      // Rounding may not leave the part.
      const double inside = std::clamp(u[d], 1e-9, 1 - 1e-9);
      all[n] = n == parts_.chooser ? from + inside * share : u[d];
    }
    return all;
  }

  void find_numbers() {
    const auto count = static_cast<std::size_t>(pair_.numbers);
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    numbers_ = all;
    std::vector<std::size_t> used;
    Random random(kSeed, kStream + 2);
    for (const std::size_t n : all) {
      bool moves = false;
      for (int i = 0; i < 20 && !moves; ++i) {
        Uniforms u{random.uniform(), random.uniform(), random.uniform()};
        const auto here = map_(u);
        u[n] = 0.5 * u[n] + 0.2;
        const auto there = map_(u);
        moves = has_density(here) && has_density(there) && distance(here, there) > 1e-6;
      }
      if (moves) used.push_back(n);
    }
    numbers_ = used;
  }

  const SamplingPair& pair_;
  const Parts& parts_;
  std::size_t part_;
  std::vector<std::size_t> numbers_;
  Map map_;
  std::optional<BranchSearch> search_;
};

using Maps = std::vector<std::unique_ptr<PartMap>>;

Maps maps_of(const SamplingPair& pair, const Parts& parts) {
  Maps maps;
  for (std::size_t i = 0; i < parts.count(); ++i) {
    maps.push_back(std::make_unique<PartMap>(pair, parts, i));
    if (!maps.back()->usable()) return {};
  }
  return maps;
}

/// One equation Σ a q/pdf = 1.
struct Equation {
  std::vector<double> q;
  double error = 0;
};

std::vector<Equation> equations_of(const SamplingPair& pair, const Maps& maps) {
  std::vector<Equation> equations;
  Random random(kSeed, kStream);
  for (const auto& part : maps) {
    for (int i = 0; i < kPointsPerPart; ++i) {
      const auto s = part->map()(part->draw(random));
      if (!has_density(s)) continue;
      const double pdf = pair.pdf(s->x);
      if (!(pdf > 0)) continue;
      Equation e;
      for (const auto& other : maps) {
        const auto densities = other->densities(s->x);
        if (!densities) break;
        double q = 0;
        for (const DensityAt& d : *densities) {
          q += d.value / pdf;
          e.error = std::max(e.error, d.relative_error);
        }
        e.q.push_back(q);
      }
      if (e.q.size() == maps.size()) equations.push_back(std::move(e));
    }
  }
  return equations;
}

double residual(const Equation& e, const std::vector<double>& a) {
  return std::inner_product(a.begin(), a.end(), e.q.begin(), -1.0);
}

bool holds(const Equation& e, const std::vector<double>& a, double tolerance) {
  return std::abs(residual(e, a)) <= tolerance + 4 * e.error;
}

/// Least squares with weights, on every second equation.
std::vector<double> weighed(const std::vector<Equation>& equations, std::size_t parts,
                            const std::vector<double>& weight) {
  std::vector<std::vector<double>> normal(parts, std::vector<double>(parts));
  std::vector<double> right(parts);
  for (std::size_t k = 0; k < equations.size(); k += 2) {
    const Equation& e = equations[k];
    for (std::size_t i = 0; i < parts; ++i) {
      for (std::size_t j = 0; j < parts; ++j) normal[i][j] += weight[k] * e.q[i] * e.q[j];
      right[i] += weight[k] * e.q[i];
    }
  }
  for (std::size_t i = 0; i < parts; ++i) normal[i][i] *= 1 + 1e-13;
  return solve_definite(std::move(normal), std::move(right));
}

/// Least absolute deviations, then least squares of those that deviate little: what a missed branch
/// or a missing piece spoils is left aside.
std::vector<double> coefficients(const std::vector<Equation>& equations, std::size_t parts,
                                 double tolerance) {
  std::vector<double> weight(equations.size(), 1.0);
  std::vector<double> a = weighed(equations, parts, weight);
  constexpr int kSteps = 60;
  for (int step = 0; step < kSteps; ++step) {
    for (std::size_t k = 0; k < equations.size(); ++k) {
      weight[k] = 1 / std::max(std::abs(residual(equations[k], a)), tolerance / 100);
    }
    a = weighed(equations, parts, weight);
  }
  for (std::size_t k = 0; k < equations.size(); ++k) {
    weight[k] = std::abs(residual(equations[k], a)) < 100 * tolerance ? 1 : 0;
  }
  return weighed(equations, parts, weight);
}

struct Solved {
  Parts parts;
  std::vector<double> a;
  double sum = 0;       ///< ∫ of Σ a q
  bool off = false;     ///< an a is not the share
  bool pieces = false;  ///< pdf() holds more than Σ a q at some points
};

std::optional<Solved> solve_view(const ViewEvidence& view) {
  const SamplingPair& pair = *view.pair;
  Solved solved{parts_of(pair), {}};
  const std::size_t parts = solved.parts.count();
  if (parts < 2) return std::nullopt;
  const Maps maps = maps_of(pair, solved.parts);
  if (maps.empty()) return std::nullopt;
  const std::vector<Equation> equations = equations_of(pair, maps);
  if (equations.size() < 5 * parts) return std::nullopt;
  const double tolerance = tolerance_of(pair);
  solved.a = coefficients(equations, parts, tolerance);
  // Every second equation has not been fitted.
  double tested = 0, missed = 0, beyond = 0;
  for (std::size_t k = 1; k < equations.size(); k += 2) {
    ++tested;
    const Equation& e = equations[k];
    if (holds(e, solved.a, tolerance)) continue;
    const bool lacks_a_part = std::find(e.q.begin(), e.q.end(), 0.0) != e.q.end();
    (residual(e, solved.a) < 0 && lacks_a_part ? beyond : missed) += 1;
  }
  constexpr double kMostBeyond = 0.4;
  if (missed > kMissed * tested || beyond > kMostBeyond * tested) return std::nullopt;
  solved.pieces = beyond > kMissed * tested;
  for (std::size_t i = 0; i < parts; ++i) {
    solved.sum += solved.a[i] * maps[i]->accepted();
    if (std::abs(solved.a[i] - solved.parts.share(i)) > 20 * tolerance) solved.off = true;
  }
  return solved;
}

std::string listed(const std::vector<double>& numbers) {
  std::string text;
  for (const double n : numbers)
    text += (text.empty() ? "" : ", ") + number(std::round(1e4 * n) / 1e4);
  return text;
}

bool can_be_taken_apart(const SamplingPair& pair) {
  return pair.sample && !pair.draw && pair.lobes.empty() && !pair.preimages &&
         pair.domain.dimension() > 0 && pair.numbers >= pair.domain.dimension();
}

}  // namespace

Parts parts_of(const SamplingPair& pair) {
  if (!can_be_taken_apart(pair)) return {};
  constexpr std::size_t kLines = 7, kAgree = 4;
  constexpr double kSame = 4e-6;
  Parts best;
  for (std::size_t n = 0; n < static_cast<std::size_t>(pair.numbers); ++n) {
    Random random(kSeed, kStream + 3);
    std::vector<double> all;
    for (std::size_t line = 0; line < kLines; ++line) {
      const Uniforms others{random.uniform(), random.uniform(), random.uniform()};
      const std::vector<double> jumps = Line(pair, n, others).jumps();
      if (jumps.size() > 2 * kMostParts) return {};
      all.insert(all.end(), jumps.begin(), jumps.end());
    }
    std::sort(all.begin(), all.end());
    Parts parts{n, {0}};
    for (std::size_t i = 0; i < all.size();) {
      std::size_t j = i;
      while (j < all.size() && all[j] - all[i] < kSame) ++j;
      if (j - i >= kAgree) parts.borders.push_back((all[i] + all[j - 1]) / 2);
      i = j;
    }
    parts.borders.push_back(1);
    if (parts.count() > best.count() && parts.count() <= kMostParts) best = std::move(parts);
  }
  return best;
}

std::optional<Finding> explain_by_parts(const ReportEvidence& evidence) {
  std::optional<Solved> shown;
  bool complete = true;
  std::size_t looked_at = 0;
  for (const ViewEvidence& v : evidence.views) {
    if (!v.failed || !v.mass || looked_at == kViews) continue;
    ++looked_at;
    const auto solved = solve_view(v);
    if (!solved) return std::nullopt;
    if (!solved->off) continue;
    constexpr double kKnown = 0.02;
    complete = complete && !solved->pieces && std::abs(solved->sum - v.mass->integral) < kKnown;
    if (!shown) shown = solved;
  }
  if (!shown) return std::nullopt;
  std::vector<double> shares;
  for (std::size_t i = 0; i < shown->parts.count(); ++i) shares.push_back(shown->parts.share(i));
  const std::string chosen = "a random number chooses one of " + number(double(shares.size())) +
                             " parts with probabilities " + listed(shares);
  if (complete) {
    return Finding{CauseKind::lobe_probability,
                   chosen + ", but pdf() weighs their densities by " + listed(shown->a)};
  }
  return Finding{CauseKind::numbers_reused,
                 chosen +
                     " and is used again in it without being stretched to [0, 1): pdf() "
                     "has densities of whole parts, of which samples take a piece"};
}

std::optional<Finding> explain_by_branches(const ReportEvidence& evidence) {
  double several = 0, matching = 0, tested = 0;
  std::size_t looked_at = 0;
  for (const ViewEvidence& v : evidence.views) {
    const SamplingPair& pair = *v.pair;
    if (!v.failed || looked_at == kViews) continue;
    ++looked_at;
    if (!can_be_taken_apart(pair) || !pair.domain.directions()) return std::nullopt;
    const Parts whole{0, {0, 1}};
    const PartMap map(pair, whole, 0);
    if (!map.usable()) return std::nullopt;
    const double tolerance = tolerance_of(pair);
    constexpr int kPoints = 150;
    Random random(kSeed, kStream + 4);
    for (int i = 0; i < kPoints; ++i) {
      const auto s = map.map()(map.draw(random));
      if (!has_density(s)) continue;
      const double pdf = pair.pdf(s->x);
      const auto densities = map.densities(s->x);
      if (!densities || densities->empty()) continue;
      ++tested;
      several += densities->size() > 1 ? 1 : 0;
      matching += std::any_of(densities->begin(), densities->end(), [&](const DensityAt& d) {
        return std::abs(d.value / pdf - 1) <= tolerance + 4 * d.relative_error;
      });
    }
  }
  constexpr double kFewest = 6;
  if (several < kFewest || matching < (1 - kMissed) * tested) return std::nullopt;
  return Finding{CauseKind::not_rejected,
                 "samples come to the same point twice, by different random numbers, and pdf() "
                 "knows one way only: those that ought to be rejected are folded back or drawn "
                 "again (seen at " +
                     number(several) + " of " + number(tested) + " points)"};
}

}  // namespace plumbline::verify
