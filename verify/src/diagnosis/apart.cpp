#include "diagnosis/apart.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "diagnosis/ask.h"
#include "pairs/batches.h"
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

/// @param probabilities  of the part, for each way's numbers
/// @param alone          the same where no way leads there
void add_part(Equation& e, const Ways& ways, std::span<const double> probabilities, double alone) {
  if (!ways) return;
  PartThere there;
  double chosen = 0;
  for (std::size_t i = 0; i < ways->size(); ++i) {
    const WayThere& way = (*ways)[i];
    const double q = way.density.value / e.pdf;
    there.q += q;
    chosen += q * probabilities[i];
    e.error = std::max(e.error, way.density.relative_error);
  }
  there.probability = there.q > 0 ? chosen / there.q : alone;
  if (ways->size() == 1) there.u = ways->front().u;
  e.parts.push_back(there);
}

/// Points that a part leads to, where pdf() is not 0, without their parts.
struct Points {
  std::vector<Uniforms> u;
  std::vector<Equation> equations;

  Points(const SamplingPair& pair, const Map& part, const std::vector<Uniforms>& tried) {
    const std::vector<Record> samples = ask(part, tried);
    std::vector<Vec3> x;
    for (std::size_t i = 0; i < tried.size(); ++i) {
      if (!has_density(samples[i])) continue;
      u.push_back(tried[i]);
      x.push_back(samples[i]->x);
    }
    const std::vector<double> pdfs = ask(pair.pdf, x);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!(pdfs[i] > 0)) continue;
      u[kept++] = u[i];
      equations.push_back({x[i], pdfs[i], {}, 0});
    }
    u.resize(kept);
  }

  /// @param known  the numbers belong to the part searched
  std::vector<BranchSearch::Target> targets(bool known) const {
    std::vector<BranchSearch::Target> all;
    for (std::size_t i = 0; i < u.size(); ++i) {
      all.push_back({equations[i].x, known ? std::optional(u[i]) : std::nullopt});
    }
    return all;
  }

  /// Those that are known of all parts.
  void add_complete(std::size_t parts, std::vector<Equation>& out) {
    for (Equation& e : equations) {
      if (e.parts.size() == parts) out.push_back(std::move(e));
    }
  }
};

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
    std::vector<Uniforms> tried;
    while (tried.size() < points) tried.push_back(maps_[of]->draw(random));
    Points there(pair, maps_[of]->map(), tried);
    for (std::size_t k = 0; k < maps_.size(); ++k) {
      const auto ways = maps_[k]->ways(there.targets(k == of));
      const double share = parts_.share(k);
      for (std::size_t i = 0; i < ways.size(); ++i) {
        const std::vector<double> shares(ways[i] ? ways[i]->size() : 0, share);
        add_part(there.equations[i], ways[i], shares, share);
      }
    }
    there.add_complete(maps_.size(), equations_);
  }
}

void Apart::add_points_of_two_ways() {
  const SamplingPair& pair = *view_.pair;
  Random random = random_for(Stream::part_points);
  const BranchSearch searches[] = {{two_ways_->way(0), pair.domain.dimension(), pair.epsilon},
                                   {two_ways_->way(1), pair.domain.dimension(), pair.epsilon}};
  constexpr double kSeldom = 1e-4;
  for (std::size_t of = 0; of < 2; ++of) {
    std::vector<Uniforms> tried;
    for (std::size_t i = 0; i < kPointsPerPart; ++i) {
      tried.push_back({random.uniform(), pair.domain.dimension() > 1 ? random.uniform() : 0, 0});
    }
    const std::vector<double> likely = two_ways_->probabilities(of, tried);
    std::vector<Uniforms> often;
    for (std::size_t i = 0; i < tried.size(); ++i) {
      if (likely[i] >= kSeldom) often.push_back(tried[i]);
    }
    Points there(pair, two_ways_->way(of), often);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto ways = ways_to(searches[k], two_ways_->way(k), pair, there.targets(k == of));
      std::vector<Uniforms> lead{{0.5, 0.5, 0.5}};
      for (const Ways& of_point : ways) {
        for (const WayThere& way : of_point.value_or(std::vector<WayThere>{})) {
          lead.push_back(way.u);
        }
      }
      const std::vector<double> probabilities = two_ways_->probabilities(k, lead);
      std::span<const double> left = std::span(probabilities).subspan(1);
      for (std::size_t i = 0; i < ways.size(); ++i) {
        add_part(there.equations[i], ways[i], left, probabilities.front());
        if (ways[i]) left = left.subspan(ways[i]->size());
      }
    }
    there.add_complete(2, equations_);
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
  constexpr std::size_t kSamples = 4000;
  Random random = random_for(Stream::part_accepted);
  Excess all;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (!chosen[k]) continue;
    double sum = 0, squares = 0;
    std::vector<Uniforms> numbers_of_samples(kSamples);
    for (Uniforms& u : numbers_of_samples) u = {random.uniform(), random.uniform(), 0};
    const std::vector<Record> samples =
        ask(fixed() ? maps_[k]->map() : two_ways_->way(k), numbers_of_samples);
    const std::vector<double> probabilities = fixed()
                                                  ? std::vector<double>(kSamples, parts_.share(k))
                                                  : two_ways_->probabilities(k, numbers_of_samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Uniforms& u = numbers_of_samples[i];
      const Record& s = samples[i];
      if (!has_density(s)) continue;
      const double factor = times({&view_, view_.wo.value_or(Vec3{}), s->x, 1, &u}, numbers);
      // Where a factor is next to 0, few samples carry the sum.
      const double term = factor > 0 ? probabilities[i] * (1 / factor - 1) : 0;
      sum += term;
      squares += term * term;
    }
    all.value += sum / double{kSamples};
    all.error = std::hypot(all.error, std::sqrt(squares) / double{kSamples});
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
