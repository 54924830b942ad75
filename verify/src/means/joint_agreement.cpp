#include "means/joint_agreement.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "means/mean_judgement.h"

namespace plumbline::verify {

namespace {

Moments moments_of_zeros(std::uint64_t count) {
  Moments all, power;
  power.add(0);
  for (; count > 0; count >>= 1) {
    if ((count & 1) != 0) all.merge(power);
    const Moments half = power;
    power.merge(half);
  }
  return all;
}

/// So that one check's levels are split over its quantities.
ErrorBudget split_budget(ErrorBudget budget, std::size_t quantities) {
  const auto parts = static_cast<double>(quantities);
  budget.suite_level /= parts;
  budget.pass_confidence = 1 - budget.pass_level() / parts;
  return budget;
}

class JointAgreement {
 public:
  JointAgreement(const MeanOptions& options, const std::vector<JointQuantity>& quantities)
      : options_(options),
        quantities_(quantities),
        plan_(plan_mean_looks(options.n0, options.max_samples,
                              split_budget(options.budget, quantities.size()))),
        a_(quantities.size()),
        b_(quantities.size()),
        results_(quantities.size()) {}

  CheckResult run(const JointSampler& a, const JointSampler& b) {
    std::uint64_t drawn = 0;
    for (std::size_t look = 0; look < plan_.samples.size(); ++look) {
      const std::uint64_t more = plan_.samples[look] - drawn;
      drawn = plan_.samples[look];
      a(more, a_);
      b(more, b_);
      a_.fill(drawn);
      b_.fill(drawn);
      if (judge(look)) break;
    }
    return worst();
  }

 private:
  /// Whether nothing is left to be decided.
  bool judge(std::size_t look) {
    bool undecided = false;
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
      if (results_[i].verdict != Verdict::inconclusive) continue;
      results_[i] = judge_one(i, look);
      if (results_[i].verdict == Verdict::fail) return true;
      undecided = undecided || results_[i].verdict == Verdict::inconclusive;
    }
    return !undecided;
  }

  CheckResult judge_one(std::size_t i, std::size_t look) const {
    const std::size_t whole = quantities_[i].whole;
    const double scale = (std::abs(a_[whole].mean()) + std::abs(b_[whole].mean())) / 2;
    const MeanQuestion q = agreement_question(options_, plan_, look, scale);
    CheckResult r = judge_mean(q, difference(evidence(a_[i]), evidence(b_[i])));
    r.figures.insert(r.figures.begin(),
                     {{Figure::mean_of_a, a_[i].mean()}, {Figure::mean_of_b, b_[i].mean()}});
    return r;
  }

  /// A fail before what is undecided, that before a pass; then by what of the tolerance is used.
  static std::pair<int, double> rank(const CheckResult& r) {
    const int verdict =
        r.verdict == Verdict::fail ? 2 : (r.verdict == Verdict::inconclusive ? 1 : 0);
    const double tolerance = r.tolerance.value_or(0);
    return {verdict, tolerance > 0 ? r.bound.value_or(0) / tolerance : 0};
  }

  CheckResult worst() const {
    std::size_t at = 0;
    for (std::size_t i = 1; i < results_.size(); ++i) {
      if (rank(results_[i]) > rank(results_[at])) at = i;
    }
    CheckResult r = results_[at];
    if (!r.reason.empty()) r.reason = quantities_[at].name + ": " + r.reason;
    // Of several the worst is no unbiased estimate of anything, which its reader must know.
    r.figures.emplace_back(Figure::quantities, static_cast<double>(results_.size()));
    if (r.verdict == Verdict::inconclusive) r.advice = "raise `max_samples`";
    return r;
  }

  const MeanOptions& options_;
  const std::vector<JointQuantity>& quantities_;
  LookPlan plan_;
  JointMoments a_, b_;
  std::vector<CheckResult> results_;
};

}  // namespace

void JointMoments::fill(std::uint64_t samples) {
  for (Moments& m : of_) {
    const std::uint64_t have = m.count() + m.non_finite();
    if (have < samples) m.merge(moments_of_zeros(samples - have));
  }
}

CheckResult agree_jointly(const MeanOptions& options, const std::vector<JointQuantity>& quantities,
                          const JointSampler& a, const JointSampler& b) {
  if (!(options.tolerance > 0) || quantities.empty() || options.max_samples == 0) {
    throw std::invalid_argument("agreement check '" + options.subject +
                                "': needs a positive tolerance and samples");
  }
  const Stopwatch watch;
  CheckResult result = JointAgreement(options, quantities).run(a, b);
  result.kind = CheckKind::agreement;
  result.subject = options.subject;
  result.expected = options.expected;
  result.seed = options.seed;
  result.seconds = watch.seconds();
  return result;
}

}  // namespace plumbline::verify
