#include "diagnosis/discrete.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "diagnosis/ask.h"
#include "distributions.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

// Samples for each of the set, at least and at most.
constexpr std::size_t kSamplesEach = 200, kFewestSamples = 100'000, kMostSamples = 2'000'000;

struct Counted {
  std::vector<double> pmf, observed;
  double samples = 0, sum = 0;
  double outside = 0;     ///< samples that name what is not there
  double outside_at = 0;  ///< the last of them
};

std::optional<Counted> count(const ViewEvidence& view) {
  const std::size_t size = view.pair->domain.size();
  if (size == 0 || size > kMostSamples / 10) return std::nullopt;
  Counted c;
  std::vector<Vec3> all;
  for (std::size_t i = 0; i < size; ++i) all.push_back({static_cast<double>(i), 0, 0});
  c.pmf = pdfs_at(view, all);
  for (const double p : c.pmf) {
    if (!(p >= 0) || !std::isfinite(p)) return std::nullopt;
    c.sum += p;
  }
  c.observed.assign(size, 0);
  Random random = random_for(Stream::discrete);
  const std::size_t samples = std::clamp(kSamplesEach * size, kFewestSamples, kMostSamples);
  for (const Record& s : draw_records(view, random, samples)) {
    if (!s) continue;
    if (!(s->x[0] >= 0) || s->x[0] >= static_cast<double>(size)) {
      ++c.outside;
      c.outside_at = s->x[0];
      continue;
    }
    ++c.observed[static_cast<std::size_t>(s->x[0])];
    ++c.samples;
  }
  if (!(c.samples > 0) || !(c.sum > 0)) return std::nullopt;
  return c;
}

double expected(const Counted& c, std::size_t i) { return c.samples * c.pmf[i] / c.sum; }

/// As often as pmf() says, apart from what it adds up to.
bool in_proportion(const Counted& c) {
  constexpr double kFewestExpected = 10, kLevel = 1e-4;
  double statistic = 0, degrees = -1;
  for (std::size_t i = 0; i < c.pmf.size(); ++i) {
    const double e = expected(c, i);
    if (e < kFewestExpected) continue;
    statistic += (c.observed[i] - e) * (c.observed[i] - e) / e;
    ++degrees;
  }
  return degrees < 1 || chi_square_tail(statistic, degrees) > kLevel;
}

Counted without(const Counted& c, std::size_t item) {
  Counted others = c;
  others.sum -= c.pmf[item];
  others.samples -= c.observed[item];
  others.pmf[item] = others.observed[item] = 0;
  return others;
}

/// Share of pmf() on what is never chosen.
double never_chosen(const Counted& c) {
  constexpr double kMany = 20;
  double share = 0;
  for (std::size_t i = 0; i < c.pmf.size(); ++i) {
    if (c.observed[i] == 0 && expected(c, i) > kMany) share += c.pmf[i] / c.sum;
  }
  return share;
}

}  // namespace

std::optional<Finding> explain_discrete(const ReportEvidence& evidence) {
  const ViewEvidence& view = evidence.views.front();
  if (view.pair->domain.dimension() != 0) return std::nullopt;
  const auto counted = count(view);
  if (!counted) return std::nullopt;
  const Counted& c = *counted;
  constexpr double kMany = 0.005;
  if (c.outside > kMany * (c.outside + c.samples)) {
    return Finding{CauseKind::support, percent(c.outside / (c.outside + c.samples)) +
                                           " of the samples name what is not there, as " +
                                           number(c.outside_at) + " of " +
                                           number(std::uint64_t{c.pmf.size()}) + " from 0 on"};
  }
  if (in_proportion(c)) {
    constexpr double kOne = 1e-4;
    if (std::abs(c.sum - 1) < kOne) return std::nullopt;
    const auto size = static_cast<double>(c.pmf.size());
    const bool per_item = std::abs(c.sum / size - 1) < kOne;
    return Finding{CauseKind::constant,
                   "pmf() adds up to " + number(c.sum) +
                       (per_item ? ", the number of items: a density over [0, 1), not a probability"
                                 : ", and is in proportion to how often each is chosen")};
  }
  const double never = never_chosen(c);
  const auto unchosen = static_cast<std::size_t>(
      std::find(c.observed.begin(), c.observed.end(), 0.0) - c.observed.begin());
  if (never > 0 && std::count(c.observed.begin(), c.observed.end(), 0.0) == 1 &&
      in_proportion(without(c, unchosen))) {
    return Finding{CauseKind::support,
                   "item " + number(std::uint64_t{unchosen}) + " of " +
                       number(std::uint64_t{c.pmf.size()}) +
                       " is never chosen, the others in proportion: an index too few?"};
  }
  const auto [least, most_likely] = std::minmax_element(c.pmf.begin(), c.pmf.end());
  if (c.pmf.size() > 1 && *most_likely - *least < 1e-9 * *most_likely) {
    return Finding{CauseKind::choice_probability,
                   "pmf() is the same for all, " + number(*least) +
                       ", but they are not chosen alike: the weight of the chosen one is missing"};
  }
  if (never > 0.02) {
    return Finding{CauseKind::numbers_reused,
                   percent(never) +
                       " of pmf() is on what is never chosen: a random number that has chosen one "
                       "way is used again without being stretched to [0, 1)?"};
  }
  std::size_t worst = 0;
  double most = 0;
  for (std::size_t i = 0; i < c.pmf.size(); ++i) {
    const double e = c.samples * c.pmf[i];
    const double pull = std::abs(c.observed[i] - e) / std::sqrt(e + 1);
    if (pull > most) most = pull, worst = i;
  }
  return Finding{CauseKind::choice_probability,
                 "pmf() is not the probability of choosing: " +
                     number(std::round(1e4 * c.observed[worst] / c.samples) / 1e4) +
                     " of the samples are item " + number(static_cast<double>(worst)) +
                     ", for which it gives " + number(c.pmf[worst])};
}

}  // namespace plumbline::verify
