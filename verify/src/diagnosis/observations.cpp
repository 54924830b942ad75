#include "diagnosis/observations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "distributions.h"
#include "pairs/differences.h"

namespace plumbline::verify {

namespace {

// Points and bins of all views that a fit looks at: at first, and in the end.
constexpr std::size_t kFewFitted = 40;
constexpr std::size_t kMostFitted = 240;
// A point at a fold of the map may give a wrong difference with a small error.
constexpr double kFoldShare = 0.007;
constexpr double kFolds = 3;
// Their errors are estimates: a few are off by several times as much, near the ends of [0, 1) and
// in float most of all, though hardly ever by what the Jacobian check itself allows.
constexpr double kCloseShare = 0.1;
// The hypothesis itself is evaluated in double.
constexpr double kOwnRounding = 1e-9;
// An admissible hypothesis that is the truth is thrown away once in so many reports.
constexpr double kLevel = 1e-4;

// What rounding of points may do to a mass is not the business of a cause; and numbers that were
// fitted to counts are known no better than these.
constexpr double kMassTolerance = 1e-4;

/// Bins below this count say little, and their normal approximation lies.
constexpr double kFewestSeen = 4;

double log_residual(const ExactPoint& p, double predicted) {
  return std::log(p.ratio) - std::log(predicted / p.place.base);
}

double error_of(const ExactPoint& p) { return p.error + kOwnRounding; }

struct BinPrediction {
  double expected = 0, error = 0;
  bool varies = false;
  bool partly = false;  ///< of some nodes nothing is said: `expected` is what the others hold
};

/// Mean of the prediction over the nodes, in units of the bin's expected count. The nodes stand for
/// the bin as strata do: their mean is better known than that of so many random points.
///
/// @param stride  between the nodes that are looked at
BinPrediction predict(const CountedBin& bin, const Prediction& prediction,
                      std::span<const double> parameters, std::size_t stride = 1) {
  double mean = 0, squares = 0, looked_at = 0;
  bool seen = false, partly = false;
  for (std::size_t i = stride / 2; i < bin.nodes.size(); i += stride) {
    looked_at += bin.shares[i];
    if (!(bin.nodes[i].base > 0)) continue;
    seen = true;
    const double predicted = prediction(bin.nodes[i], parameters);
    if (predicted == kNothingSaid) {
      partly = true;
      continue;
    }
    const double ratio = predicted / bin.nodes[i].base;
    mean += bin.shares[i] * ratio;
    squares += bin.shares[i] * ratio * ratio;
  }
  if (!seen || !(looked_at > 0)) return {bin.expected, bin.expected_error};
  mean /= looked_at;
  squares /= looked_at;
  const double spread = std::sqrt(std::max(0.0, squares - mean * mean));
  const double of_nodes =
      spread < 1e-12 * std::abs(mean) ? 0 : spread / std::sqrt(double(bin.nodes.size()));
  BinPrediction p{bin.expected * mean,
                  std::hypot(bin.expected * of_nodes, bin.expected_error * mean), of_nodes > 0,
                  partly};
  if (p.varies && !partly && stride == 1 && !bin.measures.empty()) {
    double direct = 0;
    for (std::size_t i = 0; i < bin.nodes.size(); ++i) {
      direct += bin.samples * bin.measures[i] * prediction(bin.nodes[i], parameters);
    }
    // Where the two ways to add up differ, the nodes are too few for either.
    if (std::isfinite(direct)) p.error = std::hypot(p.error, direct - p.expected);
  }
  return p;
}

/// Standard normal under the prediction. @source Freeman, Tukey 1950: the roots of Poisson counts
/// have about the same variance however small they are
double pull(const CountedBin& bin, const BinPrediction& p) {
  const double own = 2 * (std::sqrt(bin.observed + 0.375) - std::sqrt(p.expected + 0.375));
  // Error of the expected count, as the root sees it.
  const double other = p.error / std::sqrt(p.expected + 0.375);
  return own / std::hypot(1.0, other);
}

/// Sum of squares of one view's pulls against its distribution, and the worst of them.
class Pulls {
 public:
  void add(double z, double count) {
    worst_ = std::max(worst_, std::abs(z));
    if (count < kFewestSeen) return;
    // Nodes that miss what is in a bin leave a few wild pulls: capped, they count as themselves.
    sum_ += z * z;
    ++degrees_;
  }
  double worst() const { return worst_; }
  bool agree(double level) const {
    return degrees_ == 0 || chi_square_tail(sum_, degrees_) >= level;
  }

