#include "pairs/pointwise.h"

#include <algorithm>
#include <cmath>

#include <plumbline/verify/detail/stopwatch.h>
#include <numbers>

#include "diagnosis/diagnosis.h"
#include "pairs/battery.h"
#include "pairs/binned_pair.h"
#include "rounding.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr std::uint64_t kEnoughRatios = 2'000;
// Rounding errors that a formula of a few dozen operations may pile up, in units of epsilon.
constexpr double kRounding = 256;

/// Counts the points where one property holds and where not.
class Property {
 public:
  Property(const SamplingPair& pair, const ContractOptions& options, CheckKind kind) {
    outcome_.result.kind = kind;
    outcome_.result.subject = pair.name + "/" + std::string(to_string(kind));
    outcome_.result.seed = options.seed;
    outcome_.result.reference = 0;
  }

  void seen_as(RatioKind kind) { outcome_.ratios.kind = kind; }

  /// @param reason  only built where it failed
  template <class Reason>
  void hold(bool holds, const Reason& reason) {
    ++tested_;
    if (holds) return;
    if (failed_++ == 0) outcome_.result.reason = reason();
  }

  /// @param error  relative, only asked for where it is kept
  template <class Error>
  void ratio(const Vec3& x, double value, const Error& error) {
    if (outcome_.ratios.points.size() < kEnoughRatios)
      outcome_.ratios.points.push_back({x, value, error()});
  }

  void deviation(double relative) {
    if (!(relative <= worst_)) worst_ = relative;
  }

  bool tested() const { return tested_ > 0; }

  PointwiseOutcome finish() {
    CheckResult& r = outcome_.result;
    r.samples = tested_;
    r.verdict = failed_ == 0 ? Verdict::pass : Verdict::fail;
    if (failed_ > 0) {
      r.reason += " (" + number(failed_) + " of " + number(tested_) + " points fail)";
    }
    r.estimate = r.bound = worst_;
    r.leaned_on = "points tested";
    return std::move(outcome_);
  }

 private:
  PointwiseOutcome outcome_;
  std::uint64_t tested_ = 0, failed_ = 0;
  double worst_ = 0;
};

