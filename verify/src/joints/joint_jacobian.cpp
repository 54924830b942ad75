#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <plumbline/verify/detail/stopwatch.h>

#include "joints/joint_bins.h"
#include "joints/joint_checks.h"
#include "joints/joint_differences.h"
#include "pairs/batches.h"
#include "pairs/seams.h"
#include "pairs/uniforms.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

// A map is flat where its density is proven to be more than that times the pdf, whatever else.
constexpr double kFlatDensity = 4;

class JointDifferences {
 public:
  JointDifferences(const JointPair& pair, const ContractOptions& options)
      : pair_(pair), options_(options), tolerance_(tolerance_of_differences(pair.epsilon)) {
    CheckResult& r = outcome_.result;
    r.kind = CheckKind::jacobian;
    r.subject = pair.name + "/jacobian";
    r.reference = 0;
    r.tolerance = tolerance_;
    r.seed = options.seed;
    r.leaned_on = "convergence of the differences";
  }

  JointJacobian skip(const char* reason) {
    outcome_.result.expected = Verdict::inconclusive;
    outcome_.result.reason = reason;
    return std::move(outcome_);
  }

  JointJacobian run() {
    Random random = random_for(options_.seed, Stream::joint_jacobian);
    std::vector<JointUniforms> tried(static_cast<std::size_t>(options_.jacobian_points));
    for (JointUniforms& u : tried) {
      // Near the ends of all numbers at once a map is rarely smooth: half of the points are not.
      const bool ends = random.uniform() < 0.5;
      for (std::size_t d = 0; d < static_cast<std::size_t>(pair_.numbers); ++d) {
        u[d] = ends ? draw_for_differences(random) : on_grid_of_differences(random.uniform());
      }
    }
    std::vector<JointUniforms> from;
    std::vector<JointPoint> to;
    const std::vector<MaybeJoint> samples = ask(pair_.sample, tried);
    for (std::size_t i = 0; i < tried.size(); ++i) {
      if (!samples[i] || !all_finite(samples[i]->x)) continue;
      from.push_back(tried[i]);
      to.push_back(samples[i]->x);
    }
    const std::vector<double> pdfs = ask(pair_.pdf, to);
    const auto densities = joint_densities_by_differences(pair_, from);
    for (std::size_t i = 0; i < from.size(); ++i) see(from[i], to[i], pdfs[i], densities[i]);
    finish();
    return std::move(outcome_);
  }

 private:
  void see(const JointUniforms& u, const JointPoint& x, double pdf,
           const std::optional<JointDensity>& density) {
    ++tried_;
    const bool known = density && density->near.relative_error <= tolerance_ / 4;
    const bool flat = !known && density && density->at_least > kFlatDensity * pdf;
    if (!known && !flat) {
      ++folds_;
      return;
    }
    const bool right = !flat && agree(pdf, density->near, tolerance_);
    if (!right && agrees_closely(u, pdf)) {
      ++folds_;
      return;
    }
    ++usable_;
    flat_ += flat ? 1 : 0;
    const double error = std::abs(pdf / density->near.value - 1);
    if (!(error <= worst_)) {
      worst_ = error;
      worst_at_ = x;
    }
    if (right) return;
    ++failing_;
    if (density->near.value < pdf) ++below_;
  }

  bool agrees_closely(const JointUniforms& u, double pdf) const {
    for (const double step : kShortSteps) {
      const auto close = joint_densities_by_differences(pair_, {u}, step).front();
      if (close && close->near.relative_error <= tolerance_ / 4 &&
          agree(pdf, close->near, tolerance_))
        return true;
    }
    return false;
  }

  void finish() {
    CheckResult& r = outcome_.result;
    r.samples = static_cast<std::uint64_t>(usable_);
    r.seconds = watch_.seconds();
    r.estimate = r.bound = worst_;
    r.detectable = tolerance_ * 2;
    r.figures = {
        {Figure::points_tried, tried_}, {Figure::folds, folds_}, {Figure::failing, failing_}};
    if (tried_ == 0) {
      r.expected = Verdict::inconclusive;
      r.reason = "the map gave no point of a density";
    } else if (more_than_seams(failing_, usable_)) {
      outcome_.below_everywhere = !more_than_seams(failing_ - below_, usable_);
      r.verdict = Verdict::fail;
      r.reason = "pdf · |dx/du| is off by " + number(worst_) + " at " + place(pair_, worst_at_) +
                 ", at " + number(failing_) + " of " + number(usable_) + " points";
      if (flat_ > usable_ / 2) {
        r.reason = "the map is flat: its points lie on a surface of fewer dimensions, at " +
                   number(flat_) + " of " + number(usable_) +
                   " points, as if one of its numbers were used twice or not at all";
      }
    } else if (folds_ > kMostFolds * tried_) {
      // In float that is rounding, which says nothing against the code: skipped, and said so.
      if (pair_.epsilon > 0x1p-40) r.expected = Verdict::inconclusive;
      r.reason =
          "differences do not converge at " + number(folds_) + " of " + number(tried_) + " points";
      r.advice = "take its numbers in double, or state many_to_one to skip this check";
    } else {
      r.verdict = Verdict::pass;
    }
  }

  const JointPair& pair_;
  const ContractOptions& options_;
  const Stopwatch watch_;
  double tolerance_;
  JointJacobian outcome_;
  double tried_ = 0, usable_ = 0, folds_ = 0, failing_ = 0, below_ = 0, flat_ = 0;
  double worst_ = 0;
  JointPoint worst_at_{};
};

}  // namespace

JointJacobian judge_joint_jacobian(const JointPair& pair, const ContractOptions& options) {
  JointDifferences jacobian(pair, options);
  if (pair.draw) return jacobian.skip("skipped: the sampler takes a generator, not numbers");
  if (pair.numbers != pair.domain.dimension()) {
    return jacobian.skip("skipped: the map does not use as many numbers as there are dimensions");
  }
  if (pair.many_to_one) return jacobian.skip("skipped: several random numbers lead to one point");
  return jacobian.run();
}

CheckResult check_jacobian(const JointPair& pair, const ContractOptions& options) {
  require_usable(pair, options);
  return judge_joint_jacobian(pair, options).result;
}

}  // namespace plumbline::verify
