#include "diagnosis/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::verify {

namespace {

using Doubles = std::vector<double>;

double squares(const Doubles& residuals) {
  double sum = 0;
  for (const double r : residuals) sum += r * r;
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::max();
}

/// A few ratios may be those of a seam, wrong and sure of themselves.
constexpr double kFarShare = 0.06;

/// Of all but the few that are farthest off.
double squares_of_most(Doubles residuals) {
  for (double& r : residuals) r = std::abs(r);
  std::sort(residuals.begin(), residuals.end());
  residuals.resize(residuals.size() -
                   static_cast<std::size_t>(kFarShare * double(residuals.size())));
  return squares(residuals);
}

/// Which are far beyond the middle one, if they are few: the others then decide.
std::vector<bool> far_off(const Doubles& residuals) {
  constexpr double kBeyond = 50;
  Doubles sizes;
  for (const double r : residuals) sizes.push_back(std::abs(r));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  if (!sizes.empty()) std::nth_element(sizes.begin(), middle, sizes.end());
  std::vector<bool> far;
  for (const double r : residuals) far.push_back(std::abs(r) > kBeyond * std::max(1.0, *middle));
  const auto count = static_cast<double>(std::count(far.begin(), far.end(), true));
  if (count > kFarShare * static_cast<double>(far.size())) far.assign(far.size(), false);
  return far;
}

class LeastSquares {
 public:
  LeastSquares(const Observations& observations, const Prediction& prediction, int view)
      : observations_(observations), prediction_(prediction), view_(view) {}

  Doubles residuals(const Doubles& p, bool flatten) const {
    Doubles all = observations_.residuals(prediction_, p, view_, flatten);
    if (!flatten && ignored_.size() == all.size()) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (ignored_[i]) all[i] = 0;
      }
    }
    return all;
  }

  /// From here on, what is far off at p is left aside. Whether that is something else than before.
  bool ignore_far_off(const Doubles& p) {
    std::vector<bool> far = far_off(observations_.residuals(prediction_, p, view_, false));
    if (far == ignored_) return false;
    ignored_ = std::move(far);
    return true;
  }

  Doubles descend(Doubles p, bool flatten, int most) const {
    constexpr double kGaveUp = 1e7, kHopeless = 500;
    double damping = 1e-3;
    Doubles r = residuals(p, flatten);
    double cost = squares(r);
    std::vector<Doubles> slopes = derivatives(p, flatten);
    for (int step = 0; step < most && damping < kGaveUp && !r.empty(); ++step) {
      std::vector<Doubles> normal(p.size(), Doubles(p.size()));
      Doubles right(p.size());
      for (std::size_t i = 0; i < p.size(); ++i) {
        for (std::size_t j = 0; j < p.size(); ++j) {
          for (std::size_t k = 0; k < r.size(); ++k) normal[i][j] += slopes[i][k] * slopes[j][k];
        }
        for (std::size_t k = 0; k < r.size(); ++k) right[i] -= slopes[i][k] * r[k];
        normal[i][i] *= 1 + damping;
      }
      Doubles moved = solve_definite(normal, right);
      double largest = 0;
      for (std::size_t i = 0; i < p.size(); ++i) {
        largest = std::max(largest, std::abs(moved[i]));
        moved[i] += p[i];
      }
      Doubles then = residuals(moved, flatten);
      const double lower = squares(then);
      if (lower < cost) {
        // What stays far off without getting nearer fast is no cause: most hypotheses end here.
        const bool hopeless = flatten && step >= 2 && lower > 0.5 * cost &&
                              lower > kHopeless * static_cast<double>(r.size());
        const bool settled = hopeless || lower > (1 - 1e-6) * cost || largest < 1e-14;
        p = std::move(moved);
        r = std::move(then);
        cost = lower;
        damping /= 10;
        if (settled) break;
        slopes = derivatives(p, flatten);
      } else {
        if (largest < 1e-14) break;
        damping *= 10;
      }
    }
    return p;
  }

 private:
  std::vector<Doubles> derivatives(const Doubles& p, bool flatten) const {
    // At the limb of a light a ratio turns within 1e-9 of a number. Residuals are known to far less
    // of their errors than such a step changes; first steps look farther.
    const double step = flatten ? 1e-6 : 1e-9;
    std::vector<Doubles> slopes;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double h = step * std::max(1.0, std::abs(p[i]));
      Doubles above = p, below = p;
      above[i] += h;
      below[i] -= h;
      Doubles a = residuals(above, flatten);
      const Doubles b = residuals(below, flatten);
      for (std::size_t k = 0; k < a.size(); ++k) a[k] = (a[k] - b[k]) / (2 * h);
      slopes.push_back(std::move(a));
    }
    return slopes;
  }

  const Observations& observations_;
  const Prediction& prediction_;
  int view_;
  std::vector<bool> ignored_;
};

}  // namespace

std::vector<double> solve_definite(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t r = i + 1; r < n; ++r) {
      const double factor = a[i][i] != 0 ? a[r][i] / a[i][i] : 0;
      for (std::size_t c = i; c < n; ++c) a[r][c] -= factor * a[i][c];
      b[r] -= factor * b[i];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t c = i + 1; c < n; ++c) b[i] -= a[i][c] * b[c];
    b[i] = a[i][i] != 0 ? b[i] / a[i][i] : 0;
  }
  return b;
}

std::vector<double> fit_parameters(const Observations& observations, const Prediction& prediction,
                                   const std::vector<std::vector<double>>& starts, int view) {
  LeastSquares problem(observations, prediction, view);
  // Exact ratios make a valley so narrow that only the right start lies in it; as if known to a
  // percent, it is wide.
  Doubles best = starts.front();
  double lowest = std::numeric_limits<double>::max();
  for (const Doubles& start : starts) {
    const double cost = squares(problem.residuals(start, true));
    if (cost < lowest) {
      lowest = cost;
      best = start;
    }
  }
  // What is not even near by then is not the cause, however well it could be fitted.
  constexpr double kNear = 50;
  best = problem.descend(std::move(best), true, 25);
  const Doubles left = problem.residuals(best, true);
  if (squares_of_most(left) > kNear * static_cast<double>(left.size())) return best;
  // Once more from there: what is far off is known better, and steep points come into their own.
  for (int round = 0; round < 2; ++round) {
    if (!problem.ignore_far_off(best) && round > 0) break;
    best = problem.descend(std::move(best), false, 25);
  }
  return best;
}

}  // namespace plumbline::verify
