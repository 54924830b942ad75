#include "diagnosis/apart.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/ask.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr std::size_t kPointsPerPart = 24;
// Of many parts fewer points each: all of them have to be searched for at each point.
constexpr std::size_t kMostPoints = 96;

std::vector<std::unique_ptr<PartMap>> maps_of(const SamplingPair& pair, const Parts& parts) {
  std::vector<std::unique_ptr<PartMap>> maps;
  for (std::size_t i = 0; i < parts.count(); ++i) {
    maps.push_back(std::make_unique<PartMap>(pair, parts, i));
    if (!maps.back()->usable()) return {};
  }
  return maps;
}

/// @param probability  of the part, given the numbers that lead there
template <class Probability>
bool add_part(Equation& e, const std::optional<std::vector<WayThere>>& ways,
              const Probability& probability) {
  if (!ways) return false;
  PartThere there;
  double chosen = 0;
  for (const WayThere& way : *ways) {
    const double q = way.density.value / e.pdf;
    there.q += q;
    chosen += q * probability(way.u);
    e.error = std::max(e.error, way.density.relative_error);
  }
  there.probability = there.q > 0 ? chosen / there.q : probability({0.5, 0.5, 0.5});
  if (ways->size() == 1) there.u = ways->front().u;
  e.parts.push_back(there);
  return true;
}

}  // namespace

double Equation::sum() const {
  double all = 0;
  for (const PartThere& p : parts) all += p.contribution();
  return all;
}

Apart::Apart(const ViewEvidence& of) : view_(of), parts_(parts_of(*of.pair)) {
  if (parts_.count() > 1) {
    maps_ = maps_of(*of.pair, parts_);
    if (!maps_.empty()) add_points_of_parts();
    return;
  }
  if (!can_be_taken_apart(*of.pair)) return;
  two_ways_ = std::make_unique<TwoWays>(*of.pair);
  if (two_ways_->found()) {
    add_points_of_two_ways();
  } else {
    two_ways_.reset();
  }
}

void Apart::add_points_of_parts() {
  const SamplingPair& pair = *view_.pair;
  Random random = random_for(Stream::part_points);
  const std::size_t points =
      std::clamp(kMostPoints / maps_.size(), kPointsPerPart / 2, kPointsPerPart);
  for (std::size_t of = 0; of < maps_.size(); ++of) {
    for (std::size_t i = 0; i < points; ++i) {
      const Uniforms u = maps_[of]->draw(random);
      const auto s = maps_[of]->map()(u);
      if (!has_density(s)) continue;
      Equation e{s->x, pair.pdf(s->x), {}, 0};
      if (!(e.pdf > 0)) continue;
      for (std::size_t k = 0; k < maps_.size(); ++k) {
        const auto known = k == of ? std::optional(u) : std::nullopt;
        const double share = parts_.share(k);
        if (!add_part(e, maps_[k]->ways(s->x, known), [share](const Uniforms&) { return share; }))
          break;
      }
      if (e.parts.size() == maps_.size()) equations_.push_back(std::move(e));
    }
  }
}

void Apart::add_points_of_two_ways() {
  const SamplingPair& pair = *view_.pair;
  Random random = random_for(Stream::part_points);
  const BranchSearch searches[] = {{two_ways_->way(0), pair.domain.dimension(), pair.epsilon},
                                   {two_ways_->way(1), pair.domain.dimension(), pair.epsilon}};
  constexpr double kSeldom = 1e-4;
  for (std::size_t of = 0; of < 2; ++of) {
    for (std::size_t i = 0; i < kPointsPerPart; ++i) {
      const Uniforms u{random.uniform(), pair.domain.dimension() > 1 ? random.uniform() : 0, 0};
      const auto s = two_ways_->way(of)(u);
      if (!has_density(s) || two_ways_->probability(of, u) < kSeldom) continue;
      Equation e{s->x, pair.pdf(s->x), {}, 0};
      if (!(e.pdf > 0)) continue;
      for (std::size_t k = 0; k < 2; ++k) {
        const auto known = k == of ? std::optional(u) : std::nullopt;
        if (!add_part(e, ways_to(searches[k], two_ways_->way(k), pair, s->x, known),
                      [&](const Uniforms& at) { return two_ways_->probability(k, at); }))
          break;
      }
      if (e.parts.size() == 2) equations_.push_back(std::move(e));
    }
  }
}

