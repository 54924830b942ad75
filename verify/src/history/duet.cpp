#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/history/duet.h>

#include "distributions.h"
#include "history/robust.h"
#include "text.h"

namespace plumbline::verify::history {

namespace {

constexpr std::size_t kMinimumPairs = 16;
// Enough that Student's t costs little (11 degrees of freedom are left), few enough that a batch
// outlasts what disturbs neighbouring pairs.
constexpr std::size_t kMostBatches = 20;

double log_ratio(const DuetPair& pair) {
  const auto is_time = [](double seconds) { return std::isfinite(seconds) && seconds > 0; };
  if (!is_time(pair.a_seconds) || !is_time(pair.b_seconds)) {
    throw std::invalid_argument("duet: times must be positive and finite, one pair took " +
                                number(pair.a_seconds) + " and " + number(pair.b_seconds) + " s");
  }
  return std::log(pair.b_seconds / pair.a_seconds);
}

/// Logarithmic ratios of neighbouring pairs, in which a and b went first once each.
struct Couples {
  std::vector<double> means;             ///< free of what going first costs
  std::vector<double> half_differences;  ///< that cost itself, as a logarithm
};

Couples couples(std::span<const DuetPair> pairs) {
  Couples result;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    const double a_first = log_ratio(pairs[i]), b_first = log_ratio(pairs[i + 1]);
    result.means.push_back((a_first + b_first) / 2);
    result.half_differences.push_back((b_first - a_first) / 2);
  }
  return result;
}

/// Medians of batches of neighbours, of as equal a size as can be.
std::vector<double> batch_medians(const std::vector<double>& values) {
  const std::size_t batches = std::min(values.size(), kMostBatches);
  const auto border = [&](std::size_t batch) {
    return values.begin() + static_cast<std::ptrdiff_t>(batch * values.size() / batches);
  };
  std::vector<double> result;
  for (std::size_t batch = 0; batch < batches; ++batch) {
    result.push_back(median({border(batch), border(batch + 1)}));
  }
  return result;
}

}  // namespace

DuetRatio duet_ratio(std::span<const DuetPair> pairs, double confidence) {
  if (pairs.size() < kMinimumPairs) {
    throw std::invalid_argument("duet: needs at least 16 pairs, has " +
                                std::to_string(pairs.size()));
  }
  if (!(confidence > 0 && confidence < 1)) {
    throw std::invalid_argument("duet: the confidence must lie between 0 and 1");
  }
  const Couples both = couples(pairs);
  const TrimmedMean log = trimmed_mean(batch_medians(both.means));
  const double reach = student_quantile((1 - confidence) / 2, log.degrees) * log.error;
  DuetRatio result;
  result.ratio = std::exp(log.mean);
  result.low = std::exp(log.mean - reach);
  result.high = std::exp(log.mean + reach);
  result.confidence = confidence;
  result.log_error = log.error;
  result.pairs = static_cast<int>(2 * both.means.size());
  result.cost_of_first = std::exp(median(both.half_differences));
  return result;
}

DuetVerdict judge_duet(const DuetRatio& duet, double slowdown) {
  if (!(std::isfinite(slowdown) && slowdown > -1)) {
    throw std::invalid_argument("duet: the slowdown asked about must be finite and above -1");
  }
  if (duet.low > 1 + slowdown) return DuetVerdict::slower;
  return duet.high <= 1 + slowdown ? DuetVerdict::not_slower : DuetVerdict::undecided;
}

}  // namespace plumbline::verify::history
