#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "diagnosis/geometry.h"
#include "diagnosis/hypothesis.h"
#include "text.h"

namespace plumbline::verify {

namespace {

using Moved = std::function<Vec3(const Place&)>;
using Asked = std::function<double(const Place&, const Vec3&)>;

/// Densities asked at another point, or values: what a prediction is over `base`.
Asked asked(bool of_value) {
  if (of_value) return [](const Place& p, const Vec3& x) { return value_at(*p.view, x); };
  return [](const Place& p, const Vec3& x) { return pdf_at(*p.view, x); };
}

Hypothesis at_another_point(CauseKind kind, double complexity, const Asked& ask, Moved moved,
                            std::string words) {
  Hypothesis h;
  h.kind = kind;
  h.complexity = complexity;
  h.prediction = [ask, moved = std::move(moved)](const Place& p, std::span<const double>) {
    return ask(p, moved(p));
  };
  h.words = [words = std::move(words)](std::span<const double>) { return words; };
  return h;
}

void add_swapped(std::vector<Hypothesis>& list, const Blame& blame, bool of_value) {
  Hypothesis h;
  h.kind = CauseKind::directions_swapped;
  h.complexity = 0.5;
  h.prediction = [of_value](const Place& p, std::span<const double>) {
    if (of_value) return f_at(*p.view, p.x, p.wo) * std::abs(p.x[2]);
    return pdf_at(*p.view, p.x, p.wo);
  };
  h.words = [blame](std::span<const double>) {
    return "wo and wi are exchanged in " + blame.function + ": " + blame.numerator +
           " is what it gives for (wi, wo)";
  };
  list.push_back(std::move(h));
  if (!of_value) return;
  Hypothesis with_cosine = list.back();
  with_cosine.complexity = 0.7;
  with_cosine.prediction = [](const Place& p, std::span<const double>) {
    return f_at(*p.view, p.x, p.wo) * std::abs(p.wo[2]);
  };
  list.push_back(std::move(with_cosine));
}

std::string signed_axes(const std::array<std::size_t, 3>& order, const Vec3& signs) {
  static constexpr const char* kAxes[] = {"x", "y", "z"};
  std::string text = "(";
  for (std::size_t i = 0; i < 3; ++i) {
    text += (i > 0 ? ", " : "");
    text += (signs[i] < 0 ? "−" : "");
    text += kAxes[order[i]];
  }
  return text + ")";
}

/// All axes exchanged and signs changed: 47 ways to mistake a direction.
void add_mirrored_directions(std::vector<Hypothesis>& list, const Blame& blame, const Asked& ask) {
  std::array<std::size_t, 3> order = {0, 1, 2};
  do {
    for (int bits = 0; bits < 8; ++bits) {
      const Vec3 signs = {bits & 1 ? -1.0 : 1.0, bits & 2 ? -1.0 : 1.0, bits & 4 ? -1.0 : 1.0};
      int moved = 0, turned = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        moved += order[i] != i ? 1 : 0;
        turned += signs[i] < 0 ? 1 : 0;
      }
      if (moved + turned == 0) continue;
      const double complexity = 1 + moved + 0.1 * turned;
      list.push_back(at_another_point(
          CauseKind::mirrored, complexity, ask,
          [order, signs](const Place& p) {
            return Vec3{signs[0] * p.x[order[0]], signs[1] * p.x[order[1]],
                        signs[2] * p.x[order[2]]};
          },
          "directions are mirrored between sample and " + blame.function + ": " + blame.numerator +
              " at (x, y, z) is that of " + signed_axes(order, signs)));
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

/// Turned around the normal (or any axis of a map) by an angle of its own.
void add_turned(std::vector<Hypothesis>& list, const Blame& blame, const Asked& ask) {
  Hypothesis h;
  h.kind = CauseKind::tangent_frame;
  h.complexity = 1;
  h.starts = {{0.1},  {0.4},  {0.8},  {1.3},  {2.0},  {2.8},
              {-0.1}, {-0.4}, {-0.8}, {-1.3}, {-2.0}, {-2.8}};
  h.prediction = [ask](const Place& p, std::span<const double> n) {
    const double c = std::cos(n[0]), s = std::sin(n[0]);
    return ask(p, {c * p.x[0] - s * p.x[1], s * p.x[0] + c * p.x[1], p.x[2]});
  };
  h.words = [blame](std::span<const double> n) {
    return "sample and " + blame.function + " are in tangent frames that are turned by " +
           number(n[0] * 180 / std::numbers::pi) + "° against each other";
  };
  list.push_back(h);
  // Of each view its own: a frame that depends on wo. Frames that agree from some directions, and
  // are half a turn off from others, are a sign that is mistaken there.
  h.per_view = true;
  h.charge = [](const std::vector<std::vector<double>>& angles) -> std::optional<double> {
    const bool any = std::any_of(angles.begin(), angles.end(), [](const auto& n) {
      return std::abs(std::remainder(n[0], std::numbers::pi)) > 1e-3;
    });
    return any ? std::optional(0.0) : std::nullopt;
  };
  list.push_back(std::move(h));
}

/// Signs that are mistaken from behind only: code that brings wo to the front and back.
void add_mirrored_behind(std::vector<Hypothesis>& list, const Blame& blame, const Asked& ask) {
  for (int bits = 1; bits < 8; ++bits) {
    const Vec3 signs = {bits & 1 ? -1.0 : 1.0, bits & 2 ? -1.0 : 1.0, bits & 4 ? -1.0 : 1.0};
    list.push_back(at_another_point(
        CauseKind::mirrored, 3, ask,
        [signs](const Place& p) {
          if (!(p.wo[2] < 0)) return p.x;
          return Vec3{signs[0] * p.x[0], signs[1] * p.x[1], signs[2] * p.x[2]};
        },
        "seen from behind, directions are mirrored between sample and " + blame.function + ": " +
            blame.numerator + " at (x, y, z) is that of " + signed_axes({0, 1, 2}, signs)));
  }
}

/// A density that moves with the square: per area of the domain, where the chart stretches.
Hypothesis on_square(CauseKind kind, double complexity, const Asked& ask,
                     std::function<Point2(const Point2&)> moved, std::string words) {
  Hypothesis h;
  h.kind = kind;
  h.complexity = complexity;
  h.prediction = [ask, moved = std::move(moved)](const Place& p, std::span<const double>) {
    const Chart& chart = p.view->pair->domain.chart();
    const Point2 here = chart.to_square(p.x), there = moved(here);
    return ask(p, chart.from_square(there)) * chart.element(there) / chart.element(here);
  };
  h.words = [words = std::move(words)](std::span<const double>) { return words; };
  return h;
}

void add_mirrored_points(std::vector<Hypothesis>& list, const Domain& domain, const Blame& blame,
                         const Asked& ask) {
  const std::string between = "between sample and " + blame.function;
  const auto add = [&](double complexity, std::function<Point2(const Point2&)> g,
                       const char* what) {
    list.push_back(on_square(CauseKind::mirrored, complexity, ask, std::move(g),
                             std::string(what) + " " + between));
  };
  if (domain.name() == "disk") {
    for (const auto& [signs, swap, words] :
         {std::tuple{Vec3{-1, 1, 1}, false, "x has its sign changed"},
          std::tuple{Vec3{1, -1, 1}, false, "y has its sign changed"},
          std::tuple{Vec3{-1, -1, 1}, false, "x and y have their signs changed"},
          std::tuple{Vec3{1, 1, 1}, true, "x and y are exchanged"}}) {
      list.push_back(at_another_point(
          CauseKind::mirrored, 1, ask,
          [s = signs, w = swap](const Place& p) {
            return Vec3{s[0] * p.x[w ? 1 : 0], s[1] * p.x[w ? 0 : 1], p.x[2]};
          },
          std::string(words) + " " + between));
    }
    return;
  }
  if (domain.name() == "triangle") {
    // Barycentric coordinates in another order.
    for (const auto& order : {std::array<std::size_t, 2>{1, 0}, std::array<std::size_t, 2>{0, 2},
                              std::array<std::size_t, 2>{2, 1}, std::array<std::size_t, 2>{1, 2},
                              std::array<std::size_t, 2>{2, 0}}) {
      list.push_back(at_another_point(
          CauseKind::mirrored, 1, ask,
          [order](const Place& p) {
            const Vec3 b = {p.x[0], p.x[1], 1 - p.x[0] - p.x[1]};
            return Vec3{b[order[0]], b[order[1]], 0};
          },
          "barycentric coordinates are in another order " + between));
    }
    return;
  }
  add(
      1,
      [](const Point2& p) {
        return Point2{1 - p[0], p[1]};
      },
      "the first coordinate runs the other way");
  if (domain.dimension() < 2) return;
  add(
      1,
      [](const Point2& p) {
        return Point2{p[0], 1 - p[1]};
      },
      "the second coordinate runs the other way");
  add(
      1,
      [](const Point2& p) {
        return Point2{1 - p[0], 1 - p[1]};
      },
      "both coordinates run the other way");
  add(
      1,
      [](const Point2& p) {
        return Point2{p[1], p[0]};
      },
      "the two coordinates are exchanged");
}

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

void add_shifted_points(std::vector<Hypothesis>& list, const Domain& domain, const Blame& blame,
                        const Asked& ask) {
  const auto coordinates = domain.dimension() == 1 ? 1u : 2u;
  for (const double shift : likely_shifts()) {
    for (std::size_t i = 0; i < coordinates; ++i) {
      list.push_back(on_square(
          CauseKind::shifted, 10 + (std::abs(shift) < 0.002 ? 1 : 0), ask,
          [i, shift](const Point2& p) {
            Point2 q = p;
            q[i] = wrapped(p[i] + shift);
            return q;
          },
          blame.function + " is that of samples moved by " + number(shift) + " of the " +
              (coordinates == 1 ? "interval"
               : i == 0         ? "first extent"
                                : "second extent") +
              " (a cell or half of one)"));
    }
  }
}

/// Azimuth or latitude of a map around an axis, moved.
Vec3 moved_on_map(const Vec3& w, std::size_t pole, double azimuth, double polar) {
  const std::size_t a = (pole + 1) % 3, b = (pole + 2) % 3;
  const double radius = std::hypot(w[a], w[b]);
  const double theta =
      std::clamp(std::atan2(radius, w[pole]) + polar, 1e-9, std::numbers::pi - 1e-9);
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
  constexpr double kPi = std::numbers::pi;
  for (const std::size_t pole : {std::size_t{2}, std::size_t{1}, std::size_t{0}}) {
    const std::string around = std::string(" around the ") + kAxes[pole] + " axis";
    const double rank = 10 + (pole == 2 ? 0 : pole == 1 ? 0.5 : 1);
    for (const double shift : likely_shifts()) {
      list.push_back(at_another_point(
          CauseKind::shifted, rank, ask,
          [=](const Place& p) { return moved_on_map(p.x, pole, 2 * kPi * shift, 0); },
          blame.function + " is that of directions turned by " + number(shift) + " of a turn" +
              around + " (a column or half of one)"));
      const std::string rows = blame.function + " is that of directions moved by " + number(shift) +
                               " of the latitudes" + around + " (a row or half of one)";
      list.push_back(at_another_point(
          CauseKind::shifted, rank + 0.1, ask,
          [=](const Place& p) { return moved_on_map(p.x, pole, 0, kPi * shift); }, rows));
      Hypothesis by_rows;
      by_rows.kind = CauseKind::shifted;
      by_rows.complexity = rank + 0.2;
      by_rows.prediction = [=](const Place& p, std::span<const double>) {
        const Vec3 moved = moved_on_map(p.x, pole, 0, kPi * shift);
        return ask(p, moved) * sine_from(moved, pole) / sine_from(p.x, pole);
      };
      by_rows.words = [rows](std::span<const double>) { return rows; };
      list.push_back(std::move(by_rows));
    }
    // sinθ of the middle of a row in place of that of the direction, or the reverse.
    for (int rows = 2; rows <= 2048; rows += rows < 160 ? 1 : rows) {
      for (const double power : {1.0, -1.0}) {
        Hypothesis h;
        h.kind = CauseKind::sine;
        h.complexity = rank;
        h.prediction = [=](const Place& p, std::span<const double>) {
          const double theta = std::acos(std::clamp(p.x[pole], -1.0, 1.0));
          const double middle = (std::floor(theta / kPi * rows) + 0.5) * kPi / rows;
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

void add_discrete(std::vector<Hypothesis>& list, const Domain& domain, const Blame& blame,
                  const Asked& ask) {
  const double size = static_cast<double>(domain.size());
  list.push_back(at_another_point(
      CauseKind::mirrored, 1, ask,
      [size](const Place& p) {
        return Vec3{size - 1 - p.x[0], 0, 0};
      },
      "indices run the other way between sample and " + blame.function));
  for (const double shift : {1.0, -1.0, 2.0, -2.0}) {
    list.push_back(at_another_point(
        CauseKind::shifted, 1 + std::abs(shift), ask,
        [=](const Place& p) {
          return Vec3{std::fmod(p.x[0] + shift + size, size), 0, 0};
        },
        blame.function + " is off by " + number(shift) + " in the index"));
  }
}

}  // namespace

std::vector<Hypothesis> argument_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                            bool of_value) {
  std::vector<Hypothesis> list;
  const ViewEvidence& view = evidence.views.front();
  const Domain& domain = view.pair->domain;
  const Asked ask = asked(of_value);
  if (domain.dimension() == 0) {
    add_discrete(list, domain, blame, ask);
  } else if (domain.directions()) {
    const bool bsdf = view.bsdf != nullptr && has_wo(view);
    if (bsdf) add_swapped(list, blame, of_value);
    add_mirrored_directions(list, blame, ask);
    if (bsdf) {
      add_turned(list, blame, ask);
      add_mirrored_behind(list, blame, ask);
    } else {
      add_shifted_directions(list, blame, ask);
    }
  } else {
    add_mirrored_points(list, domain, blame, ask);
    add_shifted_points(list, domain, blame, ask);
  }
  return list;
}

}  // namespace plumbline::verify
