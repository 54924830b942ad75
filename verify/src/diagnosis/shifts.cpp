#include "diagnosis/shifts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <string>

#include "diagnosis/geometry.h"
#include "text.h"

namespace plumbline::verify {

namespace {

/// Cells that maps and tables are likely to have, over the whole.
std::vector<double> likely_shifts() {
  std::set<double> shifts;
  const auto add = [&shifts](double cells) {
    shifts.insert(1 / cells);
    shifts.insert(0.5 / cells);
  };
  for (int n = 2; n <= 160; ++n) add(n);
  for (int n = 256; n <= 8192; n *= 2) add(n);
  for (const double n : {180., 192., 200., 240., 250., 300., 320., 360., 384.,  400.,
                         480., 500., 600., 640., 720., 768., 800., 900., 1000., 2000.}) {
    add(n);
  }
  std::vector<double> both;
  for (const double s : shifts) both.insert(both.end(), {s, -s});
  return both;
}

double wrapped(double x) { return x - std::floor(x); }

/// A density of the square moved along one coordinate or both, around the border or up to it, where
/// nothing is known of what is beyond.
///
/// @param in_measure  false: the density is a table's over the square, whatever area it stands for
Hypothesis moved_on_square(const Asked& ask, const Domain& domain, const Point2& by, bool around,
                           bool in_measure) {
  Hypothesis h;
  h.kind = CauseKind::shifted;
  h.prediction = [=](const Place& p, std::span<const double>) {
    const Chart& chart = domain.chart();
    const Point2 here = chart.to_square(p.x);
    Point2 there = here;
    for (std::size_t d = 0; d < 2; ++d) {
      there[d] = around ? wrapped(here[d] + by[d]) : here[d] + by[d];
      if (there[d] < 0 || there[d] > 1) return kNothingSaid;
    }
    const double moved = ask(p, chart.from_square(there));
    return in_measure ? moved * chart.element(there) / chart.element(here) : moved;
  };
  return h;
}

void add_shifted_points(std::vector<Hypothesis>& list, const Domain& domain, const Blame& blame,
                        const Asked& ask) {
  struct Direction {
    Point2 along;
    const char* words;
  };
  std::vector<Direction> directions{
      {{1, 0}, domain.dimension() == 1 ? "interval" : "first extent"}};
  if (domain.dimension() == 2) {
    directions.push_back({{0, 1}, "second extent"});
    directions.push_back({{1, 1}, "extents, along the diagonal"});
    directions.push_back({{1, -1}, "extents, along the diagonal"});
  }
  for (const double shift : likely_shifts()) {
    for (const Direction& d : directions) {
      for (const bool around : {true, false}) {
        // An area that does not change makes both the same.
        for (const bool in_measure : {true, false}) {
          if (!in_measure && !domain.directions()) continue;
          Hypothesis h = moved_on_square(ask, domain, {shift * d.along[0], shift * d.along[1]},
                                         around, in_measure);
          h.complexity = 10 + (std::abs(shift) < 0.002 ? 1 : 0) + (around ? 0 : 0.1) +
                         (d.along[0] * d.along[1] != 0 ? 0.2 : 0) + (in_measure ? 0 : 0.05);
          h.words = [=, function = blame.function](std::span<const double>) {
            return function + " is that of samples moved by " + number(shift) + " of the " +
                   d.words + " (a cell or half of one)";
          };
          list.push_back(std::move(h));
        }
      }
    }
  }
}

/// A density on a line that is another one's, moved by any length, with another mass or not.
void add_moved_on_line(std::vector<Hypothesis>& list, const ReportEvidence& evidence,
                       const Blame& blame, const Asked& ask) {
  double samples = 0, expected = 0, of_samples = 0, of_expected = 0;
  for (const ViewEvidence& v : evidence.views) {
    for (const BinSeen& b : v.bins) {
      for (std::size_t i = 0; i < b.nodes.size(); ++i) {
        of_samples += b.observed * b.shares[i] * b.nodes[i][0];
        of_expected += b.expected * b.shares[i] * b.nodes[i][0];
      }
      samples += b.observed;
      expected += b.expected;
    }
  }
  if (!(samples > 0) || !(expected > 0)) return;
  const double apart = of_expected / expected - of_samples / samples;
  for (const bool scaled_too : {false, true}) {
    Hypothesis h;
    h.kind = CauseKind::shifted;
    h.needs_exact = true;
    h.complexity = 5;
    for (const double share : {1.0, 0.5, 2.0, 4.0, -1.0}) {
      h.starts.push_back({share * apart});
      if (scaled_too) h.starts.back().push_back(0);
    }
    h.prediction = [=](const Place& p, std::span<const double> n) {
      const Vec3 moved{p.x[0] + n[0], p.x[1], p.x[2]};
      if (p.view->pair->domain.chart().distance(moved) > 0) return kNothingSaid;
      return ask(p, moved) * (scaled_too ? std::exp(n[1]) : 1);
    };
    h.words = [blame](std::span<const double> n) {
      return blame.function + " is that of samples moved by " + number(n[0]);
    };
    list.push_back(std::move(h));
  }
}

/// Azimuth or latitude of a map around an axis, moved; nullopt beyond the poles.
std::optional<Vec3> moved_on_map(const Vec3& w, std::size_t pole, double azimuth, double polar) {
  const std::size_t a = (pole + 1) % 3, b = (pole + 2) % 3;
  const double radius = std::hypot(w[a], w[b]);
  const double theta = std::atan2(radius, w[pole]) + polar;
  if (theta < 0 || theta > std::numbers::pi) return std::nullopt;
  const double phi = std::atan2(w[b], w[a]) + azimuth;
  Vec3 moved;
  moved[pole] = std::cos(theta);
  moved[a] = std::sin(theta) * std::cos(phi);
  moved[b] = std::sin(theta) * std::sin(phi);
  return moved;
}

double sine_from(const Vec3& w, std::size_t pole) {
  return std::sqrt(std::max(1e-300, 1 - w[pole] * w[pole]));
}

void add_shifted_directions(std::vector<Hypothesis>& list, const Blame& blame, const Asked& ask) {
  static constexpr const char* kAxes[] = {"x", "y", "z"};
  using std::numbers::pi;
  const auto add = [&list](double complexity, const std::string& words, Prediction prediction) {
    Hypothesis h;
    h.kind = CauseKind::shifted;
    h.complexity = complexity;
    h.needs_exact = true;
    h.prediction = std::move(prediction);
    h.words = [words](std::span<const double>) { return words; };
    list.push_back(std::move(h));
  };
  for (const std::size_t pole : {std::size_t{2}, std::size_t{1}, std::size_t{0}}) {
    const std::string around = std::string(" around the ") + kAxes[pole] + " axis";
    const double rank = 10 + (pole == 2 ? 0 : pole == 1 ? 0.5 : 1);
    for (const double shift : likely_shifts()) {
      add(rank,
          blame.function + " is that of directions turned by " + number(shift) + " of a turn" +
              around + " (a column or half of one)",
          [=](const Place& p, std::span<const double>) {
            return ask(p, *moved_on_map(p.x, pole, 2 * pi * shift, 0));
          });
      const std::string rows = blame.function + " is that of directions moved by " + number(shift) +
                               " of the latitudes" + around + " (a row or half of one)";
      add(rank + 0.1, rows, [=](const Place& p, std::span<const double>) {
        const auto moved = moved_on_map(p.x, pole, 0, pi * shift);
        return moved ? ask(p, *moved) : kNothingSaid;
      });
      add(rank + 0.2, rows, [=](const Place& p, std::span<const double>) {
        const auto moved = moved_on_map(p.x, pole, 0, pi * shift);
        return moved ? ask(p, *moved) * sine_from(*moved, pole) / sine_from(p.x, pole)
                     : kNothingSaid;
      });
    }
    // sinθ of the middle of a row in place of that of the direction, or the reverse.
    for (int rows = 2; rows <= 2048; rows += rows < 160 ? 1 : rows) {
      for (const double power : {1.0, -1.0}) {
        Hypothesis h;
        h.kind = CauseKind::sine;
        h.complexity = rank;
        h.prediction = [=](const Place& p, std::span<const double>) {
          const double theta = std::acos(std::clamp(p.x[pole], -1.0, 1.0));
          const double middle = (std::floor(theta / pi * rows) + 0.5) * pi / rows;
          return p.base * std::pow(std::sin(middle) / sine_from(p.x, pole), power);
        };
        h.words = [=](std::span<const double>) {
          return blame.function + " has sinθ " +
                 (power > 0 ? "of the direction where samples have that of the middle of a row"
                            : "of the middle of a row where samples have that of the direction") +
                 " (" + std::to_string(rows) + " rows)";
        };
        list.push_back(std::move(h));
      }
    }
  }
}

/// A table over half vectors, moved by columns or rows: p(wo·h) is a function of h alone.
void add_shifted_half_vectors(std::vector<Hypothesis>& list, const Blame& blame) {
  constexpr double kLeast = 1 / 256.0;
  struct Way {
    double turns, quarter_turns, of_sine;
    const char* words;
  };
  const Way ways[] = {{1, 0, 0, " of a turn around the normal (a column or half of one)"},
                      {0, 1, 0, " of a quarter of a turn from the normal (a row or half of one)"},
                      {0, 1, 1, " of a quarter of a turn from the normal (a row or half of one)"}};
  for (const double shift : likely_shifts()) {
    if (std::abs(shift) < kLeast) continue;
    for (const Way& way : ways) {
      Hypothesis h;
      h.kind = CauseKind::shifted;
      h.needs_exact = true;
      h.complexity = 12;
      h.prediction = [=](const Place& p, std::span<const double>) {
        if (transmits(p.wo, p.x)) return 0.0;
        const Vec3 here = half_vector_of(p.wo, p.x, 1);
        const auto there = moved_on_map(here, 2, 2 * std::numbers::pi * way.turns * shift,
                                        std::numbers::pi / 2 * way.quarter_turns * shift);
        if (!there || (*there)[2] < 0) return kNothingSaid;
        const double before = dot(p.wo, here), after = dot(p.wo, *there);
        const Vec3 wi = sum(scaled(*there, 2 * after), scaled(p.wo, -1));
        if (wi[2] * p.wo[2] <= 0) return kNothingSaid;
        const double sines = sine_from(*there, 2) / sine_from(here, 2);
        return pdf_at(*p.view, wi) * std::abs(after / before) * std::pow(sines, way.of_sine);
      };
      h.words = [=, words = std::string(way.words)](std::span<const double>) {
        return blame.function + " is that of half vectors moved by " + number(shift) + words;
      };
      list.push_back(std::move(h));
    }
  }
}

}  // namespace

std::vector<Hypothesis> shift_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                         bool of_value) {
  std::vector<Hypothesis> list;
  const ViewEvidence& view = evidence.views.front();
  const Domain& domain = view.pair->domain;
  const Asked ask = asked(of_value);
  if (domain.dimension() == 0) return list;
  if (has_wo(view)) {
    if (view.bsdf != nullptr && !of_value) add_shifted_half_vectors(list, blame);
    return list;
  }
  if (domain.directions()) {
    add_shifted_directions(list, blame, ask);
    add_shifted_points(list, Domain::octahedral(1), blame, ask);
    return list;
  }
  add_shifted_points(list, domain, blame, ask);
  if (domain.dimension() == 1) add_moved_on_line(list, evidence, blame, ask);
  return list;
}

}  // namespace plumbline::verify