 private:
  double sum_ = 0, degrees_ = 0, worst_ = 0;
};

}  // namespace

Observations Observations::without_strays() const {
  Observations less = *this;
  for (ViewObservations& v : less.views_) v.judge_strays = false;
  return less;
}

Observations Observations::without_mass() const {
  Observations less = *this;
  for (ViewObservations& v : less.views_) v.judge_mass = false;
  return less;
}

Observations Observations::inverted() const {
  Observations turned = *this;
  for (ViewObservations& v : turned.views_) {
    v.bins.clear();
    v.edges_last.clear();
    for (ExactPoint& p : v.exact) {
      p.place.base *= p.ratio;
      p.ratio = 1 / p.ratio;
    }
  }
  return turned;
}

void Observations::prepare() {
  exact_ = bins_ = 0;
  std::vector<double> contradiction;
  for (ViewObservations& v : views_) {
    v.edges_last.resize(v.bins.size());
    std::iota(v.edges_last.begin(), v.edges_last.end(), std::size_t{0});
    std::stable_partition(v.edges_last.begin(), v.edges_last.end(),
                          [&v](std::size_t i) { return !v.bins[i].edge; });
    exact_ += v.exact.size();
    bins_ += v.bins.size();
    double sum = 0;
    for (const ExactPoint& p : v.exact) sum += std::min(1.0, std::abs(std::log(p.ratio)));
    if (!v.exact.empty()) sum /= static_cast<double>(v.exact.size());
    double of_bins = 0;
    for (const CountedBin& b : v.bins) {
      if (!b.judged) continue;
      of_bins += std::abs(std::sqrt(b.observed) - std::sqrt(b.expected)) / std::sqrt(b.expected);
    }
    if (!v.bins.empty()) sum += of_bins / static_cast<double>(v.bins.size());
    contradiction.push_back(sum);
  }
  order_.resize(views_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
    return contradiction[a] > contradiction[b];
  });
}

Fit Observations::judge(const Prediction& prediction, std::span<const double> parameters) const {
  Fit all;
  for (const std::size_t v : order_) {
    const Fit one = judge_view(v, prediction, parameters);
    all.tested += one.tested;
    all.worst = std::max(all.worst, one.worst);
    if (one.tested > 0 && !one.admissible) return all;
  }
  all.admissible = all.tested > 0;
  return all;
}

