#include "diagnosis/frames.h"

#include <cmath>
#include <numbers>
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
  const bool map = pair.sample && pair.numbers <= 2;
  for (int i = 0; i < kPerSide; ++i) {
    std::vector<Uniforms> row;
    std::vector<Vec3> points;
    for (int j = 0; j < kPerSide; ++j) {
      row.push_back({(i + 0.5) / kPerSide, (j + 0.5) / kPerSide, 0});
      points.push_back(chart.from_square({row.back()[0], row.back()[1]}));
    }
    const auto samples = map ? ask(pair.sample, row) : draw_records(view, random, kPerSide);
    for (const Vec3& x : points_of_density(samples)) of_samples = sum(of_samples, x);
    const std::vector<double> pdfs = pdfs_at(view, points);
    for (std::size_t j = 0; j < row.size(); ++j) {
      const double mass = pdfs[j] * chart.element({row[j][0], row[j][1]});
      if (std::isfinite(mass)) of_pdf = sum(of_pdf, scaled(points[j], mass));
    }
  }
  return {of_samples, of_pdf};
}

/// The pdf is the same all around its mean direction, as that of a cone or a lobe, not of a map.
bool is_round(const ViewEvidence& view, const Vec3& axis) {
  constexpr int kPoints = 24;
  constexpr double kSame = 0.02;
  double alike = 0, tested = 0;
  const Vec3 other = std::abs(axis[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 right = normalized(cross(other, axis)), up = cross(axis, right);
  for (int i = 1; i < kPoints; ++i) {
    const double angle = std::numbers::pi * std::pow(0.75, i);
    const auto at = [&](double azimuth) {
      const Vec3 across = sum(scaled(right, std::cos(azimuth)), scaled(up, std::sin(azimuth)));
      return pdf_at(view, sum(scaled(axis, std::cos(angle)), scaled(across, std::sin(angle))));
    };
    const double here = at(0.2);
    for (const double azimuth : {1.7, 2.9, 4.4}) {
      if (!(here > 0)) continue;
      ++tested;
      alike += std::abs(at(azimuth) / here - 1) < kSame ? 1 : 0;
    }
  }
  return tested > 0 && alike > 0.9 * tested;
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
  // A map that is turned by a column, which is likelier, costs less; what is round has none.
  const double cost = is_round(evidence.views.front(), to) ? 8 : 13;
  h.charge = [cost](const auto&) { return std::optional(cost - 3 * kPerNumber); };
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
  list.push_back(h);
  if (apart) return;
  // By a quarter of a turn: the two axes across it are exchanged.
  h.kind = CauseKind::mirrored;
  h.charge = [cost](const std::vector<std::vector<double>>& n) -> std::optional<double> {
    constexpr double kSame = 0.02;
    const double by = length({n.front()[0], n.front()[1], n.front()[2]});
    if (std::abs(by - std::numbers::pi / 2) > kSame) return std::nullopt;
    return cost - 1 - 3 * kPerNumber;
  };
  h.words = [blame, to](std::span<const double>) {
    std::string axis;
    for (const double c : to) {
      axis += (axis.empty() ? "" : ", ") + number(std::round(1e3 * c) / 1e3);
    }
    return "the two directions across the axis (" + axis + ") are exchanged in " + blame.function;
  };
  list.push_back(std::move(h));
}

}  // namespace plumbline::verify
