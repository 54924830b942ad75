#include "history_sequences.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/mean.h>

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

void add_mean(Followed& followed, const HistoryRun& run, const verify::CheckResult& check,
              std::size_t night) {
  if (!check.reference || !check.tolerance || check.samples == 0) return;
  over_nights::MeanSequence& sequence = followed.mean;
  const std::uint64_t size = sequence.all.samples_per_batch != 0 ? sequence.all.samples_per_batch
                                                                 : batch_size(check.samples);
  const over_nights::BatchMoments batches = batches_of(check, size);
  if (batches.batches == 0) return;
  sequence.add_night(code_of(run, check), batches);
  over_nights::MeanSequenceOptions options;
  options.subject = check.subject;
  options.reference = *check.reference;
  options.tolerance = *check.tolerance;
  const double scale = *check.reference != 0 ? std::abs(*check.reference) : 1;
  options.rounding_allowance = verify::MeanOptions{}.rounding_allowance * scale;
  const verify::CheckResult judged = over_nights::judge_sequence(sequence, options);
  take_verdict(followed, judged, sequence.nights);
  followed.record.tolerance = check.tolerance;
  followed.record.bound[night] = four_digits(judged.bound.value_or(kMissing));
}

void add_test(Followed& followed, const HistoryRun& run, const verify::CheckResult& check,
              std::size_t night) {
  if (!check.p_value || !(*check.p_value >= 0 && *check.p_value <= 1)) return;
  followed.test.add_night(run.sources, *check.p_value);
  take_verdict(followed, over_nights::judge_sequence(followed.test, check.subject),
               followed.test.nights);
  followed.record.evidence[night] = four_digits(followed.test.log_evidence());
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
      const bool mean = check.kind == verify::CheckKind::mean;
      if (!goes_on(check) || (!mean && check.kind != verify::CheckKind::chi_square)) continue;
      Followed& followed = all[{check.kind, check.subject}];
      followed.record.check = check.kind;
      followed.record.subject = check.subject;
      (mean ? followed.record.bound : followed.record.evidence).resize(runs.size(), kMissing);
      mean ? add_mean(followed, run, check, night) : add_test(followed, run, check, night);
    }
  }
  std::vector<TrackedSequence> sequences;
  for (auto& [name, followed] : all) {
    if (followed.record.nights > 0) sequences.push_back(std::move(followed.record));
  }
  return sequences;
}

}  // namespace plumbline::reports::detail
