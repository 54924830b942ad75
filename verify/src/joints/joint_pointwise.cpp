#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/detail/stopwatch.h>

#include "joints/cube.h"
#include "joints/joint_bins.h"
#include "joints/joint_checks.h"
#include "pairs/batches.h"
#include "rounding.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

// Rounding errors that a formula of a few dozen operations may pile up, in units of epsilon.
constexpr double kPiledUp = 256;
constexpr int kCorners = 2'000;

/// Counts the points where one property holds and where not.
class JointProperty {
 public:
  JointProperty(const JointPair& pair, const ContractOptions& options, CheckKind kind) {
    result_.kind = kind;
    result_.subject = pair.name + "/" + std::string(to_string(kind));
    result_.seed = options.seed;
    result_.reference = 0;
    result_.leaned_on = "points tested";
  }

  /// @param reason  only built where it failed first
  template <class Reason>
  void hold(bool holds, const Reason& reason) {
    ++result_.samples;
    if (holds) return;
    if (failed_++ == 0) result_.reason = reason();
  }

  void deviation(double relative) {
    if (!(relative <= worst_)) worst_ = relative;
  }

  bool tested() const { return result_.samples > 0; }

  CheckResult finish() {
    result_.verdict = failed_ == 0 ? Verdict::pass : Verdict::fail;
    if (failed_ > 0) {
      result_.reason += " (" + number(failed_) + " of " + number(result_.samples) + " points fail)";
    }
    result_.estimate = result_.bound = worst_;
    return std::move(result_);
  }

 private:
  CheckResult result_;
  std::uint64_t failed_ = 0;
  double worst_ = 0;
};

bool finite_channels(const Channels& c) {
  return std::all_of(c.value.begin(), c.value.begin() + static_cast<std::ptrdiff_t>(c.count),
                     [](double v) { return std::isfinite(v); });
}

double largest_of(const Channels& c) {
  double largest = 0;
  for (std::size_t i = 0; i < c.count; ++i) largest = std::max(largest, std::abs(c[i]));
  return largest;
}

class JointPointwise {
 public:
  JointPointwise(const JointPair& pair, const ContractOptions& options)
      : pair_(pair),
        cube_(pair.domain),
        random_(random_for(options.seed, Stream::joint_points)),
        record_(pair, options, CheckKind::record_pdf),
        weight_(pair, options, CheckKind::weight),
        support_(pair, options, CheckKind::support),
        finite_(pair, options, CheckKind::finite) {}

  std::vector<CheckResult> run(std::size_t points) {
    draw_joint(pair_, random_, points, [&](std::span<const MaybeJoint> s) { see(s); });
    if (pair_.sample) see_corners();
    see_domain(points);
    std::vector<CheckResult> results;
    for (JointProperty* p : {&record_, &weight_, &support_, &finite_}) {
      if (p->tested()) results.push_back(p->finish());
    }
    // They look at the same points: each gets its share of the time.
    const double share = watch_.seconds() / static_cast<double>(results.size());
    for (CheckResult& r : results) r.seconds = share;
    return results;
  }