bool all_finite(const Vec3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

bool all_finite(const Channels& c) {
  return std::all_of(c.value.begin(), c.value.begin() + static_cast<std::ptrdiff_t>(c.count),
                     [](double v) { return std::isfinite(v); });
}

std::string of_u(const Uniforms& u, int numbers) {
  std::string text = "u = (";
  for (int i = 0; i < numbers; ++i) {
    text += (i > 0 ? ", " : "") + number(u[static_cast<std::size_t>(i)]);
  }
  return text + ")";
}

class Pointwise {
 public:
  Pointwise(const SamplingPair& pair, const ContractOptions& options)
      : pair_(pair),
        random_(random_for(options.seed, Stream::pointwise)),
        record_(pair, options, CheckKind::record_pdf),
        weight_(pair, options, CheckKind::weight),
        support_(pair, options, CheckKind::support),
        finite_(pair, options, CheckKind::finite),
        discrete_(pair.domain.dimension() == 0) {
    record_.seen_as(RatioKind::record_over_pdf);
    weight_.seen_as(RatioKind::weight_over_value);
  }

  std::vector<PointwiseOutcome> run(int points) {
    for (int i = 0; i < points; ++i) see(pair_.next(random_), nullptr);
    if (pair_.sample && !pair_.draw) see_corners();
    see_domain(points);
    std::vector<PointwiseOutcome> outcomes;
    for (Property* p : {&record_, &weight_, &support_, &finite_}) {
      if (p->tested()) outcomes.push_back(p->finish());
    }
    // They look at the same points: each gets its share of the time.
    const double share = watch_.seconds() / static_cast<double>(outcomes.size());
    for (PointwiseOutcome& outcome : outcomes) outcome.result.seconds = share;
    return outcomes;
  }

 private:
  /// u at, near and away from the corners of the unit square.
  void see_corners() {
    const double last = 1 - pair_.epsilon;
    const std::vector<double> values = {0, pair_.epsilon, 1e-6, 0.25, 0.5, 0.75, 1 - 1e-6, last};
    const auto second = pair_.numbers >= 2 ? values : std::vector<double>{0};
    for (const double a : values) {
      for (const double b : second) {
        const Uniforms u{a, b, 0.5};
        see(pair_.sample(u), &u);
      }
    }
  }

  /// Density and value anywhere in the domain, and close to where samples fall.
  void see_domain(int points) {
    if (discrete_) return;
    for (int i = 0; i < points; ++i) {
      const Vec3 x = pair_.domain.chart().from_square({random_.uniform(), random_.uniform()});
      see_density(x);
      const auto sample = pair_.next(random_);
      if (!sample || sample->mass > 0 || !all_finite(sample->x)) continue;
      const double distance = std::exp2(-20 * random_.uniform());
      const Vec3 y =
          pair_.domain.chart().near(sample->x, distance, 2 * std::numbers::pi * random_.uniform());
      if (pair_.domain.chart().distance(y) == 0) see_density(y);
    }
  }

  void see_density(const Vec3& x) {
    const double pdf = pair_.pdf(x);
    finite_.hold(pdf >= 0 && std::isfinite(pdf),
                 [&] { return "pdf is " + number(pdf) + " at " + place(x); });
    if (!pair_.value) return;
    const Channels value = pair_.value(x);
    finite_.hold(all_finite(value), [&] { return "f is not finite at " + place(x); });
    double largest = 0;
    for (std::size_t c = 0; c < value.count; ++c) largest = std::max(largest, std::abs(value[c]));
    if (largest == 0) return;
    support_.hold(pdf > 0 || positive_near(pair_, x), [&] {
      return "pdf is 0 where f·|cosθ| is " + number(largest) + ", at " + place(x);
    });
  }

  void see(const std::optional<SampleRecord>& sample, const Uniforms* corner) {
    if (!sample) return;
    const Vec3& x = sample->x;
    const auto where = [&] {
      return corner ? place(x) + ", " + of_u(*corner, pair_.numbers) : place(x);
    };
    finite_.hold(all_finite(x) && all_finite(sample->weight),
                 [&] { return "sample or weight is not finite at " + where(); });
    if (!all_finite(x)) return;
    support_.hold(in_domain(x), [&] { return "sample outside the domain at " + where(); });
    if (sample->mass > 0) {
      see_atom(*sample);
      return;
    }
    const double pdf = pair_.pdf(x);
    finite_.hold(pdf >= 0 && std::isfinite(pdf),
                 [&] { return "pdf is " + number(pdf) + " at " + where(); });
    support_.hold(pdf > 0 || !(pdf == 0) || (!discrete_ && positive_near(pair_, x)),
                  [&] { return "pdf is 0 at a sample, " + where(); });
    see_record(*sample, pdf, where);
    see_weight(*sample, pdf, where);
  }

  bool in_domain(const Vec3& x) const {
    if (discrete_) {
      return x[0] >= 0 && x[0] < static_cast<double>(pair_.domain.size()) &&
             x[0] == std::floor(x[0]);
    }
    return pair_.domain.chart().distance(x) <= kRounding * pair_.epsilon;
  }

  void see_atom(const SampleRecord& sample) {
    record_.hold(!sample.pdf || *sample.pdf == 0, [&] {
      return "an atom at " + place(sample.x) + " is given a density, " + number(*sample.pdf);
    });
    record_.hold(sample.mass <= 1 + 64 * pair_.epsilon,
                 [&] { return "an atom has mass " + number(sample.mass); });
  }

  template <class Where>
  void see_record(const SampleRecord& sample, double pdf, const Where& where) {
    if (!sample.pdf) return;
    const double stated = *sample.pdf;
    const bool agrees = agree(stated, pdf, sample.x, pair_.pdf);
    record_.hold(agrees, [&] {
      return "the record states pdf " + number(stated) + ", pdf() gives " + number(pdf) + " at " +
             where();
    });
    record_.ratio(sample.x, stated / pdf,
                  [&] { return rounding_of(sample.x, pair_.pdf) + kRounding * pair_.epsilon; });
    if (pdf > 0) record_.deviation(std::abs(stated / pdf - 1));
  }

  template <class Where>
  void see_weight(const SampleRecord& sample, double pdf, const Where& where) {
    if (sample.weight.count == 0 || !pair_.value) return;
    const Channels value = pair_.value(sample.x);
    double largest = 0;
    for (std::size_t c = 0; c < value.count; ++c) largest = std::max(largest, std::abs(value[c]));
    bool agrees = sample.weight.count == value.count;
    for (std::size_t c = 0; c < value.count && agrees; ++c) {
      const auto of_channel = [&](const Vec3& x) { return pair_.value(x)[c]; };
      const double product = sample.weight[c] * pdf;
      agrees = agree(product, value[c], sample.x, of_channel) ||
               agree(product, value[c], sample.x,
                     [&](const Vec3& x) { return sample.weight[c] * pair_.pdf(x); });
      if (value[c] == largest && largest > 0) {
        weight_.ratio(sample.x, product / value[c], [&] {
          return rounding_of(sample.x, of_channel) + rounding_of(sample.x, pair_.pdf) +
                 kRounding * pair_.epsilon;
        });
        if (agrees) weight_.deviation(std::abs(product / value[c] - 1));
      }
    }
    weight_.hold(agrees, [&] {
      return "weight · pdf differs from f·|cosθ|, e.g. " + number(sample.weight[0] * pdf) +
             " against " + number(value[0]) + " at " + where();
    });
  }

  /// What rounding of the point that f is asked at may change, relative.
  template <class F>
  double rounding_of(const Vec3& x, const F& f) const {
    if (discrete_) return 0;
    const double here = f(x);
    double spread = 0;
    for (int k = 0; k < 4; ++k) {
      const double angle = k * std::numbers::pi / 2;
      const Vec3 beside = pair_.domain.chart().near(x, 8 * pair_.epsilon, angle);
      spread = std::max(spread, std::abs(f(beside) / here - 1));
    }
    return std::isfinite(spread) ? spread : 1.0;
  }

  /// Equal up to rounding: of the numbers themselves, or of the point that f is asked at.
  template <class F>
  bool agree(double a, double b, const Vec3& x, const F& f) const {
    return equal_up_to_rounding(a, b, pair_.epsilon, [&] {
      double spread = 0;
      for (int k = 0; k < 4 && !discrete_; ++k) {
        const double angle = k * std::numbers::pi / 2;
        const Vec3 beside = pair_.domain.chart().near(x, 8 * pair_.epsilon, angle);
        spread = std::max(spread, std::abs(f(beside) - f(x)));
      }
      return 16 * spread;
    });
  }

  const SamplingPair& pair_;
  const Stopwatch watch_;
  Random random_;
  Property record_, weight_, support_, finite_;
  bool discrete_;
};

}  // namespace

std::vector<PointwiseOutcome> judge_pointwise(const SamplingPair& pair,
                                              const ContractOptions& options) {
  return Pointwise(pair, options).run(options.points);
}

Report check_pointwise(const SamplingPair& pair, const ContractOptions& options) {
  Report report;
  ViewEvidence view;
  view.pair = &pair;
  for (PointwiseOutcome& outcome : judge_pointwise(pair, options)) {
    view.failed = view.failed || outcome.result.verdict == Verdict::fail;
    if (!outcome.ratios.points.empty()) view.ratios.push_back(std::move(outcome.ratios));
    report.results.push_back(std::move(outcome.result));
  }
  if (view.failed) name_cause(diagnose({{std::move(view)}, {}, {}}), report);
  return report;
}

}  // namespace plumbline::verify
