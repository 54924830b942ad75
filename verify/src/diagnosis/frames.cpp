#include "diagnosis/frames.h"

#include <cmath>
#include <string>
#include <utility>

#include "diagnosis/ask.h"
#include "streams.h"
#include "text.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

/// Mean direction of the samples, and of the pdf: over grids, which see borders better than random
/// numbers do.
std::pair<Vec3, Vec3> mean_directions(const ViewEvidence& view) {
  constexpr int kPerSide = 500;
  const SamplingPair& pair = *view.pair;
  const Chart& chart = pair.domain.chart();
  Random random = random_for(Stream::mean_direction);
  Vec3 of_samples{}, of_pdf{};
  for (int i = 0; i < kPerSide; ++i) {
    for (int j = 0; j < kPerSide; ++j) {
      const Point2 p{(i + 0.5) / kPerSide, (j + 0.5) / kPerSide};
      const bool map = pair.sample && pair.numbers <= 2;
      const auto s = map ? pair.sample({p[0], p[1], 0}) : pair.next(random);
      if (has_density(s)) of_samples = sum(of_samples, s->x);
      const Vec3 x = chart.from_square(p);
      const double mass = pair.pdf(x) * chart.element(p);
      if (std::isfinite(mass)) of_pdf = sum(of_pdf, scaled(x, mass));
    }
  }
  return {of_samples, of_pdf};
}

std::vector<double> scaled_to_numbers(const Vec3& axis, double angle) {
  return {angle * axis[0], angle * axis[1], angle * axis[2]};
}

}  // namespace

void add_turned_as_a_whole(std::vector<Hypothesis>& list, const ReportEvidence& evidence,
                           const Blame& blame, const Asked& ask) {
  const std::pair<Vec3, Vec3> means = mean_directions(evidence.views.front());
  if (!(length(means.first) > 0) || !(length(means.second) > 0)) return;
  const Vec3 from = normalized(means.first), to = normalized(means.second);
  const Vec3 normal = cross(from, to);
  constexpr double kApart = 0.02;
  const bool apart = length(normal) > kApart;
  Hypothesis h;
  h.kind = CauseKind::tangent_frame;
  h.complexity = 1;
  if (apart) {
    const double angle = std::atan2(length(normal), dot(from, to));
    h.starts = {scaled_to_numbers(normalized(normal), angle)};
  } else {
    // Around the axis that they share.
    for (const double angle : {0.4, 0.8, 1.2, 1.57, 2.0, 2.4, 2.8}) {
      h.starts.push_back(scaled_to_numbers(to, angle));
      h.starts.push_back(scaled_to_numbers(to, -angle));
    }
  }
  // The numbers are measured, and only made more precise by the fit.
  // A map that is turned by a column, which is likelier, costs less.
  h.charge = [](const auto&) { return std::optional(13.0 - 3 * kPerNumber); };
  h.prediction = [ask](const Place& p, std::span<const double> n) {
    const Vec3 r{n[0], n[1], n[2]};
    const double by = length(r);
    return ask(p, by > 0 ? turned_around(p.x, scaled(r, 1 / by), by) : p.x);
  };
  h.words = [blame, from, to, apart](std::span<const double>) {
    const auto text = [](const Vec3& w) {
      std::string all;
      for (const double c : w) all += (all.empty() ? "" : ", ") + number(std::round(1e3 * c) / 1e3);
      return all;
    };
    if (!apart) {
      return blame.function + " is turned around its own axis, (" + text(to) +
             "), against sample: their frames differ";
    }
    return "samples lie around (" + text(from) + "), " + blame.function + " is the same around (" +
           text(to) + "): their frames differ";
  };
  list.push_back(std::move(h));
}

}  // namespace plumbline::verify