Fit Observations::judge_view(std::size_t view, const Prediction& prediction,
                             std::span<const double> numbers) const {
  Fit fit;
  // Errors of exact points are bounds rather than deviations; four times that of differences is
  // what the Jacobian check itself allows.
  constexpr double kExactPull = 4;
  const double allowed = normal_quantile(kLevel / 2 / std::max(1.0, static_cast<double>(bins_)));
  const ViewObservations& o = views_[view];
  const double exact = static_cast<double>(o.exact.size());
  const double most =
      o.missed * exact + (o.exact.size() < 100 ? 0 : std::max(kFolds, kFoldShare * exact));
  double outliers = 0, close = 0, unknown_points = 0;
  const double near = tolerance_of_differences(o.view->pair->epsilon);
  for (const ExactPoint& p : o.exact) {
    const double predicted = prediction(p.place, numbers);
    if (predicted == kNothingSaid) {
      unknown_points += 1;
      continue;
    }
    const double z = std::abs(log_residual(p, predicted)) / error_of(p);
    ++fit.tested;
    if (!(z <= kExactPull)) {
      const double off = std::abs(log_residual(p, predicted));
      // Where a ratio is far from 1 it is steep: at the border of what is sampled.
      const double steep = std::max(1.0, std::abs(std::log(p.ratio)));
      if (off <= near * steep && ++close <= kCloseShare * exact) continue;
      if (++outliers > most) return fit;
    } else {
      fit.worst = std::max(fit.worst, z / kExactPull);
    }
  }
  constexpr double kMostUnknown = 0.85;
  constexpr double kFewestKnown = 50;
  if (unknown_points > 0 &&
      (unknown_points > kMostUnknown * exact || exact - unknown_points < kFewestKnown)) {
    return fit;
  }
  if (o.judge_strays) {
    ++fit.tested;
    double explained = 0;
    for (const Vec3& x : o.view->strays) {
      explained += prediction({o.view, o.view->wo.value_or(Vec3{}), x, 0}, numbers) > 0 ? 1 : 0;
    }
    if (explained < 0.98 * static_cast<double>(o.view->strays.size())) return fit;
  }
  // Exact points lie where samples do. Bins that hold far more than expected have their nodes where
  // the pdf is, not where the samples are, and say nothing that those points do not.
  constexpr std::size_t kManyExact = 200;
  constexpr double kCrowded = 2, kPredicted = 1.5, kUneven = 0.03;
  constexpr int kOddBins = 2;      // of which no node sees the border inside
  constexpr double kLittle = 1.5;  // of one bin, by which it may be off
  const bool followed = o.exact.size() >= kManyExact && o.view->strays.empty();
  int odd = 0;
  bool unknown = false;  // what the whole holds
  Pulls pulls;
  const double n = o.view->samples;
  double total = 0, variance = 0;
  bool varies = false;
  // Bins with a border last: where a prediction varies, their nodes say little.
  for (const std::size_t i : o.edges_last) {
    const CountedBin& bin = o.bins[i];
    const BinPrediction p = predict(bin, prediction, numbers);
    if (p.partly) {
      unknown = true;
      // What is said of a part of it must be there.
      if (bin.judged && !bin.edge && pull(bin, p) < -allowed && ++odd > kOddBins) return fit;
      continue;
    }
    varies = varies || p.varies;
    total += p.expected / n;
    variance += std::pow(std::max(0.0, p.error) / n, 2);
    // By what is predicted as well: of bins that hold about twice as much, those left would be the
    // ones that hold less by chance.
    const bool crowded = followed && (bin.observed > kCrowded * bin.expected ||
                                      p.expected > kPredicted * bin.expected);
    unknown = unknown || crowded;
    if (!bin.judged || crowded || (bin.edge && varies)) continue;
    if (followed && p.error > kUneven * p.expected) continue;
    const double z = pull(bin, p);
    ++fit.tested;
    if (!(std::abs(z) <= allowed)) {
      const int most_odd = followed ? kOddBins : std::abs(z) <= kLittle * allowed ? 1 : 0;
      if (++odd > most_odd) return fit;
      continue;
    }
    pulls.add(z, p.expected);
  }
  if (!pulls.agree(kLevel / static_cast<double>(views_.size()))) return fit;
  fit.worst = std::max(fit.worst, pulls.worst() / allowed);
  // A hypothesis that explains samples outside the support moves it: nodes inside do not add up.
  unknown = unknown || (o.judge_strays && !o.view->strays.empty());
  if (o.judge_mass && !unknown) {
    const MassSeen& mass = *o.view->mass;
    // Numbers are fitted to a part of the counts; nodes are no cubature.
    constexpr double kFittedBins = 60;
    const double part =
        std::min(0.5, kFittedBins / std::max(1.0, static_cast<double>(o.bins.size())));
    const double of_fit = numbers.empty() && !varies ? 0 : 4 / std::sqrt(n * part);
    const double missing = total + mass.atoms + mass.rejected + o.view->stray_share - 1;
    const double error = mass.integral_error * total / std::max(mass.integral, 1e-300) +
                         mass.rejected_error + 4 * std::sqrt(variance) +
                         4 * std::sqrt(o.view->stray_share / n) + kMassTolerance + of_fit;
    if (!(std::abs(missing) <= error)) return fit;
  }
  fit.admissible = fit.tested > 0;
  return fit;
}

std::vector<double> Observations::residuals(const Prediction& prediction,
                                            std::span<const double> parameters, int view,
                                            bool flatten) const {
  constexpr double kFlat = 0.01;
  std::vector<double> out;
  std::size_t views = 0;
  for (const ViewObservations& o : views_) {
    if (o.exact.size() + o.bins.size() > 0) ++views;
  }
  const std::size_t all = flatten ? kFewFitted : kMostFitted;
  const std::size_t each =
      view >= 0 ? all / 2
                : std::max<std::size_t>(flatten ? 6 : 16, all / std::max(views, std::size_t{1}));
  for (std::size_t v = 0; v < views_.size(); ++v) {
    if (view >= 0 && v != static_cast<std::size_t>(view)) continue;
    const ViewObservations& o = views_[v];
    const std::size_t step = 2 * std::max<std::size_t>(1, o.exact.size() / (2 * each));
    for (std::size_t i = 0; i < o.exact.size(); i += step) {
      const double predicted = prediction(o.exact[i].place, parameters);
      const double r = predicted == kNothingSaid ? 0 : log_residual(o.exact[i], predicted);
      out.push_back(r / (flatten ? std::max(kFlat, error_of(o.exact[i])) : error_of(o.exact[i])));
    }
    const std::size_t bin_step = 2 * std::max<std::size_t>(1, o.bins.size() / (2 * each));
    for (std::size_t i = 0; i < o.bins.size(); i += bin_step) {
      if (!o.bins[i].judged || o.bins[i].edge) continue;
      const std::size_t stride = flatten && o.bins[i].nodes.size() > 8 ? 4 : 1;
      const BinPrediction p = predict(o.bins[i], prediction, parameters, stride);
      out.push_back(p.partly ? 0 : pull(o.bins[i], p));
    }
  }
  for (double& r : out) {
    if (!std::isfinite(r)) r = 1e6;
  }
  return out;
}

}  // namespace plumbline::verify
