#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/detail/stopwatch.h>

#include "bsdfs/bsdf_checks.h"
#include "bsdfs/bsdf_result.h"
#include "diagnosis/diagnosis.h"
#include "pairs/uniforms.h"
#include "rounding.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr std::size_t kPairs = 2'000;
// Part of the largest value below which a value matters to nothing, and is left out: the tails of
// exponentials, where formulas lose their digits by underflow.
constexpr double kOfThePeak = 1e-30;
// Pairs that only rounding explains, of those with a value: with more, little has been shown.
constexpr double kMostExplained = 0.9;

/// Uniform on the sides that are looked at.
Vec3 random_direction(const BsdfOptions& options, Random& random) {
  double z = 2 * random.uniform() - 1;
  if (!options.back) z = std::abs(z);
  if (!options.front) z = -std::abs(z);
  const double phi = 2 * std::numbers::pi * random.uniform(), radius = std::sqrt(1 - z * z);
  return {radius * std::cos(phi), radius * std::sin(phi), z};
}

double largest(const Channels& f) {
  double most = 0;
  for (std::size_t c = 0; c < f.count; ++c) {
    if (std::isfinite(f[c])) most = std::max(most, std::abs(f[c]));
  }
  return most;
}

/// f both ways, freed of η².
struct BothWays {
  Vec3 wo{}, wi{};
  Channels there, back;
};

class Reciprocity {
 public:
  Reciprocity(const std::string& name, const ErasedBsdf& bsdf, const BsdfOptions& options)
      : bsdf_(bsdf),
        options_(options),
        result_(bsdf_result(CheckKind::reciprocity, name, options.contract)) {}

  ReciprocityOutcome run() {
    for (const BothWays& pair : draw_pairs()) judge(pair);
    result_.reference = 0;
    result_.tolerance = stated_tolerance(bsdf_.epsilon);
    result_.estimate = result_.bound = worst_;
    result_.leaned_on = "points tested";
    result_.figures = {{Figure::pairs_with_value, judged_},
                       {Figure::explained_by_rounding, explained_}};
    if (failed_ > 0) {
      result_.verdict = Verdict::fail;
      result_.reason += " (" + number(failed_) + " of " + number(judged_) + " pairs fail)";
    } else if (result_.samples == 0) {
      result_.reason = "no direction was looked at: neither front nor back is asked for";
    } else if (explained_ > kMostExplained * judged_) {
      result_.reason = "at " + number(explained_) + " of " + number(judged_) +
                       " pairs f differs both ways, and as much between arguments that differ by "
                       "ulps: does eval draw random numbers, or are the lobes narrower than its "
                       "precision resolves?";
    } else {
      result_.verdict = Verdict::pass;
    }
    result_.seconds = watch_.seconds();
    return {std::move(result_), std::move(seen_)};
  }

 private:
  /// A channel of f, freed of η², at pairs of directions or at the same the other way.
  std::vector<double> there(const std::vector<std::array<Vec3, 2>>& pairs, bool reversed,
                            std::size_t c) const {
    std::vector<Vec3> wo, wi;
    for (const auto& [first, second] : pairs) {
      wo.push_back(reversed ? second : first);
      wi.push_back(reversed ? first : second);
    }
    std::vector<Channels> f(pairs.size());
    bsdf_.eval(wo, wi, f);
    std::vector<double> values;
    for (std::size_t i = 0; i < f.size(); ++i) {
      values.push_back(f[i][c] / reciprocity_divisor(bsdf_, wo[i], wi[i], options_.eta));
    }
    return values;
  }

