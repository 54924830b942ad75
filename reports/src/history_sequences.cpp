#include "history_sequences.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/mean.h>
#include <plumbline/verify/ratio.h>

namespace plumbline::reports::detail {
namespace {

namespace over_nights = verify::history;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t kFewestBatches = 64;         // of a first night, where it has the samples
constexpr std::uint64_t kSamplesOfABatch = 1 << 10;  // at most: skewness has mostly gone by then

/// A sequence as it goes on over the runs.
struct Followed {
  TrackedSequence record;
  over_nights::MeanSequence mean;
  over_nights::RatioSequence ratio;
  over_nights::ProportionSequence proportion;
  over_nights::TestSequence test;
};

/// Thousands of sequences stand on a page, each with a number for every night.
double four_digits(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10.0, 3 - std::floor(std::log10(std::abs(value))));
  return std::round(value * unit) / unit;
}

bool goes_on(const verify::CheckResult& check) {
  return check.expected == verify::Verdict::pass && check.waived.empty();
}

/// Sizes are powers of two, so that another night's number of samples seldom asks for another.
std::uint64_t batch_size(std::uint64_t samples) {
  return std::min(std::bit_floor(std::max<std::uint64_t>(samples / kFewestBatches, 1)),
                  kSamplesOfABatch);
}

/// A reference that is another is another question, whatever the sources say.
std::string code_of(const HistoryRun& run, const verify::CheckResult& check) {
  return run.sources + ' ' + std::to_string(check.reference.value_or(0)) + ' ' +
         std::to_string(check.tolerance.value_or(0));
}

void take_verdict(Followed& followed, const verify::CheckResult& judged, std::uint64_t nights) {
  followed.record.verdict = judged.verdict;
  followed.record.reason = judged.verdict == verify::Verdict::fail ? judged.reason : "";
  followed.record.nights = nights;
}

/// Adds a night to the sequence of a mean with a reference and a tolerance.
///
/// @param scale  what the rounding allowance is relative to
void add_batches(Followed& followed, const verify::CheckResult& check, const std::string& code,
                 double scale, std::size_t night) {
  over_nights::MeanSequence& sequence = followed.mean;
  const std::uint64_t size = sequence.all.samples_per_batch != 0 ? sequence.all.samples_per_batch
                                                                 : batch_size(check.samples);
  const over_nights::BatchMoments batches = batches_of(check, size);
  if (batches.batches == 0) return;
  sequence.add_night(code, batches);
  over_nights::MeanSequenceOptions options;
  options.subject = check.subject;
  options.reference = *check.reference;
  options.tolerance = *check.tolerance;
  options.rounding_allowance = verify::MeanOptions{}.rounding_allowance * scale;
  const verify::CheckResult judged = over_nights::judge_sequence(sequence, options);
  take_verdict(followed, judged, sequence.nights);
  followed.record.tolerance = check.tolerance;
  followed.record.bound[night] = four_digits(judged.bound.value_or(kMissing));
}

bool is_mean(const verify::CheckResult& check) {
  return check.reference && check.tolerance && check.samples > 0;
}

void add_mean(Followed& followed, const HistoryRun& run, const verify::CheckResult& check,
              std::size_t night) {
  if (!is_mean(check)) return;
  const double scale = *check.reference != 0 ? std::abs(*check.reference) : 1;
  add_batches(followed, check, code_of(run, check), scale, night);
}

/// Its tolerance is a share of means that are estimated anew every night: no other question.
void add_agreement(Followed& followed, const HistoryRun& run, const verify::CheckResult& check,
                   std::size_t night) {
  // The worst of several differences is a choice by their noise.
  if (!is_mean(check) || check.figure(verify::Figure::quantities).value_or(1) > 1) return;
  const auto a = check.figure(verify::Figure::mean_of_a);
  const auto b = check.figure(verify::Figure::mean_of_b);
  if (!a || !b) return;
  add_batches(followed, check, run.sources, (std::abs(*a) + std::abs(*b)) / 2, night);
}

/// The claim as it is recorded, and what belongs to other code where it is another.
std::string with_claim(const HistoryRun& run, std::optional<double> at_least,
                       std::optional<double> at_most) {
  return run.sources + ' ' + (at_least ? std::to_string(*at_least) : "") + ' ' +
         (at_most ? std::to_string(*at_most) : "");
}

/// Of an interval within a claim: what is proven of the distance from the claim's middle.
void take_interval(Followed& followed, const verify::Interval& interval, double at_least,
                   double at_most, std::size_t night) {
  const double middle = (at_least + at_most) / 2;
  const double bound = std::max(std::abs(interval.low - middle), std::abs(interval.high - middle));
  followed.record.tolerance = (at_most - at_least) / 2;
  followed.record.bound[night] = four_digits(bound);
}

void add_ratio(Followed& followed, const HistoryRun& run, const verify::CheckResult& check,
               std::size_t night) {
  using verify::Figure;
  const auto error = check.figure(Figure::error_of_logarithm);
  const auto batches = check.figure(Figure::batches);
  if (!check.estimate || !(*check.estimate > 0) || !error || !std::isfinite(*error) || !batches) {
    return;
  }
  // As a night by itself: one batch that carries a variance decides nothing.
  const double share = std::max(check.figure(Figure::largest_batch_of_a).value_or(0),
                                check.figure(Figure::largest_batch_of_b).value_or(0));
  if (!(share <= verify::kBatchShareLimit)) return;
  over_nights::RatioSequenceOptions options;
  options.claim.subject = check.subject;
  options.claim.at_least = check.figure(Figure::at_least);
  options.claim.at_most = check.figure(Figure::at_most);
  over_nights::RatioSequence& sequence = followed.ratio;
  sequence.add_night(with_claim(run, options.claim.at_least, options.claim.at_most),
                     std::log(*check.estimate), *error, *batches);
  const verify::CheckResult judged = over_nights::judge_sequence(sequence, options);
  take_verdict(followed, judged, sequence.nights);
  const verify::Interval logs{std::log(judged.interval->low), std::log(judged.interval->high)};
  if (options.claim.at_least && options.claim.at_most) {
    take_interval(followed, logs, std::log(*options.claim.at_least),
                  std::log(*options.claim.at_most), night);
  } else {
    followed.record.bound[night] = four_digits((logs.high - logs.low) / 2);
  }
}

void add_proportion(Followed& followed, const HistoryRun& run, const verify::CheckResult& check,
                    std::size_t night) {
  const auto hits = check.figure(verify::Figure::hits);
  const auto at_least = check.figure(verify::Figure::at_least);
  const auto at_most = check.figure(verify::Figure::at_most);
  if (!hits || !(*hits >= 0 && *hits <= static_cast<double>(check.samples)) || !at_least ||
      !at_most || check.samples == 0) {
    return;
  }
  verify::ProportionOptions claim;
  claim.subject = check.subject;
  claim.at_least = *at_least;
  claim.at_most = *at_most;
  over_nights::ProportionSequence& sequence = followed.proportion;
  sequence.add_night(with_claim(run, at_least, at_most), static_cast<std::uint64_t>(*hits),
                     check.samples);
  const verify::CheckResult judged = over_nights::judge_sequence(sequence, claim);
  take_verdict(followed, judged, sequence.nights);
  take_interval(followed, *judged.interval, *at_least, *at_most, night);
}

void add_test(Followed& followed, const HistoryRun& run, const verify::CheckResult& check,
              std::size_t night) {
  if (!check.p_value || !(*check.p_value >= 0 && *check.p_value <= 1)) return;
  followed.test.add_night(run.sources, *check.p_value);
  take_verdict(followed, over_nights::judge_sequence(followed.test, check.subject),
               followed.test.nights);
  followed.record.evidence[night] = four_digits(followed.test.log_evidence());
}

using Add = void (*)(Followed&, const HistoryRun&, const verify::CheckResult&, std::size_t);

/// How a kind of check goes on from night to night; none where it does not.
Add add_of(verify::CheckKind kind) {
  switch (kind) {
    case verify::CheckKind::mean:
      return add_mean;
    case verify::CheckKind::agreement:
      return add_agreement;
    case verify::CheckKind::variance_ratio:
      return add_ratio;
    case verify::CheckKind::proportion:
      return add_proportion;
    case verify::CheckKind::chi_square:
      return add_test;
    default:
      return nullptr;
  }
}

}  // namespace