ExactPoint Apart::exact(const Equation& e, double base, double density) const {
  ExactPoint p;
  p.place = {&view_, view_.wo.value_or(Vec3{}), e.x, base};
  p.ratio = density / base;
  // What is small beside the rest is known as well as the rest is.
  const double beside = std::max(1.0, e.sum()) * e.pdf / std::min(base, density);
  p.error = std::max(e.error, tolerance_of_parts(*view_.pair) / 4) * std::max(1.0, beside);
  return p;
}

std::vector<ExactPoint> Apart::densities() const {
  std::vector<ExactPoint> points;
  for (const Equation& e : equations_) {
    ExactPoint p;
    p.place = {&view_, view_.wo.value_or(Vec3{}), e.x, e.pdf};
    p.ratio = e.sum();
    p.error = std::max(e.error, tolerance_of_parts(*view_.pair) / 4);
    points.push_back(p);
  }
  return points;
}

std::optional<std::vector<ExactPoint>> Apart::densities_of(const std::vector<bool>& chosen) const {
  constexpr double kGoodShare = 0.1, kNothing = 0.02;
  std::vector<ExactPoint> points;
  double none = 0;
  for (const Equation& e : equations_) {
    double of_these = 0, of_others = 0;
    const std::optional<Uniforms>* u = nullptr;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      (chosen[k] ? of_these : of_others) += e.parts[k].contribution();
      if (chosen[k]) u = &e.parts[k].u;
    }
    if (of_these < kGoodShare * (of_these + of_others)) continue;
    const double left = 1 - of_others;
    if (left < kNothing) {
      ++none;
      continue;
    }
    points.push_back(exact(e, left * e.pdf, of_these * e.pdf));
    if (u != nullptr && *u) points.back().place.u = &**u;
  }
  const double all = none + static_cast<double>(points.size());
  if (none > kMissed * all) return std::nullopt;
  return points;
}

Apart::Excess Apart::excess_of(const std::vector<bool>& chosen, const Prediction& times,
                               std::span<const double> numbers) const {
  constexpr int kSamples = 4000;
  Random random = random_for(Stream::part_accepted);
  Excess all;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (!chosen[k]) continue;
    double sum = 0, squares = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Uniforms u{random.uniform(), random.uniform(), 0};
      const auto s = fixed() ? maps_[k]->map()(u) : two_ways_->way(k)(u);
      if (!has_density(s)) continue;
      const double factor = times({&view_, view_.wo.value_or(Vec3{}), s->x, 1, &u}, numbers);
      const double probability = fixed() ? parts_.share(k) : two_ways_->probability(k, u);
      // Where a factor is next to 0, few samples carry the sum.
      const double term = factor > 0 ? probability * (1 / factor - 1) : 0;
      sum += term;
      squares += term * term;
    }
    all.value += sum / kSamples;
    all.error = std::hypot(all.error, std::sqrt(squares) / kSamples);
  }
  return all;
}

std::string Apart::name_of(const std::vector<bool>& chosen) const {
  std::string shares;
  std::size_t parts = 0;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (!chosen[k]) continue;
    ++parts;
    if (fixed()) {
      shares += (shares.empty() ? "" : " and ") + number(std::round(1e4 * parts_.share(k)) / 1e4);
    }
  }
  if (!fixed())
    return chosen[0] ? "the way that low numbers choose" : "the way that high numbers choose";
  return (parts > 1 ? "the parts that are" : "the part that is") +
         std::string(" chosen with probability ") + shares;
}

}  // namespace plumbline::verify
