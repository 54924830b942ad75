#include <algorithm>
#include <cmath>

#include "diagnosis/observations.h"

namespace plumbline::verify {

namespace {

constexpr std::size_t kExactPerView = 400;

bool usable(double ratio, double base) {
  return ratio > 0 && std::isfinite(ratio) && base > 0 && std::isfinite(base);
}

void add_series(const ViewEvidence& view, const RatioSeries& series, int lobe,
                ViewObservations& out) {
  std::vector<const RatioAt*> points;
  for (const RatioAt& p : series.points) {
    if (p.lobe == lobe || lobe < 0) points.push_back(&p);
  }
  const std::size_t step = std::max<std::size_t>(1, points.size() / kExactPerView);
  std::vector<Vec3> x;
  for (std::size_t i = 0; i < points.size(); i += step) x.push_back(points[i]->x);
  const std::vector<double> bases =
      series.kind == RatioKind::weight_over_value ? values_at(view, x) : pdfs_at(view, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const RatioAt& p = *points[i * step];
    ExactPoint e;
    const bool of_lobe = series.kind == RatioKind::lobe_density_over_pdf;
    const double base =
        of_lobe ? view.pair->lobes[static_cast<std::size_t>(p.lobe)].pdf(p.x) : bases[i];
    e.place = {&view, view.wo.value_or(Vec3{}), p.x, base, p.u ? &*p.u : nullptr};
    e.ratio = p.ratio;
    e.error = p.error;
    if (usable(e.ratio, e.place.base)) out.exact.push_back(e);
  }
}

void add_bins(const ViewEvidence& view, ViewObservations& out) {
  std::vector<Vec3> nodes;
  for (const BinSeen& seen : view.bins) {
    if (seen.expected > 0) nodes.insert(nodes.end(), seen.nodes.begin(), seen.nodes.end());
  }
  const std::vector<double> pdfs = pdfs_at(view, nodes);
  auto pdf = pdfs.begin();
  for (const BinSeen& seen : view.bins) {
    if (seen.nodes.empty() || !(seen.expected > 0)) continue;
    CountedBin bin;
    bin.observed = seen.observed;
    bin.expected = seen.expected;
    bin.expected_error = seen.expected_error;
    bin.shares = seen.shares;
    bin.measures = seen.measures;
    bin.samples = view.samples;
    for (const Vec3& x : seen.nodes) {
      bin.nodes.push_back({&view, view.wo.value_or(Vec3{}), x, *pdf++});
      if (bin.nodes.back().base > 0) continue;
      bin.edge = true;
      if (!view.strays.empty()) bin.judged = false;
    }
    // Nodes that all fall beside the support show nothing of the bin.
    bin.judged = bin.judged && std::any_of(bin.nodes.begin(), bin.nodes.end(),
                                           [](const Place& p) { return p.base > 0; });
    out.bins.push_back(std::move(bin));
  }
}

}  // namespace

Observations Observations::of_density(const ReportEvidence& evidence) {
  Observations all;
  for (const ViewEvidence& view : evidence.views) {
    ViewObservations o;
    o.view = &view;
    for (const RatioSeries& s : view.ratios) {
      if (s.kind == RatioKind::density_over_pdf) add_series(view, s, -1, o);
    }
    add_bins(view, o);
    o.judge_mass = view.mass.has_value() && !view.bins.empty();
    o.judge_strays = !view.strays.empty();
    all.views_.push_back(std::move(o));
  }
  all.prepare();
  return all;
}

Observations Observations::with_points(const std::vector<ExactOfView>& exact, double missed) const {
  Observations more = *this;
  for (const ExactOfView& e : exact) {
    for (ViewObservations& o : more.views_) {
      if (o.view != e.view) continue;
      for (const ExactPoint& p : e.points) {
        if (usable(p.ratio, p.place.base)) o.exact.push_back(p);
      }
      o.missed = missed;
    }
  }
  more.prepare();
  return more;
}

Observations Observations::of_points(const ReportEvidence& evidence,
                                     const std::vector<ExactOfView>& exact, double missed) {
  Observations none;
  for (const ViewEvidence& view : evidence.views) {
    none.views_.emplace_back();
    none.views_.back().view = &view;
  }
  return none.with_points(exact, missed);
}

Observations Observations::of_series(const ReportEvidence& evidence, RatioKind kind, int lobe) {
  Observations all;
  for (const ViewEvidence& view : evidence.views) {
    ViewObservations o;
    o.view = &view;
    for (const RatioSeries& s : view.ratios) {
      if (s.kind == kind) add_series(view, s, lobe, o);
    }
    all.views_.push_back(std::move(o));
  }
  all.prepare();
  return all;
}

}  // namespace plumbline::verify