 private:
  /// Random numbers of which each is at, near or away from the end of its range.
  void see_corners() {
    const double last = 1 - pair_.epsilon;
    const std::array ends{0.0, pair_.epsilon, 1e-6, 0.25, 0.5, 0.75, 1 - 1e-6, last};
    std::vector<JointUniforms> corners(kCorners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t d = 0; d < static_cast<std::size_t>(pair_.numbers); ++d) {
        // The first are all at one end; every pair of numbers meets every pair of ends.
        corners[i][d] = i < ends.size() ? ends[i] : ends[random_.bits() >> 61];
      }
    }
    see(ask(pair_.sample, corners));
  }

  /// Density and value anywhere in the domain, and close to where samples fall.
  void see_domain(std::size_t points) {
    std::vector<JointPoint> anywhere(points);
    for (JointPoint& x : anywhere) {
      CubePoint p{0.5, 0.5, 0.5, 0.5};
      for (std::size_t d = 0; d < cube_.dimension(); ++d) p[d] = random_.uniform();
      x = cube_.from_cube(p);
    }
    see_densities(anywhere);
    std::vector<JointPoint> beside;
    draw_joint(pair_, random_, points, [&](std::span<const MaybeJoint> samples) {
      for (const MaybeJoint& s : samples) {
        if (!s || !all_finite(s->x)) continue;
        const double distance = std::exp2(-20 * random_.uniform());
        std::array<double, kMostDimensions> angles{};
        for (double& angle : angles) angle = 2 * std::numbers::pi * random_.uniform();
        const JointPoint y = cube_.near(s->x, distance, angles);
        if (cube_.distance(y) == 0) beside.push_back(y);
      }
    });
    see_densities(beside);
  }

  void see_densities(const std::vector<JointPoint>& points) {
    const std::vector<double> densities = ask(pair_.pdf, points);
    const std::vector<Channels> values =
        pair_.value ? ask(pair_.value, points) : std::vector<Channels>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double pdf = densities[i];
      const JointPoint& x = points[i];
      finite_.hold(pdf >= 0 && std::isfinite(pdf),
                   [&] { return "pdf is " + number(pdf) + " at " + place(pair_, x); });
      if (!pair_.value) continue;
      finite_.hold(finite_channels(values[i]),
                   [&] { return "the value is not finite at " + place(pair_, x); });
      const double value = largest_of(values[i]);
      if (value == 0) continue;
      support_.hold(pdf > 0 || positive_near(pair_, cube_, x), [&] {
        return "pdf is 0 where the value is " + number(value) + ", at " + place(pair_, x);
      });
    }
  }

  void see(std::span<const MaybeJoint> samples) {
    std::vector<const JointRecord*> records;
    std::vector<JointPoint> points;
    for (const MaybeJoint& sample : samples) {
      if (!sample) continue;
      const JointPoint& x = sample->x;
      finite_.hold(all_finite(x) && finite_channels(sample->weight),
                   [&] { return "sample or weight is not finite at " + place(pair_, x); });
      if (!all_finite(x)) continue;
      support_.hold(cube_.distance(x) <= kPiledUp * pair_.epsilon,
                    [&] { return "sample outside the domain at " + place(pair_, x); });
      records.push_back(&*sample);
      points.push_back(x);
    }
    const std::vector<double> densities = ask(pair_.pdf, points);
    const std::vector<Channels> values =
        pair_.value ? ask(pair_.value, points) : std::vector<Channels>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) see_pdf(*records[i], densities[i], values[i]);
  }

  void see_pdf(const JointRecord& sample, double pdf, const Channels& value) {
    const JointPoint& x = sample.x;
    finite_.hold(pdf >= 0 && std::isfinite(pdf),
                 [&] { return "pdf is " + number(pdf) + " at " + place(pair_, x); });
    support_.hold(pdf != 0 || positive_near(pair_, cube_, x),
                  [&] { return "pdf is 0 at a sample, " + place(pair_, x); });
    if (sample.pdf) {
      record_.hold(agree(*sample.pdf, pdf, x, pair_.pdf), [&] {
        return "the record states pdf " + number(*sample.pdf) + ", pdf() gives " + number(pdf) +
               " at " + place(pair_, x);
      });
      if (pdf > 0) record_.deviation(std::abs(*sample.pdf / pdf - 1));
    }
    if (sample.weight.count > 0 && pair_.value) see_weight(sample, pdf, value);
  }

  void see_weight(const JointRecord& sample, double pdf, const Channels& value) {
    const double largest = largest_of(value);
    bool agrees = sample.weight.count == value.count;
    for (std::size_t c = 0; c < value.count && agrees; ++c) {
      const double weight = sample.weight[c], product = weight * pdf;
      agrees = agree(product, value[c], sample.x,
                     [&](const JointPoint& x) { return pair_.value(x)[c]; }) ||
               agree(product, value[c], sample.x,
                     [&](const JointPoint& x) { return weight * pair_.pdf(x); });
      if (agrees && value[c] == largest && largest > 0) {
        weight_.deviation(std::abs(product / value[c] - 1));
      }
    }
    weight_.hold(agrees, [&] {
      return "weight · pdf differs from the value, e.g. " + number(sample.weight[0] * pdf) +
             " against " + number(value[0]) + " at " + place(pair_, sample.x);
    });
  }

  /// Equal up to rounding: of the numbers themselves, or of the point that f is asked at.
  template <class F>
  bool agree(double a, double b, const JointPoint& x, const F& f) const {
    return equal_up_to_rounding(a, b, pair_.epsilon, [&] {
      double spread = 0;
      for (std::size_t way = 0; way < cube_.ways(); ++way) {
        spread = std::max(spread, std::abs(f(cube_.near(x, 8 * pair_.epsilon, way)) - f(x)));
      }
      return 16 * spread;
    });
  }

  const JointPair& pair_;
  const Cube cube_;
  const Stopwatch watch_;
  Random random_;
  JointProperty record_, weight_, support_, finite_;
};

}  // namespace

std::vector<CheckResult> judge_joint_pointwise(const JointPair& pair,
                                               const ContractOptions& options) {
  return JointPointwise(pair, options).run(static_cast<std::size_t>(options.points));
}

Report check_pointwise(const JointPair& pair, const ContractOptions& options) {
  require_usable(pair, options);
  return Report(judge_joint_pointwise(pair, options));
}

}  // namespace plumbline::verify