  std::vector<BothWays> draw_pairs() {
    std::vector<BothWays> pairs;
    if (!options_.front && !options_.back) return pairs;
    draw_directions(pairs);
    std::vector<Vec3> wo, wi;
    for (const BothWays& p : pairs) {
      wo.push_back(p.wo);
      wi.push_back(p.wi);
    }
    std::vector<Channels> there(pairs.size()), back(pairs.size());
    bsdf_.eval(wo, wi, there);
    bsdf_.eval(wi, wo, back);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      pairs[i].there = freed_of_eta(there[i], wo[i], wi[i]);
      pairs[i].back = freed_of_eta(back[i], wi[i], wo[i]);
      peak_ = std::max({peak_, largest(pairs[i].there), largest(pairs[i].back)});
    }
    result_.samples = pairs.size();
    return pairs;
  }

  Channels freed_of_eta(Channels f, const Vec3& wo, const Vec3& wi) const {
    const double divisor = reciprocity_divisor(bsdf_, wo, wi, options_.eta);
    for (std::size_t c = 0; c < f.count; ++c) f.value[c] /= divisor;
    return f;
  }

  /// Of each wo a random wi, and one that is sampled, where there is a density.
  void draw_directions(std::vector<BothWays>& pairs) const {
    Random random = random_for(options_.contract.seed, Stream::reciprocity);
    std::vector<Vec3> wo, wi;
    std::vector<Uniforms> u;
    std::vector<std::optional<SampleRecord>> sampled(kPairs);
    for (std::size_t i = 0; i < kPairs; ++i) {
      wo.push_back(random_direction(options_, random));
      wi.push_back(random_direction(options_, random));
      if (bsdf_.draw) {
        sampled[i] = bsdf_.draw(wo[i], random);
      } else {
        u.push_back(draw_uniforms(random, bsdf_.numbers, bsdf_.epsilon));
      }
    }
    if (!bsdf_.draw) bsdf_.sample(wo, u, sampled);
    for (std::size_t i = 0; i < kPairs; ++i) {
      pairs.push_back({wo[i], wi[i], {}, {}});
      if (sampled[i] && sampled[i]->mass == 0) pairs.push_back({wo[i], sampled[i]->x, {}, {}});
    }
  }

  void judge(const BothWays& p) {
    const double least = std::max(kOfThePeak * peak_, smallest_with_digits(bsdf_.epsilon));
    bool counted = false, explained = false, failed = false;
    for (std::size_t c = 0; c < p.there.count && !failed; ++c) {
      const double a = p.there[c], b = p.back[c];
      if (std::abs(a) < least && std::abs(b) < least) continue;
      counted = true;
      if (c == 0) add_evidence(p);
      const double relative = std::abs(a - b) / std::max(std::abs(a), std::abs(b));
      const bool equal = equal_up_to_rounding(a, b, bsdf_.epsilon, [&] {
        explained = true;
        return spread(p, c);
      });
      failed = !equal;
      if (failed || !explained) worst_ = std::max(worst_, relative);
      if (failed && failed_ == 0) {
        result_.reason = "f(wo, wi)/η² = " + number(a) + ", the other way " + number(b) + ", " +
                         number(relative) + " apart, for wo " + place(p.wo) + ", wi " + place(p.wi);
      }
    }
    judged_ += counted ? 1 : 0;
    explained_ += explained && !failed ? 1 : 0;
    failed_ += failed ? 1 : 0;
  }

  /// What rounding does to f in both directions.
  double spread(const BothWays& p, std::size_t c) const {
    const auto of = [&](bool reversed) {
      const auto ask = [&](const std::vector<std::array<Vec3, 2>>& places) {
        return there(places, reversed, c);
      };
      return spread_by_rounding(std::array{p.wo, p.wi}, bsdf_.epsilon, Coordinates::directions,
                                ask);
    };
    return of(false) + of(true);
  }

  void add_evidence(const BothWays& p) {
    constexpr std::size_t kEnough = 300;  // each costs some 400 evaluations of f
    const double ratio = p.there[0] / p.back[0];
    if (!(ratio > 0) || !std::isfinite(ratio) || seen_.size() >= kEnough) return;
    const double error =
        stated_tolerance(bsdf_.epsilon) + spread(p, 0) / std::min(p.there[0], p.back[0]);
    seen_.push_back({p.wo, p.wi, ratio, std::isfinite(error) ? error : 1.0});
  }

  const Stopwatch watch_;
  const ErasedBsdf& bsdf_;
  const BsdfOptions& options_;
  CheckResult result_;
  std::vector<ReciprocityAt> seen_;
  double peak_ = 0;
  double judged_ = 0, explained_ = 0, failed_ = 0;  // pairs
  double worst_ = 0;
};

}  // namespace

CheckResult check_reciprocity(const std::string& name, const ErasedBsdf& bsdf,
                              const BsdfOptions& options) {
  ReciprocityOutcome outcome = judge_reciprocity(name, bsdf, options);
  if (outcome.result.verdict == Verdict::fail) {
    outcome.result.diagnosis = diagnose({{}, std::move(outcome.pairs), {}}).headline;
  }
  return outcome.result;
}

ReciprocityOutcome judge_reciprocity(const std::string& name, const ErasedBsdf& bsdf,
                                     const BsdfOptions& options) {
  return Reciprocity(name, bsdf, options).run();
}

}  // namespace plumbline::verify
