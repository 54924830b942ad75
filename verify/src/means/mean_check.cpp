#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <plumbline/verify/mean.h>

#include "means/mean_judgement.h"

namespace plumbline::verify {

namespace {

/// What helps where samples have not decided.
std::string advice(const MeanOptions& options) {
  if (!options.exact_variance) {
    return "raise `max_samples`, or give `exact_variance` where a closed form is known";
  }
  return std::isinf(*options.exact_variance)
             ? "expect `inconclusive`: the bound stands all the same"
             : "raise `max_samples`";
}

}  // namespace

Evidence evidence(const Moments& moments) {
  Evidence e;
  e.samples = moments.count();
  e.estimate = moments.mean();
  e.standard_error = moments.standard_error();
  e.skewness = e.samples == 0 ? 0 : moments.skewness() / std::sqrt(static_cast<double>(e.samples));
  e.largest_share = moments.largest_share();
  e.tail_index = moments.tail_index();
  e.smallest = moments.smallest();
  e.largest = moments.largest();
  e.rejected = moments.rejected();
  e.non_finite = moments.non_finite();
  return e;
}

Evidence difference(const Evidence& a, const Evidence& b) {
  Evidence e;
  e.samples = a.samples + b.samples;
  e.estimate = a.estimate - b.estimate;
  e.standard_error = std::hypot(a.standard_error, b.standard_error);
  if (e.standard_error > 0) {
    // Third central moments of independent estimates add.
    e.skewness = a.skewness * std::pow(a.standard_error / e.standard_error, 3) -
                 b.skewness * std::pow(b.standard_error / e.standard_error, 3);
    e.largest_share = std::max(a.largest_share * std::pow(a.standard_error / e.standard_error, 2),
                               b.largest_share * std::pow(b.standard_error / e.standard_error, 2));
  }
  e.tail_index = std::min(a.tail_index, b.tail_index);
  e.smallest = a.smallest - b.largest;
  e.largest = a.largest - b.smallest;
  e.rejected = a.rejected + b.rejected;
  e.non_finite = a.non_finite + b.non_finite;
  return e;
}

MeanCheck::MeanCheck(MeanOptions options)
    : options_(std::move(options)),
      plan_(plan_mean_looks(options_.n0, options_.max_samples, options_.budget)) {
  if (!std::isfinite(options_.reference) || !(options_.tolerance > 0) ||
      !(options_.rounding_allowance >= 0)) {
    throw std::invalid_argument("mean check '" + options_.subject +
                                "': needs a finite reference and a positive tolerance");
  }
  if (options_.relative && options_.reference == 0) {
    throw std::invalid_argument("mean check '" + options_.subject +
                                "': where the reference is 0 the tolerance is absolute");
  }
  if (options_.exact_variance.value_or(0) < 0) {
    throw std::invalid_argument("mean check '" + options_.subject + "': negative variance");
  }
}

std::uint64_t MeanCheck::samples_wanted() const {
  if (done_) return 0;
  const std::uint64_t have = moments_.count() + moments_.non_finite();
  const std::uint64_t next = plan_.samples[next_look_];
  return next > have ? next - have : 0;
}

void MeanCheck::add(const Moments& batch) {
  moments_.merge(batch);
  look(evidence(moments_));
}

void MeanCheck::look(const Evidence& all_so_far) {
  const std::uint64_t drawn = all_so_far.samples + all_so_far.non_finite;
  if (done_ || drawn < plan_.samples[next_look_]) return;
  // Samples beyond several looks at once make one look, the last of them.
  std::size_t look = next_look_;
  while (look + 1 < plan_.samples.size() && drawn >= plan_.samples[look + 1]) ++look;
  judge(all_so_far, look);
  next_look_ = look + 1;
  done_ = result_.verdict != Verdict::inconclusive || next_look_ == plan_.samples.size();
}

void MeanCheck::judge(const Evidence& evidence, std::size_t look) {
  const double scale = options_.relative ? std::abs(options_.reference) : 1.0;
  MeanQuestion question;
  question.reference = options_.reference;
  question.tolerance = options_.tolerance * scale;
  question.rounding_allowance = options_.rounding_allowance * scale;
  question.exact_variance = options_.exact_variance;
  set_look(question, plan_, look);
  result_ = judge_mean(question, evidence);
  if (result_.verdict == Verdict::inconclusive) result_.advice = advice(options_);
  result_.kind = CheckKind::mean;
  result_.seconds = watch_.seconds();
  result_.subject = options_.subject;
  result_.expected = options_.expected;
  result_.seed = options_.seed;
}

CheckResult check_mean(const MeanOptions& options, const MomentSampler& sampler) {
  MeanCheck check(options);
  std::uint64_t drawn = 0;
  while (!check.done()) {
    const std::uint64_t count = check.samples_wanted();
    const Moments batch = sampler(drawn, count);
    check.add(batch);
    if (batch.count() + batch.non_finite() == 0) {
      throw std::runtime_error("mean check '" + options.subject +
                               "': the sampler added no samples");
    }
    drawn += count;
  }
  return check.result();
}

}  // namespace plumbline::verify
