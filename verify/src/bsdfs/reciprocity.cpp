#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/detail/stopwatch.h>

#include "bsdfs/bsdf_checks.h"
#include "bsdfs/bsdf_result.h"
#include "diagnosis/diagnosis.h"
#include "rounding.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr int kPairs = 2'000;
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
  double there(const Vec3& wo, const Vec3& wi, std::size_t c) const {
    return bsdf_.eval(wo, wi)[c] / eta_squared(wo, options_.eta);
  }

  std::vector<BothWays> draw_pairs() {
    std::vector<BothWays> pairs;
    if (!options_.front && !options_.back) return pairs;
    Random random = random_for(options_.contract.seed, Stream::reciprocity);
    const auto add = [&](const Vec3& wo, const Vec3& wi) {
      pairs.push_back({wo, wi, bsdf_.eval(wo, wi), bsdf_.eval(wi, wo)});
      for (auto& [f, w] : {std::pair{&pairs.back().there, wo}, {&pairs.back().back, wi}}) {
        for (std::size_t c = 0; c < f->count; ++c) f->value[c] /= eta_squared(w, options_.eta);
        peak_ = std::max(peak_, largest(*f));
      }
    };
    for (int i = 0; i < kPairs; ++i) {
      const Vec3 wo = random_direction(options_, random);
      add(wo, random_direction(options_, random));
      const auto sampled = bsdf_.next(wo, random);
      if (sampled && sampled->mass == 0) add(wo, sampled->x);
    }
    result_.samples = pairs.size();
    return pairs;
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
      return spread_by_rounding(std::array{p.wo, p.wi}, bsdf_.epsilon, Coordinates::directions,
                                [&](const std::array<Vec3, 2>& w) {
                                  return reversed ? there(w[1], w[0], c) : there(w[0], w[1], c);
                                });
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
