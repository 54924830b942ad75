#include "diagnosis/two_ways.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/ask.h"
#include "streams.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

// The ends of the number that chooses; what is less likely than that is never chosen.
constexpr std::array<double, 2> kEnds = {1e-7, 1 - 1e-7};

/// The same point, or rejected both.
bool same_draw(const std::optional<SampleRecord>& a, const std::optional<SampleRecord>& b) {
  if (!has_density(a) || !has_density(b)) return has_density(a) == has_density(b);
  return length(sum(a->x, scaled(b->x, -1))) < 1e-12;
}

}  // namespace

TwoWays::TwoWays(const SamplingPair& pair) : pair_(pair) {
  if (pair.numbers != pair.domain.dimension() + 1) return;
  for (std::size_t n = 0; n < static_cast<std::size_t>(pair.numbers) && !found(); ++n) {
    if (chooses(n)) chooser_ = n;
  }
  for (std::size_t way = 0; way < maps_.size(); ++way) {
    maps_[way] = [this, way](const Uniforms& u) { return at(u, kEnds[way]); };
  }
}

double TwoWays::probability(std::size_t which, const Uniforms& others) const {
  const double first = border(others).value_or(0);
  return which == 0 ? first : 1 - first;
}

std::optional<SampleRecord> TwoWays::at(const Uniforms& others, double choice) const {
  const std::size_t chooser = chooser_.value_or(0);
  Uniforms all{};
  for (std::size_t n = 0, next = 0; n < static_cast<std::size_t>(pair_.numbers); ++n) {
    all[n] = n == chooser ? choice : others[next++];
  }
  return pair_.sample(all);
}

/// Where the first way ends: 1 where both ends of the number lead the same way; nullopt if the
/// number does something else as well.
std::optional<double> TwoWays::border(const Uniforms& others) const {
  const auto first = at(others, kEnds[0]), last = at(others, kEnds[1]);
  if (same_draw(first, last)) return 1;
  double from = kEnds[0], to = kEnds[1];
  while (to - from > 1e-12) {
    const double middle = (from + to) / 2;
    const auto there = at(others, middle);
    if (same_draw(there, first)) {
      from = middle;
    } else if (same_draw(there, last)) {
      to = middle;
    } else {
      return std::nullopt;
    }
  }
  return (from + to) / 2;
}

bool TwoWays::chooses(std::size_t number) {
  constexpr int kDraws = 24;
  constexpr std::array<double, 4> kBetween = {0.03, 0.35, 0.65, 0.97};
  chooser_ = number;
  Random random = random_for(Stream::part_lines);
  int borders = 0;
  bool only_chooses = true;
  for (int i = 0; i < kDraws && only_chooses; ++i) {
    const Uniforms others{random.uniform(), random.uniform(), 0};
    const auto ends_first = border(others);
    only_chooses = ends_first.has_value();
    if (!only_chooses) break;
    borders += *ends_first < 1 ? 1 : 0;
    for (const double t : kBetween) {
      const std::size_t way = t < *ends_first ? 0 : 1;
      only_chooses = only_chooses && same_draw(at(others, t), at(others, kEnds[way]));
    }
  }
  chooser_.reset();
  return only_chooses && borders > kDraws / 4;
}

}  // namespace plumbline::verify
