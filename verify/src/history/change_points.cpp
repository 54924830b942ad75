#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include <plumbline/verify/history/change_points.h>

#include "distributions.h"

namespace plumbline::verify::history {

namespace {

using Series = std::span<const double>;

/// Half-open.
struct Stretch {
  std::size_t begin = 0, end = 0;

  std::size_t size() const { return end - begin; }
};

struct Split {
  std::size_t index = 0;
  std::size_t end = 0;  ///< of its right side
  double energy = -std::numeric_limits<double>::infinity();
};

/// Sums of distances |x_i − x_j|, so that the energy distance of any two neighbouring stretches
/// takes constant time.
class Distances {
 public:
  explicit Distances(Series series) : size_(series.size()), sums_((size_ + 1) * size_) {
    for (std::size_t j = 0; j < size_; ++j) {
      for (std::size_t i = 0; i < size_; ++i) {
        sums_[j * (size_ + 1) + i + 1] =
            sums_[j * (size_ + 1) + i] + std::abs(series[i] - series[j]);
      }
    }
  }

  /// Of value j to those of a stretch.
  double to(std::size_t j, const Stretch& stretch) const {
    return sums_[j * (size_ + 1) + stretch.end] - sums_[j * (size_ + 1) + stretch.begin];
  }

 private:
  std::size_t size_;
  std::vector<double> sums_;
};

/// Scaled energy distance of samples of n and m values.
///
/// @param between, left, right  sums of distances between and within the two
/// @source Matteson, James 2014, Eqs. 5 and 7
double energy(std::size_t n, std::size_t m, double between, double left, double right) {
  const double a = static_cast<double>(n), b = static_cast<double>(m);
  double result = 2 / (a + b) * between;
  if (n > 1) result -= 2 * b / ((a + b) * (a - 1)) * left;
  if (m > 1) result -= 2 * a / ((a + b) * (b - 1)) * right;
  return result;
}

/// The split of a stretch whose sides differ most. The right side may end before the stretch does,
/// so that a second change does not hide the first.
Split best_split(const Distances& distances, const Stretch& stretch, std::size_t min_segment) {
  Split best;
  double left = 0;
  for (std::size_t split = stretch.begin + 1; split < stretch.end; ++split) {
    left += distances.to(split - 1, {stretch.begin, split - 1});
    double between = 0, right = 0;
    for (std::size_t last = split; last < stretch.end; ++last) {
      between += distances.to(last, {stretch.begin, split});
      right += distances.to(last, {split, last});
      const std::size_t n = split - stretch.begin, m = last + 1 - split;
      if (n < min_segment || m < min_segment) continue;
      const double value = energy(n, m, between, left, right);
      if (value > best.energy) best = {split, last + 1, value};
    }
  }
  return best;
}

struct Side {
  double mean = 0, squares = 0;
};

Side side_of(Series series, const Stretch& stretch) {
  Side side;
  for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
    side.mean += series[i] / static_cast<double>(stretch.size());
  }
  for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
    side.squares += (series[i] - side.mean) * (series[i] - side.mean);
  }
  return side;
}

/// What the squared deviations of a side add to the pooled ones.
double pooled_squares(const Side& side, std::size_t count, bool as_otava) {
  if (!as_otava) return side.squares;
  return side.squares * static_cast<double>(count - 1) / static_cast<double>(count);
}

/// Student's t between the two segments that meet at an index.
ChangePoint test_split(Series series, const Stretch& around, std::size_t index,
                       const ChangePointOptions& options) {
  const Stretch before{around.begin, index}, after{index, around.end};
  const Side a = side_of(series, before), b = side_of(series, after);
  ChangePoint point;
  point.index = index;
  point.segment_begin = around.begin;
  point.segment_end = around.end;
  point.mean_before = a.mean;
  point.mean_after = b.mean;
  if (around.size() < 3) return point;
  const double degrees = static_cast<double>(around.size() - 2);
  const double squares = pooled_squares(a, before.size(), options.as_otava) +
                         pooled_squares(b, after.size(), options.as_otava);
  const double share =
      1 / static_cast<double>(before.size()) + 1 / static_cast<double>(after.size());
  point.error = std::sqrt(squares / degrees * share * options.variance_inflation);
  const double t = (b.mean - a.mean) / point.error;
  if (std::isnan(t)) return point;  // a constant series has no change
  // Correlated neighbours tell less of the variance, too.
  point.p_value = student_two_sided(t, std::max(1.0, degrees / options.variance_inflation));
  return point;
}

/// The stretch that a place lies in, between sorted change points.
Stretch stretch_around(const std::vector<std::size_t>& borders, std::size_t index,
                       const Stretch& all) {
  Stretch result = all;
  for (const std::size_t border : borders) {
    if (border < index) result.begin = std::max(result.begin, border);
    if (border > index) result.end = std::min(result.end, border);
  }
  return result;
}