over_nights::BatchMoments batches_of(const verify::CheckResult& check,
                                     std::uint64_t samples_per_batch) {
  over_nights::BatchMoments moments;
  const auto error = check.figure(verify::Figure::standard_error);
  if (!check.estimate || !error || !std::isfinite(*check.estimate) || !std::isfinite(*error)) {
    return moments;
  }
  moments.samples_per_batch = samples_per_batch;
  moments.batches = check.samples / samples_per_batch;
  if (moments.batches == 0) return moments;
  // The variance of a mean of n samples is σ²/n, and that of a batch's mean k = n/B times that; its
  // skewness is √k times that of the estimate.
  const double k = static_cast<double>(check.samples) / static_cast<double>(samples_per_batch);
  const double batches = static_cast<double>(moments.batches);
  const double deviation = *error * std::sqrt(k);
  const double skewness = check.figure(verify::Figure::skewness).value_or(0) * std::sqrt(k);
  // One sample that carries a share of Σ(x − mean)² = n²·error² moves its batch's mean by so much.
  const double largest =
      *error * k * std::sqrt(check.figure(verify::Figure::largest_share).value_or(0));
  moments.mean = *check.estimate;
  moments.m2 = (batches - 1) * deviation * deviation;
  moments.m3 = batches * skewness * deviation * deviation * deviation;
  moments.smallest = moments.mean - largest;
  moments.largest = moments.mean + largest;
  return moments;
}

std::vector<TrackedSequence> follow_checks(const History& history,
                                           const std::vector<HistoryRun>& runs) {
  std::map<std::pair<verify::CheckKind, std::string>, Followed> all;
  std::set<std::uint64_t> seeds;
  for (std::size_t night = 0; night < runs.size(); ++night) {
    const HistoryRun& run = runs[night];
    if (run.kind != "nightly" || run.sources.empty() || !seeds.insert(run.seed).second) continue;
    for (const verify::CheckResult& check : history.checks(run.id)) {
      const Add add = add_of(check.kind);
      if (!goes_on(check) || add == nullptr) continue;
      Followed& followed = all[{check.kind, check.subject}];
      followed.record.check = check.kind;
      followed.record.subject = check.subject;
      const bool has_evidence = check.kind == verify::CheckKind::chi_square;
      auto& shown = has_evidence ? followed.record.evidence : followed.record.bound;
      shown.resize(runs.size(), kMissing);
      add(followed, run, check, night);
    }
  }
  std::vector<TrackedSequence> sequences;
  for (auto& [name, followed] : all) {
    if (followed.record.nights > 0) sequences.push_back(std::move(followed.record));
  }
  return sequences;
}

}  // namespace plumbline::reports::detail
