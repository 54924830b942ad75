#include "history/nights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "history/robust.h"
#include "text.h"

namespace plumbline::verify::history {

namespace {

// A night this many robust standard deviations from its neighbours is no part of any level.
constexpr double kOdd = 6;
// Of neighbours on either side: the median of five is moved by three, and by no two.
constexpr std::size_t kNeighbours = 2;
// The median distance of two normal values is √2/1.4826 of their standard deviations.
constexpr double kOfTwoNormal = 1.4826 / std::numbers::sqrt2;

/// What disturbs a program only ever slows it down, so of several repetitions the best one moves
/// least from night to night.
/// @source Chen, Revels 2016 (arXiv:1608.04295), Section III
double level_of(const Series& series, const Night& night) {
  for (const double x : night.values) {
    if (!(x > 0 && std::isfinite(x))) {
      throw std::invalid_argument("history of '" + series.name + "': " + number(x) +
                                  " is not positive and finite");
    }
  }
  const auto [least, most] = std::minmax_element(night.values.begin(), night.values.end());
  return std::log(series.better == Better::lower ? *least : *most);
}

/// Distances of values from the median of their neighbourhood.
std::vector<double> distances_from_neighbours(const std::vector<double>& levels) {
  std::vector<double> result;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::size_t begin = i - std::min(i, kNeighbours);
    const std::size_t end = std::min(i + kNeighbours + 1, levels.size());
    const auto at = [&](std::size_t k) { return levels.begin() + static_cast<std::ptrdiff_t>(k); };
    result.push_back(std::abs(levels[i] - median({at(begin), at(end)})));
  }
  return result;
}

/// Standard deviation of a night about its level, from neighbours: levels that change now and then
/// and odd nights do not matter.
double robust_spread(const std::vector<double>& levels) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    steps.push_back(std::abs(levels[i] - levels[i - 1]));
  }
  return kOfTwoNormal * median(steps);
}

double counter_of(const Series& series, const Night& night) {
  const double value = night.values.front();
  for (const double x : night.values) {
    if (!std::isfinite(x) || x != value) {
      throw std::invalid_argument("history of '" + series.name +
                                  "': a counter is finite and the same all night, not " +
                                  number(value) + " and " + number(x));
    }
  }
  return value;
}

}  // namespace

KeptNights keep_nights(const Series& series) {
  KeptNights all, kept;
  for (std::size_t i = 0; i < series.nights.size(); ++i) {
    if (series.nights[i].values.empty()) continue;
    all.index.push_back(i);
    all.level.push_back(level_of(series, series.nights[i]));
  }
  if (all.level.size() <= 2 * kNeighbours) return all;
  const std::vector<double> distances = distances_from_neighbours(all.level);
  const double limit = kOdd * robust_spread(all.level);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] > limit) {
      kept.odd.push_back(all.index[i]);
    } else {
      kept.index.push_back(all.index[i]);
      kept.level.push_back(all.level[i]);
    }
  }
  return kept;
}

Change change_between(const Series& series, std::size_t last_before, std::size_t first_night,
                      std::size_t last_night) {
  Change change;
  change.first_night = first_night;
  change.last_night = last_night;
  change.commit_before = series.nights[last_before].commit;
  change.commit_first = series.nights[first_night].commit;
  change.commit_last = series.nights[last_night].commit;
  return change;
}

void set_sizes(const Series& series, double before, double after, Change& change) {
  change.before = before;
  change.after = after;
  change.relative = after / before - 1;
  change.regression = (after > before) == (series.better == Better::lower);
}

std::vector<Change> counter_changes(const Series& series) {
  std::vector<Change> result;
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < series.nights.size(); ++i) {
    if (series.nights[i].values.empty()) continue;
    const double now = counter_of(series, series.nights[i]);
    const double before = last ? series.nights[*last].values.front() : now;
    if (now != before) {
      Change change = change_between(series, *last, i, i);
      set_sizes(series, before, now, change);
      change.low = change.high = change.relative;
      result.push_back(change);
    }
    last = i;
  }
  return result;
}

}  // namespace plumbline::verify::history
