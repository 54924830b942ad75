#include "diagnosis/two_ways.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
    maps_[way] = Map(
        [this, way](std::span<const Uniforms> u, std::span<Record> out) {
          std::vector<Uniforms> all;
          for (const Uniforms& others : u) all.push_back(all_numbers(others, kEnds[way]));
          pair_.sample(all, out);
        },
        pair.sample.batch());
  }
}

std::vector<double> TwoWays::probabilities(std::size_t which,
                                           const std::vector<Uniforms>& others) const {
  std::vector<double> probabilities;
  for (const auto& border : borders(others)) {
    const double first = border.value_or(0);
    probabilities.push_back(which == 0 ? first : 1 - first);
  }
  return probabilities;
}

Uniforms TwoWays::all_numbers(const Uniforms& others, double choice) const {
  const std::size_t chooser = chooser_.value_or(0);
  Uniforms all{};
  for (std::size_t n = 0, next = 0; n < static_cast<std::size_t>(pair_.numbers); ++n) {
    all[n] = n == chooser ? choice : others[next++];
  }
  return all;
}

std::vector<Record> TwoWays::at(const std::vector<Uniforms>& others,
                                const std::vector<double>& choices) const {
  std::vector<Uniforms> all;
  for (std::size_t i = 0; i < others.size(); ++i) {
    all.push_back(all_numbers(others[i], choices[i]));
  }
  return ask(pair_.sample, all);
}

/// Where the first way ends: 1 where both ends of the number lead the same way; nullopt if the
/// number does something else as well. Bisected in step.
std::vector<std::optional<double>> TwoWays::borders(const std::vector<Uniforms>& others) const {
  const std::size_t count = others.size();
  const auto first = at(others, std::vector<double>(count, kEnds[0]));
  const auto last = at(others, std::vector<double>(count, kEnds[1]));
  std::vector<std::optional<double>> borders(count, 1.0);
  std::vector<std::size_t> open;
  std::vector<double> from(count, kEnds[0]), to(count, kEnds[1]);
  for (std::size_t i = 0; i < count; ++i) {
    if (!same_draw(first[i], last[i])) open.push_back(i);
  }
  while (!open.empty() && to[open.front()] - from[open.front()] > 1e-12) {
    std::vector<Uniforms> asked;
    std::vector<double> middles;
    for (const std::size_t i : open) {
      asked.push_back(others[i]);
      middles.push_back((from[i] + to[i]) / 2);
    }
    const auto there = at(asked, middles);
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < open.size(); ++k) {
      const std::size_t i = open[k];
      const bool is_first = same_draw(there[k], first[i]);
      borders[i].reset();
      if (!is_first && !same_draw(there[k], last[i])) continue;
      (is_first ? from[i] : to[i]) = middles[k];
      left.push_back(i);
    }
    open = std::move(left);
  }
  for (const std::size_t i : open) borders[i] = (from[i] + to[i]) / 2;
  return borders;
}

bool TwoWays::chooses(std::size_t number) {
  constexpr std::size_t kDraws = 24;
  constexpr std::array<double, 4> kBetween = {0.03, 0.35, 0.65, 0.97};
  chooser_ = number;
  Random random = random_for(Stream::part_lines);
  std::vector<Uniforms> others(kDraws);
  for (Uniforms& u : others) u = {random.uniform(), random.uniform(), 0};
  const auto ends_first = borders(others);
  bool only_chooses = std::all_of(ends_first.begin(), ends_first.end(),
                                  [](const auto& border) { return border.has_value(); });
  for (std::size_t b = 0; b < kBetween.size() && only_chooses; ++b) {
    std::vector<double> ends;
    for (const auto& border : ends_first) ends.push_back(kEnds[kBetween[b] < *border ? 0 : 1]);
    const auto there = at(others, std::vector<double>(kDraws, kBetween[b]));
    const auto at_end = at(others, ends);
    only_chooses = std::equal(there.begin(), there.end(), at_end.begin(), same_draw);
  }
  chooser_.reset();
  const auto chosen = std::count_if(ends_first.begin(), ends_first.end(),
                                    [](const auto& border) { return border && *border < 1; });
  return only_chooses && static_cast<std::size_t>(chosen) > kDraws / 4;
}

}  // namespace plumbline::verify
