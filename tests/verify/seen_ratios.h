#pragma once

#include <cmath>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/pair.h>

#include "diagnosis/hypothesis.h"
#include "lattice.h"

/// What a diagnosis has to go by, made up: exact ratios at even points, in place of what checks
/// have seen of code. What is wrong is then just what the test says.
namespace plumbline::verify {

using OfDirections = std::function<double(const Vec3& wo, const Vec3& wi)>;
using OfPoint = std::function<double(const Vec3& x)>;

inline constexpr double kKnownTo = 1e-7;  // relative, of the ratios that are made up

/// Points of a view: fewer than those of which a few may be wild.
inline constexpr int kRatiosPerView = 90;

/// From where a surface is looked at.
inline const std::vector<Vec3> kViews = {{0.48, 0.36, 0.8}, {-0.6, 0.64, 0.48}, {0.28, 0, 0.96}};

inline ErasedBsdf bsdf_with(const OfDirections& pdf) {
  ErasedBsdf b;
  b.pdf = [pdf](const Vec3& wo, const Vec3& wi) { return pdf(wo, wi); };
  return b;
}

/// Of which the ratios that are made up do not depend.
inline ErasedBsdf tilted_bsdf() {
  return bsdf_with(
      [](const Vec3&, const Vec3& wi) { return 1 + 0.3 * wi[0] + 0.2 * wi[1] + 0.1 * wi[2]; });
}

/// Evidence of one kind of ratio, in several views.
class SeenRatios {
 public:
  /// Of a BSDF, seen from each `wo` in directions `wi`.
  SeenRatios(ErasedBsdf bsdf, const std::vector<Vec3>& wo, const std::vector<Vec3>& wi, double eta,
             RatioKind kind, const OfDirections& ratio)
      : bsdf_(std::move(bsdf)) {
    for (const Vec3& w : wo) {
      SamplingPair& pair = pairs_.emplace_back();
      pair.domain = Domain::sphere();
      pair.pdf = [this, w](const Vec3& x) { return bsdf_.pdf(w, x); };
      pair.value = [this, w](const Vec3& x) {
        Channels c = bsdf_.eval(w, x);
        c.value[0] *= std::abs(x[2]);
        return c;
      };
      add_view(pair, wi, kind, [&](const Vec3& x) { return ratio(w, x); });
      evidence_.views.back().wo = w;
      evidence_.views.back().bsdf = &bsdf_;
      evidence_.views.back().eta = eta;
    }
  }

  /// Of anything else.
  SeenRatios(Domain domain, const OfPoint& pdf, const std::vector<Vec3>& points,
             const OfPoint& ratio) {
    SamplingPair& pair = pairs_.emplace_back();
    pair.domain = std::move(domain);
    pair.pdf = pdf;
    add_view(pair, points, RatioKind::density_over_pdf, ratio);
  }
  SeenRatios(const SeenRatios&) = delete;
  SeenRatios& operator=(const SeenRatios&) = delete;

  ReportEvidence& evidence() { return evidence_; }
  SamplingPair& pair() { return pairs_.front(); }

 private:
  void add_view(const SamplingPair& pair, const std::vector<Vec3>& points, RatioKind kind,
                const OfPoint& ratio) {
    ViewEvidence& view = evidence_.views.emplace_back();
    view.pair = &pair;
    view.failed = true;
    RatioSeries& series = view.ratios.emplace_back();
    series.kind = kind;
    for (const Vec3& x : points) series.points.push_back({x, ratio(x), kKnownTo, -1, {}});
  }

  ErasedBsdf bsdf_;
  std::deque<SamplingPair> pairs_;
  ReportEvidence evidence_;
};

/// An explanation in words, with its kind; empty where nothing explains.
struct Said {
  CauseKind kind = CauseKind::none;
  std::string words;
  double cost = 0;
};

/// The simplest of the hypotheses that explain.
inline Said simplest(const Observations& seen, const std::vector<Hypothesis>& hypotheses) {
  const std::vector<Explanation> found = explain(seen, hypotheses);
  if (found.empty()) return {};
  const Explanation& e = found.front();
  return {e.hypothesis->kind, e.hypothesis->words(e.numbers.front()), e.cost};
}

inline const Blame& of_pdf() {
  static const Blame blame{"pdf()", "the density of the samples"};
  return blame;
}

}  // namespace plumbline::verify
