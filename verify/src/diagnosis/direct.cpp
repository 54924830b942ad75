#include "diagnosis/direct.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "diagnosis/ask.h"
#include "streams.h"
#include "text.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

bool differ(double a, double b, double epsilon) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return false;
  return !(std::abs(a - b) <= 64 * epsilon * std::max(std::abs(a), std::abs(b)));
}

}  // namespace

std::optional<Finding> find_stale_state(const ReportEvidence& evidence) {
  constexpr int kSamples = 64;
  const auto views = views_to_ask(evidence);
  std::vector<std::vector<SampleRecord>> samples;
  std::vector<std::vector<std::array<double, 2>>> first;
  for (const ViewEvidence* v : views) {
    Random random = random_for(Stream::asked);
    samples.emplace_back();
    first.emplace_back();
    for (int i = 0; i < kSamples; ++i) {
      const auto s = v->pair->next(random);
      if (!s || !is_finite(s->x) || s->mass > 0) continue;
      samples.back().push_back(*s);
      first.back().push_back({pdf_at(*v, s->x), value_at(*v, s->x)});
    }
  }
  for (std::size_t k = views.size(); k-- > 0;) {
    for (std::size_t i = samples[k].size(); i-- > 0;) {
      const double pdf = pdf_at(*views[k], samples[k][i].x);
      const double value = value_at(*views[k], samples[k][i].x);
      const double epsilon = views[k]->pair->epsilon;
      if (differ(pdf, first[k][i][0], epsilon) || differ(value, first[k][i][1], epsilon)) {
        return Finding{CauseKind::stale_state,
                       std::string(differ(pdf, first[k][i][0], epsilon) ? "pdf()" : "f") +
                           " gives another answer to the same question after other questions (" +
                           number(first[k][i][0]) + ", then " + number(pdf) +
                           "): state is kept between calls"};
      }
    }
  }
  for (const ViewEvidence* v : views) {
    if (v->pair->draw || !v->pair->sample) continue;
    Random random = random_for(Stream::asked_between);
    for (int i = 0; i < kSamples; ++i) {
      const Uniforms u{random.uniform(), random.uniform(), random.uniform()};
      const Uniforms w{random.uniform(), random.uniform(), random.uniform()};
      const auto a = v->pair->sample(u);
      v->pair->sample(w);
      const auto b = v->pair->sample(u);
      const bool same = a.has_value() == b.has_value() && (!a || a->x == b->x);
      if (!same && !(a && !is_finite(a->x))) {
        return Finding{CauseKind::stale_state,
                       "sample gives another point for the same numbers after other calls: state "
                       "is kept between calls"};
      }
    }
  }
  return std::nullopt;
}

