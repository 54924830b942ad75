#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "diagnosis/evidence.h"
#include "pairs/batches.h"
#include "streams.h"

/// The questions that a diagnosis asks of code under test.
namespace plumbline::verify {

/// A pair of directions, or a point, with what a ratio is over there: pdf(), or f·|cosθ|.
struct Place {
  const ViewEvidence* view = nullptr;
  Vec3 wo{}, x{};
  double base = 0;
  const Uniforms* u = nullptr;  ///< the random numbers that lead there, if known
};

inline bool has_wo(const ViewEvidence& view) { return view.wo.has_value(); }

inline double pdf_at(const ViewEvidence& view, const Vec3& x) { return view.pair->pdf(x); }

inline std::vector<double> pdfs_at(const ViewEvidence& view, const std::vector<Vec3>& x) {
  return ask(view.pair->pdf, x);
}

inline double pdf_at(const ViewEvidence& view, const Vec3& wo, const Vec3& wi) {
  return view.bsdf->pdf(wo, wi);
}

inline double brightest(const Channels& c) {
  return c.count > 0 ? *std::max_element(c.value.begin(), c.value.begin() + c.count) : 0.0;
}

/// Brightest channel of f·|cosθ|.
inline double value_at(const ViewEvidence& view, const Vec3& x) {
  return view.pair->value ? brightest(view.pair->value(x)) : 0;
}

inline std::vector<double> values_at(const ViewEvidence& view, const std::vector<Vec3>& x) {
  std::vector<double> values(x.size());
  if (!view.pair->value) return values;
  const std::vector<Channels> channels = ask(view.pair->value, x);
  std::transform(channels.begin(), channels.end(), values.begin(), brightest);
  return values;
}

inline double f_at(const ViewEvidence& view, const Vec3& wo, const Vec3& wi) {
  return brightest(view.bsdf->eval(wo, wi));
}

/// A few views, failing ones first: they show what went wrong.
inline std::vector<const ViewEvidence*> views_to_ask(const ReportEvidence& evidence) {
  constexpr std::size_t kViewsAsked = 4;
  std::vector<const ViewEvidence*> views;
  for (const bool failed : {true, false}) {
    for (const ViewEvidence& v : evidence.views) {
      if (v.failed == failed && views.size() < kViewsAsked) views.push_back(&v);
    }
  }
  return views;
}

/// The next samples, rejected ones among them.
inline std::vector<Record> draw_records(const ViewEvidence& view, Random& random,
                                        std::size_t count) {
  std::vector<Record> records(count);
  view.pair->next(random, records);
  return records;
}

inline std::vector<SampleRecord> draw_samples(const ViewEvidence& view, std::size_t count) {
  Random random = random_for(Stream::asked);
  std::vector<SampleRecord> samples;
  for (const Record& s : draw_records(view, random, count)) {
    if (s && is_finite(s->x)) samples.push_back(*s);
  }
  return samples;
}

/// Where samples with a density lie.
inline std::vector<Vec3> points_of_density(const std::vector<Record>& records) {
  std::vector<Vec3> points;
  for (const Record& s : records) {
    if (has_density(s)) points.push_back(s->x);
  }
  return points;
}

}  // namespace plumbline::verify
