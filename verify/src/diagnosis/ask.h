#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "diagnosis/evidence.h"
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

inline double pdf_at(const ViewEvidence& view, const Vec3& wo, const Vec3& wi) {
  return view.bsdf->pdf(wo, wi);
}

/// Brightest channel of f·|cosθ|.
inline double value_at(const ViewEvidence& view, const Vec3& x) {
  if (!view.pair->value) return 0;
  const Channels c = view.pair->value(x);
  return c.count > 0 ? *std::max_element(c.value.begin(), c.value.begin() + c.count) : 0.0;
}

inline double f_at(const ViewEvidence& view, const Vec3& wo, const Vec3& wi) {
  const Channels c = view.bsdf->eval(wo, wi);
  return c.count > 0 ? *std::max_element(c.value.begin(), c.value.begin() + c.count) : 0.0;
}

inline bool is_finite(const Vec3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

/// A sample that is neither rejected nor an atom, nor at a point that is none.
inline bool has_density(const std::optional<SampleRecord>& sample) {
  return sample && sample->mass == 0 && is_finite(sample->x);
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

inline std::vector<SampleRecord> draw_samples(const ViewEvidence& view, int count) {
  Random random = random_for(Stream::asked);
  std::vector<SampleRecord> samples;
  for (int i = 0; i < count; ++i) {
    const auto s = view.pair->next(random);
    if (s && is_finite(s->x)) samples.push_back(*s);
  }
  return samples;
}

}  // namespace plumbline::verify