namespace {

/// How the values of one coordinate crowd.
struct Crowding {
  double largest = 0;    ///< share of the most frequent value
  double different = 0;  ///< share of values that occur once
  double value = 0;
  double range = 0;
  std::size_t distinct = 0;
};

Crowding crowd_of(std::vector<double> values) {
  Crowding crowd;
  if (values.empty()) return crowd;
  std::sort(values.begin(), values.end());
  crowd.range = values.back() - values.front();
  const double n = static_cast<double>(values.size());
  std::size_t once = 0;
  for (std::size_t i = 0; i < values.size();) {
    std::size_t j = i;
    while (j < values.size() && values[j] == values[i]) ++j;
    ++crowd.distinct;
    once += j - i == 1 ? 1 : 0;
    if (static_cast<double>(j - i) / n > crowd.largest) {
      crowd.largest = static_cast<double>(j - i) / n;
      crowd.value = values[i];
    }
    i = j;
  }
  crowd.different = static_cast<double>(once) / n;
  return crowd;
}

constexpr double kCrowd = 0.005;
constexpr double kNeighboursInFloat = 0x1p-12;
constexpr double kBesideDomain = 1e-5;

Vec3 most_frequent_point(const std::vector<SampleRecord>& samples) {
  std::map<Vec3, int> counts;
  for (const SampleRecord& s : samples) ++counts[s.x];
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? Vec3{} : most->first;
}

/// Samples around the point where most of them lie have cosines to it that are 1 − k 2⁻²⁴ for whole
/// numbers k: their cosine was a float before it became a direction.
bool steps_of_rounding(const ViewEvidence& view) {
  constexpr std::size_t kSamples = 8192;
  constexpr double kStep = 0x1p-24, kWhole = 0.1, kMostSteps = 4096;
  if (!view.pair->domain.directions()) return false;
  const auto samples = draw_samples(view, kSamples);
  const Vec3 most = most_frequent_point(samples);
  double tested = 0, whole = 0;
  for (const SampleRecord& s : samples) {
    const Vec3 d = sum(s.x, scaled(most, -1));
    const double steps = dot(d, d) / 2 / kStep;
    // Rounding of the direction itself moves it by about √(2 steps) of these per 2⁻²⁴.
    if (!(steps > 0.25) || steps > kMostSteps) continue;
    ++tested;
    whole += std::abs(steps - std::round(steps)) < kWhole ? 1 : 0;
  }
  // By chance a fifth would be.
  return tested > 100 && whole > 0.6 * tested;
}

/// Coordinates of samples, atoms apart, in which each that is drawn at random varies.
std::array<std::vector<double>, 3> coordinates_of_samples(const ViewEvidence& view,
                                                          std::size_t count) {
  const Domain& domain = view.pair->domain;
  std::array<std::vector<double>, 3> coordinates;
  for (const SampleRecord& s : draw_samples(view, count)) {
    if (s.mass > 0) continue;
    if (domain.directions()) {
      for (std::size_t i = 0; i < 3; ++i) coordinates[i].push_back(s.x[i] + 0.0);
      continue;
    }
    // Surfaces lie in planes, which is no fault: the chart's coordinates vary. Beside the domain
    // the chart clamps, not the sampler.
    if (domain.chart().distance(s.x) > kBesideDomain) continue;
    const Point2 p = domain.chart().to_square(s.x);
    for (std::size_t i = 0; i < 2; ++i) coordinates[i].push_back(p[i]);
  }
  return coordinates;
}

/// Many samples in one point state another density than pdf() does there: an atom's, made up.
std::optional<Finding> of_made_up_density(const ViewEvidence& view, const std::string& where) {
  constexpr std::size_t kSamples = 4096;
  constexpr double kOther = 0.01;
  const auto samples = draw_samples(view, kSamples);
  const Vec3 most = most_frequent_point(samples);
  for (const SampleRecord& s : samples) {
    if (s.x != most || s.mass > 0 || !s.pdf) continue;
    const double pdf = pdf_at(view, s.x);
    if (std::abs(*s.pdf - pdf) <= kOther * std::max(*s.pdf, pdf)) return std::nullopt;
    return Finding{CauseKind::atom_as_density,
                   where + ", and state a density of " + number(*s.pdf) + ", where pdf() gives " +
                       number(pdf) + ": an atom that is not said to be one"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Finding> find_samples_on_a_line(const ReportEvidence& evidence) {
  constexpr std::size_t kSamples = 8192;
  for (const ViewEvidence* v : views_to_ask(evidence)) {
    if (v->pair->domain.dimension() == 0) continue;
    const auto names =
        v->pair->domain.directions()
            ? std::array<const char*, 3>{"x", "y", "z"}
            : std::array<const char*, 3>{"first coordinate", "second coordinate", ""};
    std::array<std::vector<double>, 3> coordinates = coordinates_of_samples(*v, kSamples);
    const bool in_float = v->pair->epsilon > 0x1p-40;
    int crowded = 0, varying = 0, few = 0;
    std::size_t points = 0;
    std::string where;
    double share = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (coordinates[i].size() < kSamples / 20) continue;
      const auto count = static_cast<double>(coordinates[i].size());
      const Crowding c = crowd_of(std::move(coordinates[i]));
      // A coordinate that never changes is the chart's: a line has one only.
      if (c.distinct <= 1 && !v->pair->domain.directions()) continue;
      ++varying;
      if (c.distinct > 4 && c.different < 0.2 && static_cast<double>(c.distinct) < count / 8) {
        // Values as close as that are neighbours in float; wide apart, they are put there.
        const bool close = c.range / static_cast<double>(c.distinct) < kNeighboursInFloat;
        if (in_float && close) {
          return Finding{CauseKind::precision,
                         "samples take few different values (" + number(std::uint64_t(c.distinct)) +
                             " of " + names[i] + " in " + number(count) +
                             " samples): what is sampled is narrower than the arithmetic resolves"};
        }
        ++few;
        points = std::max(points, c.distinct);
      }
      // Within 3e-4 of an axis the cosine is 1 in float: that is its rounding.
      if (v->pair->domain.directions() && in_float && std::abs(c.value) == 1) continue;
      if (c.largest < kCrowd || c.different < 0.05 * (1 - c.largest)) continue;
      ++crowded;
      share = std::max(share, c.largest);
      where += (where.empty() ? "" : ", ") + std::string(names[i]) + " = " + number(c.value);
    }
    if (few > 0) {
      return Finding{CauseKind::on_a_line,
                     std::string(few == varying ? "samples lie in single points, with "
                                                : "samples lie on lines, with ") +
                         number(std::uint64_t(points)) + " different coordinates in " +
                         number(std::uint64_t(kSamples)) +
                         " samples: the place within a cell is not drawn"};
    }
    if (crowded == 0) continue;
    if (crowded >= varying && in_float && steps_of_rounding(*v)) {
      return Finding{CauseKind::precision,
                     "the cosines of samples to the middle of the lobe are the few next to 1 that "
                     "float has: compute 1 − cosθ"};
    }
    const std::string some = percent(share) + " of the samples";
    if (crowded >= varying || (v->pair->domain.dimension() == 1)) {
      if (const auto f = of_made_up_density(*v, some + " lie in one point, " + where)) return f;
      // Of directions both coordinates would have to be clamped; a mirror gives one by itself.
      if (v->pair->domain.directions() && has_wo(*v)) {
        return Finding{CauseKind::atom_as_density, some + " lie in one point, " + where +
                                                       ": an atom that is not said to be one"};
      }
      return Finding{CauseKind::on_a_line, some + " lie in one point, " + where +
                                               ": a clamp, or an atom that is not said to be one"};
    }
    return Finding{CauseKind::on_a_line, some + " lie on a line, " + where + ": a clamp?"};
  }
  return std::nullopt;
}

std::optional<Finding> find_rounded_cap(const ReportEvidence& evidence) {
  constexpr double kStep = 0x1p-24, kMostSteps = 2000, kWhole = 1e-3;
  const ViewEvidence& view = evidence.views.front();
  if (!view.failed || view.wo || !(view.pair->epsilon > 0x1p-40)) return std::nullopt;
  if (!view.pair->domain.directions()) return std::nullopt;
  double least = 1e300, most = 0;
  for (const SampleRecord& s : draw_samples(view, 64)) {
    const double pdf = pdf_at(view, s.x);
    if (!(pdf > 0)) continue;
    least = std::min(least, pdf);
    most = std::max(most, pdf);
  }
  if (!(most > 0) || least < most * (1 - 1e-5)) return std::nullopt;
  const double steps = 1 / (2 * std::numbers::pi * most * kStep);
  if (!(steps > 0.5) || steps > kMostSteps ||
      std::abs(steps - std::round(steps)) > kWhole * steps) {
    return std::nullopt;
  }
  return Finding{CauseKind::precision,
                 "1/pdf() is a solid angle of 2π · " + number(std::round(steps)) +
                     " · 2⁻²⁴: 1 − cosθ was taken in float, of a cosine next to 1; write it as "
                     "2 sin²(θ/2)"};
}

std::optional<Finding> find_not_finite(const ReportEvidence& evidence) {
  constexpr std::size_t kSamples = 4096;
  const auto bad = [](double x) { return !std::isfinite(x) || x < 0; };
  for (const ViewEvidence* v : views_to_ask(evidence)) {
    Random random = random_for(Stream::asked);
    const std::vector<Record> samples = draw_records(*v, random, kSamples);
    std::vector<Vec3> points;
    for (const Record& s : samples) {
      if (!s) continue;
      if (!is_finite(s->x)) {
        return Finding{CauseKind::not_finite, "a sampled point is not finite"};
      }
      if (!(s->mass > 0)) points.push_back(s->x);
    }
    for (std::size_t i = 0; i < kSamples && v->pair->domain.dimension() > 0; ++i) {
      points.push_back(v->pair->domain.chart().from_square({random.uniform(), random.uniform()}));
    }
    const std::vector<double> pdfs = pdfs_at(*v, points), values = values_at(*v, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3& x = points[i];
      const std::string at =
          " at (" + number(x[0]) + ", " + number(x[1]) + ", " + number(x[2]) + ")";
      if (bad(pdfs[i])) {
        return Finding{CauseKind::not_finite, "pdf() is " + number(pdfs[i]) + at};
      }
      if (!std::isfinite(values[i])) {
        return Finding{CauseKind::not_finite, "f is " + number(values[i]) + at};
      }
    }
    for (const Record& s : samples) {
      if (s && s->weight.count > 0 && !std::isfinite(s->weight[0])) {
        return Finding{CauseKind::not_finite, "a weight is " + number(s->weight[0])};
      }
    }
  }
  return std::nullopt;
}

std::optional<Finding> find_points_not_finite(const ReportEvidence& evidence) {
  constexpr std::size_t kSamples = 4096;
  constexpr double kMany = 0.005;
  for (const ViewEvidence& v : evidence.views) {
    if (!v.failed) continue;
    Random random = random_for(Stream::asked);
    double bad = 0;
    for (const Record& s : draw_records(v, random, kSamples)) {
      bad += s && !is_finite(s->x) ? 1 : 0;
    }
    if (bad > kMany * double{kSamples}) {
      return Finding{CauseKind::not_finite,
                     percent(bad / double{kSamples}) + " of the sampled points are not finite"};
    }
  }
  return std::nullopt;
}

}  // namespace plumbline::verify
