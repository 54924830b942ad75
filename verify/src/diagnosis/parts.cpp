#include "diagnosis/parts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "diagnosis/ask.h"
#include "pairs/batches.h"
#include "streams.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

constexpr std::size_t kMostParts = 12;

double distance(const std::optional<SampleRecord>& a, const std::optional<SampleRecord>& b) {
  return length(sum(a->x, scaled(b->x, -1)));
}

/// Values of a number at which samples jump, the other numbers given.
class Line {
 public:
  Line(const SamplingPair& pair, std::size_t number, const Uniforms& others)
      : pair_(pair), number_(number), others_(others) {}

  std::vector<double> jumps() const {
    constexpr int kSteps = 1024;
    std::vector<double> at;
    for (int i = 0; i < kSteps; ++i) at.push_back((i + 0.5) / kSteps);
    const std::vector<Record> samples = samples_at(at);
    std::vector<Jump> found;
    const auto step = [&](std::size_t i) {
      return i + 1 < samples.size() && has_density(samples[i]) && has_density(samples[i + 1])
                 ? distance(samples[i], samples[i + 1])
                 : -1.0;
    };
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
      const double around = std::max(i > 0 ? step(i - 1) : 0.0, step(i + 1));
      if (!(step(i) > 1e-3 && step(i) > 1.2 * around)) continue;
      found.push_back({at[i], at[i + 1], samples[i], samples[i + 1], step(i)});
    }
    return narrowed(std::move(found));
  }

 private:
  struct Jump {
    double from = 0, to = 0;
    Record low, high;
    double size = 0;
  };

  std::vector<Record> samples_at(const std::vector<double>& at) const {
    std::vector<Uniforms> all(at.size(), others_);
    for (std::size_t i = 0; i < at.size(); ++i) all[i][number_] = at[i];
    return ask(pair_.sample, all);
  }

  /// Where they are, bisected in step; without those that become smooth on the way.
  std::vector<double> narrowed(std::vector<Jump> jumps) const {
    const double least = pair_.epsilon > 0x1p-40 ? 1e-6 : 1e-9;
    while (!jumps.empty() && jumps.front().to - jumps.front().from > least) {
      std::vector<double> middles;
      for (const Jump& jump : jumps) middles.push_back((jump.from + jump.to) / 2);
      const std::vector<Record> there = samples_at(middles);
      std::vector<Jump> left;
      for (std::size_t i = 0; i < jumps.size(); ++i) {
        Jump& jump = jumps[i];
        if (!has_density(there[i])) continue;
        const bool in_upper_half = distance(jump.low, there[i]) < distance(there[i], jump.high);
        (in_upper_half ? jump.from : jump.to) = middles[i];
        (in_upper_half ? jump.low : jump.high) = there[i];
        left.push_back(jump);
      }
      jumps = std::move(left);
    }
    std::vector<double> at;
    for (const Jump& jump : jumps) {
      if (distance(jump.low, jump.high) < jump.size / 4) continue;
      at.push_back((jump.from + jump.to) / 2);
    }
    return at;
  }

  const SamplingPair& pair_;
  std::size_t number_;
  Uniforms others_;
};

}  // namespace

double tolerance_of_parts(const SamplingPair& pair) { return pair.epsilon > 0x1p-40 ? 1e-2 : 1e-4; }

bool can_be_taken_apart(const SamplingPair& pair) {
  return pair.sample && !pair.draw && pair.lobes.empty() && !pair.preimages &&
         pair.domain.dimension() > 0 && pair.numbers >= pair.domain.dimension();
}

Parts parts_of(const SamplingPair& pair) {
  if (!can_be_taken_apart(pair)) return {};
  constexpr std::size_t kLines = 7, kAgree = 4;
  constexpr double kSame = 4e-6;
  Parts best{0, {0, 1}};
  bool far_too_many = false;
  for (std::size_t n = 0; n < static_cast<std::size_t>(pair.numbers); ++n) {
    Random random = random_for(Stream::part_lines);
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
    far_too_many = far_too_many || parts.count() > kMostParts;
    if (parts.count() > best.count() && parts.count() <= kMostParts) best = std::move(parts);
  }
  return best.count() < 2 && far_too_many ? Parts{} : best;
}

std::vector<Ways> ways_to(const BranchSearch& search, const Map& map, const SamplingPair& pair,
                          std::span<const BranchSearch::Target> targets) {
  const auto preimages = search.preimages(targets);
  std::vector<Uniforms> all;
  for (const auto& of_point : preimages) all.insert(all.end(), of_point.begin(), of_point.end());
  const auto densities = densities_by_differences(map, all, pair.domain.dimension(), pair.epsilon);
  std::vector<Ways> ways;
  auto next = densities.begin();
  for (const auto& of_point : preimages) {
    Ways& there = ways.emplace_back(std::vector<WayThere>{});
    for (const Uniforms& u : of_point) {
      const auto& d = *next++;
      if (!d || !(d->relative_error <= tolerance_of_parts(pair) / 4)) there.reset();
      if (there) there->push_back({*d, u});
    }
  }
  return ways;
}

bool choice_is_used_again(const SamplingPair& pair, const Parts& parts) {
  if (parts.borders.empty() && can_be_taken_apart(pair)) return true;  // texels, far too many
  for (std::size_t i = 0; parts.count() > 1 && i < parts.count(); ++i) {
    if (PartMap(pair, parts, i).uses_chooser()) return true;
  }
  return false;
}

PartMap::PartMap(const SamplingPair& pair, const Parts& parts, std::size_t part)
    : pair_(pair),
      parts_(parts),
      part_(part),
      map_(
          [this](std::span<const Uniforms> u, std::span<Record> out) {
            std::vector<Uniforms> all;
            for (const Uniforms& of_part : u) all.push_back(whole(of_part));
            pair_.sample(all, out);
          },
          pair.sample.batch()) {
  find_numbers();
  if (usable()) search_.emplace(map_, pair_.domain.dimension(), pair_.epsilon);
}

bool PartMap::uses_chooser() const {
  return std::find(numbers_.begin(), numbers_.end(), parts_.chooser) != numbers_.end();
}

Uniforms PartMap::draw(Random& random) const {
  Uniforms u{};
  for (std::size_t d = 0; d < dimension(); ++d) u[d] = random.uniform();
  return u;
}

double PartMap::accepted() const {
  constexpr std::size_t kTries = 10'000;
  Random random = random_for(Stream::part_accepted);
  std::vector<Uniforms> u;
  while (u.size() < kTries) u.push_back(draw(random));
  const std::vector<Record> samples = ask(map_, u);
  return static_cast<double>(std::count_if(samples.begin(), samples.end(), has_density)) /
         double{kTries};
}

/// All numbers of the pair, from those of the part.
Uniforms PartMap::whole(const Uniforms& u) const {
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

void PartMap::find_numbers() {
  numbers_.resize(static_cast<std::size_t>(pair_.numbers));
  std::iota(numbers_.begin(), numbers_.end(), std::size_t{0});  // all, while they are tried
  std::vector<std::size_t> used;
  Random random = random_for(Stream::part_numbers);
  for (const std::size_t n : numbers_) {
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
  numbers_ = std::move(used);
}

}  // namespace plumbline::verify