std::vector<std::size_t> split_window(Series series, const ChangePointOptions& options,
                                      double max_p_value) {
  const Distances distances(series);
  const Stretch all{0, series.size()};
  std::vector<std::size_t> borders;
  for (;;) {
    Split best;
    for (std::size_t k = 0; k <= borders.size(); ++k) {
      const Stretch part{k == 0 ? all.begin : borders[k - 1],
                         k == borders.size() ? all.end : borders[k]};
      if (part.size() < 2 * options.min_segment) continue;
      const Split split = best_split(distances, part, options.min_segment);
      if (split.energy > best.energy) best = split;
    }
    if (best.index == 0) return borders;
    Stretch around = stretch_around(borders, best.index, all);
    // What comes after the right side may be a third level, which would hide the difference.
    if (!options.as_otava) around.end = best.end;
    const ChangePoint point = test_split(series, around, best.index, options);
    if (!(point.p_value <= max_p_value)) return borders;
    borders.insert(std::upper_bound(borders.begin(), borders.end(), best.index), best.index);
  }
}

/// Points of all windows, sorted. A window starts half a window after the last one, or at the last
/// point found there if that is later.
std::vector<std::size_t> split_all(Series series, const ChangePointOptions& options) {
  const double level = options.max_p_value;
  const double first_pass = level < 0.05 ? 10 * level : std::min(2 * level, 0.999);
  std::vector<std::size_t> borders;
  std::size_t start = 0;
  while (start < series.size()) {
    const std::size_t count = std::min(options.window, series.size() - start);
    std::size_t next = start + options.window / 2;
    for (const std::size_t found :
         split_window(series.subspan(start, count), options, first_pass)) {
      borders.push_back(start + found);
      next = std::max(next, start + found);
    }
    start = next;
  }
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  return borders;
}

/// Tests a point against its neighbours in the list.
void test_again(Series series, const ChangePointOptions& options, std::vector<ChangePoint>& points,
                std::size_t k) {
  const Stretch around{k == 0 ? 0 : points[k - 1].index,
                       k + 1 == points.size() ? series.size() : points[k + 1].index};
  points[k] = test_split(series, around, points[k].index, options);
}

/// The point to drop next: the least significant, and where all are significant the smallest.
std::optional<std::size_t> weakest(const std::vector<ChangePoint>& points,
                                   const ChangePointOptions& options) {
  if (points.empty()) return std::nullopt;
  const auto least = std::max_element(
      points.begin(), points.end(),
      [](const ChangePoint& a, const ChangePoint& b) { return a.p_value < b.p_value; });
  if (!(least->p_value < options.max_p_value)) {
    return static_cast<std::size_t>(least - points.begin());
  }
  if (options.min_magnitude == 0) return std::nullopt;
  const auto smallest = std::min_element(
      points.begin(), points.end(),
      [](const ChangePoint& a, const ChangePoint& b) { return a.magnitude() < b.magnitude(); });
  if (smallest->magnitude() > options.min_magnitude) return std::nullopt;
  return static_cast<std::size_t>(smallest - points.begin());
}

void check_options(Series series, const ChangePointOptions& o) {
  if (o.window < 2 || o.min_segment < 1 || !(o.max_p_value > 0 && o.max_p_value < 1) ||
      !(o.variance_inflation >= 1 && std::isfinite(o.variance_inflation)) ||
      !(o.min_magnitude >= 0)) {
    throw std::invalid_argument(
        "change points: need a window of at least 2, segments of at least 1, a p-value in (0, 1), "
        "an inflation of at least 1 and a magnitude of at least 0");
  }
  for (const double x : series) {
    if (!std::isfinite(x)) throw std::invalid_argument("change points: a value is not finite");
  }
}

}  // namespace

double ChangePoint::magnitude() const {
  if (mean_before == 0 || mean_after == 0) return 0;
  return std::max(std::abs(mean_after / mean_before - 1), std::abs(mean_before / mean_after - 1));
}

std::vector<ChangePoint> find_change_points(std::span<const double> series,
                                            const ChangePointOptions& options) {
  check_options(series, options);
  std::vector<ChangePoint> points;
  for (const std::size_t border : split_all(series, options)) {
    points.emplace_back().index = border;
  }
  for (std::size_t k = 0; k < points.size(); ++k) test_again(series, options, points, k);
  while (const std::optional<std::size_t> drop = weakest(points, options)) {
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(*drop));
    // Its neighbours have another segment beside them now.
    const std::size_t first = options.as_otava ? *drop : *drop - std::min<std::size_t>(*drop, 1);
    for (std::size_t k = first; k < std::min(first + 2, points.size()); ++k) {
      test_again(series, options, points, k);
    }
  }
  return points;
}

}  // namespace plumbline::verify::history
