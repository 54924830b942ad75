#include "pairs/pointwise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/detail/stopwatch.h>

#include "diagnosis/diagnosis.h"
#include "pairs/batches.h"
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

  /// @param channel  that it is one of, where it is of a colour
  void ratio(const Vec3& x, double value, std::size_t channel = 0) {
    if (outcome_.ratios.points.size() >= kEnoughRatios) return;
    outcome_.ratios.points.push_back({x, value, 0});
    channels_.push_back(channel);
  }

  const std::vector<RatioAt>& ratios() const { return outcome_.ratios.points; }
  const std::vector<std::size_t>& channels() const { return channels_; }

  /// @param errors  of the ratios, relative
  void add_errors(const std::vector<double>& errors) {
    for (std::size_t i = 0; i < errors.size(); ++i) {
      outcome_.ratios.points[i].error += errors[i];
    }
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
  std::vector<std::size_t> channels_;  // of the ratios
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
    const auto see_samples = [&](std::span<const Record> samples) { see(samples); };
    draw_in_batches(pair_, random_, static_cast<std::uint64_t>(points), see_samples);
    if (pair_.sample && !pair_.draw) see_corners();
    if (!discrete_) see_domain(static_cast<std::size_t>(points));
    add_errors_of_ratios();
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
    std::vector<Uniforms> corners;
    for (const double a : values) {
      for (const double b : second) corners.push_back({a, b, 0.5});
    }
    see(ask(pair_.sample, corners), corners);
  }

  /// Density and value anywhere in the domain, and close to where samples fall.
  void see_domain(std::size_t points) {
    const Chart& chart = pair_.domain.chart();
    std::vector<Vec3> anywhere(points);
    for (Vec3& x : anywhere) x = chart.from_square({random_.uniform(), random_.uniform()});
    see_densities(anywhere);
    std::vector<Vec3> sampled, beside;
    draw_in_batches(pair_, random_, points, [&](std::span<const Record> samples) {
      for (const Record& sample : samples) {
        if (has_density(sample)) sampled.push_back(sample->x);
      }
    });
    for (const Vec3& x : sampled) {
      const double distance = std::exp2(-20 * random_.uniform());
      const Vec3 y = chart.near(x, distance, 2 * std::numbers::pi * random_.uniform());
      if (chart.distance(y) == 0) beside.push_back(y);
    }
    see_densities(beside);
  }

  void see_densities(const std::vector<Vec3>& points) {
    const std::vector<double> densities = ask(pair_.pdf, points);
    const std::vector<Channels> values =
        pair_.value ? ask(pair_.value, points) : std::vector<Channels>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      see_density(points[i], densities[i], values[i]);
    }
  }

  void see_density(const Vec3& x, double pdf, const Channels& value) {
    finite_.hold(pdf >= 0 && std::isfinite(pdf),
                 [&] { return "pdf is " + number(pdf) + " at " + place(x); });
    if (!pair_.value) return;
    finite_.hold(all_finite(value), [&] { return "f is not finite at " + place(x); });
    double largest = 0;
    for (std::size_t c = 0; c < value.count; ++c) largest = std::max(largest, std::abs(value[c]));
    if (largest == 0) return;
    support_.hold(pdf > 0 || positive_near(pair_, x), [&] {
      return "pdf is 0 where f·|cosθ| is " + number(largest) + ", at " + place(x);
    });
  }

  static bool has_density(const Record& sample) {
    return sample && !(sample->mass > 0) && all_finite(sample->x);
  }

  bool has_weight(const SampleRecord& sample) const {
    return sample.weight.count > 0 && pair_.value;
  }

  /// @param corners  the random numbers of each, where they are told
  void see(std::span<const Record> samples, std::span<const Uniforms> corners = {}) {
    std::vector<Vec3> points, weighed;
    for (const Record& sample : samples) {
      if (!has_density(sample)) continue;
      points.push_back(sample->x);
      if (has_weight(*sample)) weighed.push_back(sample->x);
    }
    const std::vector<double> densities = ask(pair_.pdf, points);
    const std::vector<Channels> values =
        weighed.empty() ? std::vector<Channels>() : ask(pair_.value, weighed);
    std::size_t density = 0, value = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Record& sample = samples[i];
      if (!sample) continue;
      const auto where = [&] {
        const std::string at = place(sample->x);
        return corners.empty() ? at : at + ", " + of_u(corners[i], pair_.numbers);
      };
      see_point(*sample, where);
      if (!has_density(sample)) continue;
      const double pdf = densities[density++];
      see_pdf(*sample, pdf, where);
      if (has_weight(*sample)) see_weight(*sample, pdf, values[value++], where);
    }
  }

  template <class Where>
  void see_point(const SampleRecord& sample, const Where& where) {
    finite_.hold(all_finite(sample.x) && all_finite(sample.weight),
                 [&] { return "sample or weight is not finite at " + where(); });
    if (!all_finite(sample.x)) return;
    support_.hold(in_domain(sample.x), [&] { return "sample outside the domain at " + where(); });
    if (sample.mass > 0) see_atom(sample);
  }

  template <class Where>
  void see_pdf(const SampleRecord& sample, double pdf, const Where& where) {
    finite_.hold(pdf >= 0 && std::isfinite(pdf),
                 [&] { return "pdf is " + number(pdf) + " at " + where(); });
    support_.hold(pdf > 0 || !(pdf == 0) || (!discrete_ && positive_near(pair_, sample.x)),
                  [&] { return "pdf is 0 at a sample, " + where(); });
    see_record(sample, pdf, where);
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
    record_.ratio(sample.x, stated / pdf);
    if (pdf > 0) record_.deviation(std::abs(stated / pdf - 1));
  }

  template <class Where>
  void see_weight(const SampleRecord& sample, double pdf, const Channels& value,
                  const Where& where) {
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
        weight_.ratio(sample.x, product / value[c], c);
        if (agrees) weight_.deviation(std::abs(product / value[c] - 1));
      }
    }
    weight_.hold(agrees, [&] {
      return "weight · pdf differs from f·|cosθ|, e.g. " + number(sample.weight[0] * pdf) +
             " against " + number(value[0]) + " at " + where();
    });
  }

  /// What rounding of the points that pdf() and value are asked at may change.
  void add_errors_of_ratios() {
    const auto density = [](double pdf, std::size_t) { return pdf; };
    record_.add_errors(roundings(record_.ratios(), pair_.pdf, density));
    weight_.add_errors(roundings(weight_.ratios(), pair_.pdf, density));
    if (!weight_.ratios().empty()) {
      weight_.add_errors(roundings(
          weight_.ratios(), pair_.value,
          [&](const Channels& value, std::size_t i) { return value[weight_.channels()[i]]; }));
    }
    for (Property* p : {&record_, &weight_}) {
      p->add_errors(std::vector<double>(p->ratios().size(), kRounding * pair_.epsilon));
    }
  }

  /// Of each point, relative.
  ///
  /// @param number_of  the number that counts, of what f gives at a point, and of which point
  template <class R, class NumberOf>
  std::vector<double> roundings(const std::vector<RatioAt>& ratios, const Many<R(Vec3)>& f,
                                const NumberOf& number_of) const {
    std::vector<double> spreads(ratios.size(), 0.0);
    if (discrete_) return spreads;
    constexpr std::size_t kSides = 4;
    std::vector<Vec3> points;
    for (const RatioAt& r : ratios) {
      points.push_back(r.x);
      for (std::size_t k = 0; k < kSides; ++k) points.push_back(beside(r.x, k));
    }
    const std::vector<R> values = ask(f, points);
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      const auto at = [&](std::size_t k) { return number_of(values[(kSides + 1) * i + k], i); };
      for (std::size_t k = 1; k <= kSides; ++k) {
        spreads[i] = std::max(spreads[i], std::abs(at(k) / at(0) - 1));
      }
      if (!std::isfinite(spreads[i])) spreads[i] = 1;
    }
    return spreads;
  }

  /// A neighbour within rounding, in one of four directions.
  Vec3 beside(const Vec3& x, std::size_t side) const {
    const double angle = static_cast<double>(side) * std::numbers::pi / 2;
    return pair_.domain.chart().near(x, 8 * pair_.epsilon, angle);
  }

  /// Equal up to rounding: of the numbers themselves, or of the point that f is asked at.
  template <class F>
  bool agree(double a, double b, const Vec3& x, const F& f) const {
    return equal_up_to_rounding(a, b, pair_.epsilon, [&] {
      double spread = 0;
      for (std::size_t k = 0; k < 4 && !discrete_; ++k) {
        spread = std::max(spread, std::abs(f(beside(x, k)) - f(x)));
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
