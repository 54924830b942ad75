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
#include "pairs/property.h"
#include "rounding.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

// Rounding errors that a formula of a few dozen operations may pile up, in units of epsilon.
constexpr double kRounding = 256;

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
  static constexpr std::size_t kSides = 4;

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
    std::vector<Vec3> unseen;
    for (std::size_t i = 0; i < points.size(); ++i) {
      see_density(points[i], densities[i], values[i]);
      if (!(densities[i] > 0) && largest_of(values[i]) > 0) unseen.push_back(points[i]);
    }
    const std::vector<bool> rounded = positive_near(pair_, unseen);
    for (std::size_t i = 0; i < unseen.size(); ++i) {
      support_.hold(rounded[i], [&] {
        return "pdf is 0 where f·|cosθ| is " + number(largest_of(pair_.value(unseen[i]))) +
               ", at " + place(unseen[i]);
      });
    }
  }

  static double largest_of(const Channels& value) {
    double largest = 0;
    for (std::size_t c = 0; c < value.count; ++c) largest = std::max(largest, std::abs(value[c]));
    return largest;
  }

  /// But for a density that is 0 beside a value.
  void see_density(const Vec3& x, double pdf, const Channels& value) {
    finite_.hold(pdf >= 0 && std::isfinite(pdf),
                 [&] { return "pdf is " + number(pdf) + " at " + place(x); });
    if (!pair_.value) return;
    finite_.hold(all_finite(value), [&] { return "f is not finite at " + place(x); });
    if (pdf > 0 && largest_of(value) > 0) support_.hold(true, [] { return std::string(); });
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
    const std::vector<Spread> spreads = spreads_of(samples, densities, values);
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
      const Spread& spread = spreads[density];
      const double pdf = densities[density++];
      see_pdf(*sample, pdf, spread, where);
      if (has_weight(*sample)) see_weight(*sample, pdf, values[value++], spread, where);
    }
  }

  /// Largest changes of the density and the value within rounding of a point.
  struct Spread {
    bool positive_near = false;  ///< of a density that is 0
    double pdf = 0;
    Channels value{};
  };

  /// Of the samples with a density: 0 where nothing that they state differs.
  std::vector<Spread> spreads_of(std::span<const Record> samples,
                                 const std::vector<double>& densities,
                                 const std::vector<Channels>& values) const {
    std::vector<Spread> spreads(densities.size());
    std::vector<std::size_t> differing, weighed, zero;
    std::vector<Vec3> around, around_weighed, points_of_zero;
    std::size_t density = 0, value = 0;
    for (const Record& sample : samples) {
      if (!has_density(sample)) continue;
      const Channels none{}, &own = has_weight(*sample) ? values[value] : none;
      if (!discrete_ && densities[density] == 0) {
        zero.push_back(density);
        points_of_zero.push_back(sample->x);
      }
      if (!discrete_ && differs(*sample, densities[density], own)) {
        differing.push_back(density);
        add_neighbours(sample->x, around);
        if (has_weight(*sample)) {
          weighed.push_back(density);
          spreads[density].value = own;
          add_neighbours(sample->x, around_weighed);
        }
      }
      ++density;
      if (has_weight(*sample)) ++value;
    }
    const std::vector<double> pdfs = ask(pair_.pdf, around);
    for (std::size_t i = 0; i < pdfs.size(); ++i) {
      const std::size_t at = differing[i / kSides];
      spreads[at].pdf = std::max(spreads[at].pdf, std::abs(pdfs[i] - densities[at]));
    }
    const std::vector<bool> near = positive_near(pair_, points_of_zero);
    for (std::size_t i = 0; i < zero.size(); ++i) spreads[zero[i]].positive_near = near[i];
    if (!weighed.empty()) add_spreads_of_values(weighed, ask(pair_.value, around_weighed), spreads);
    return spreads;
  }

  /// @param spreads  with the values at the points themselves
  void add_spreads_of_values(const std::vector<std::size_t>& of,
                             const std::vector<Channels>& around,
                             std::vector<Spread>& spreads) const {
    for (std::size_t k = 0; k < of.size(); ++k) {
      Channels& value = spreads[of[k]].value;
      for (std::size_t c = 0; c < value.count; ++c) {
        double spread = 0;
        for (std::size_t i = kSides * k; i < kSides * (k + 1); ++i) {
          spread = std::max(spread, std::abs(around[i][c] - value[c]));
        }
        value.value[c] = spread;
      }
    }
  }

  void add_neighbours(const Vec3& x, std::vector<Vec3>& points) const {
    for (std::size_t k = 0; k < kSides; ++k) points.push_back(beside(x, k));
  }

  bool differs(const SampleRecord& sample, double pdf, const Channels& value) const {
    if (sample.pdf && !agree(*sample.pdf, pdf, 0)) return true;
    for (std::size_t c = 0; c < std::min(sample.weight.count, value.count); ++c) {
      if (!agree(sample.weight[c] * pdf, value[c], 0)) return true;
    }
    return false;
  }

  template <class Where>
  void see_point(const SampleRecord& sample, const Where& where) {
    const bool has_mass = sample.mass >= 0;  // a density's is 0; neither is NaN
    finite_.hold(is_finite(sample.x) && all_finite(sample.weight) && has_mass, [&] {
      return (has_mass ? std::string("sample or weight is not finite")
                       : "an atom has mass " + number(sample.mass)) +
             " at " + where();
    });
    if (!is_finite(sample.x)) return;
    support_.hold(in_domain(sample.x), [&] { return "sample outside the domain at " + where(); });
    if (sample.mass > 0) see_atom(sample);
  }

  template <class Where>
  void see_pdf(const SampleRecord& sample, double pdf, const Spread& spread, const Where& where) {
    finite_.hold(pdf >= 0 && std::isfinite(pdf),
                 [&] { return "pdf is " + number(pdf) + " at " + where(); });
    support_.hold(pdf > 0 || !(pdf == 0) || spread.positive_near,
                  [&] { return "pdf is 0 at a sample, " + where(); });
    see_record(sample, pdf, spread, where);
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
  void see_record(const SampleRecord& sample, double pdf, const Spread& spread,
                  const Where& where) {
    if (!sample.pdf) return;
    const double stated = *sample.pdf;
    const bool agrees = agree(stated, pdf, spread.pdf);
    record_.hold(agrees, [&] {
      return "the record states pdf " + number(stated) + ", pdf() gives " + number(pdf) + " at " +
             where();
    });
    record_.ratio(sample.x, stated / pdf);
    if (pdf > 0) record_.deviation(std::abs(stated / pdf - 1));
  }

  template <class Where>
  void see_weight(const SampleRecord& sample, double pdf, const Channels& value,
                  const Spread& spread, const Where& where) {
    const double largest = largest_of(value);
    bool agrees = sample.weight.count == value.count;
    for (std::size_t c = 0; c < value.count && agrees; ++c) {
      const double product = sample.weight[c] * pdf;
      agrees = agree(product, value[c], spread.value[c]) ||
               agree(product, value[c], std::abs(sample.weight[c]) * spread.pdf);
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
    std::vector<Vec3> points;
    for (const RatioAt& r : ratios) {
      points.push_back(r.x);
      add_neighbours(r.x, points);
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

  /// A neighbour within rounding, in one of kSides directions.
  Vec3 beside(const Vec3& x, std::size_t side) const {
    const double angle = static_cast<double>(side) * std::numbers::pi / 2;
    return pair_.domain.chart().near(x, 8 * pair_.epsilon, angle);
  }

  /// Equal up to rounding: of the numbers themselves, or of the point that one is asked at.
  bool agree(double a, double b, double spread) const {
    return equal_up_to_rounding(a, b, pair_.epsilon, [&] { return 16 * spread; });
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
