#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "diagnosis/frames.h"
#include "diagnosis/geometry.h"
#include "diagnosis/hypothesis.h"
#include "diagnosis/shifts.h"
#include "text.h"

namespace plumbline::verify {

namespace {

using Moved = std::function<Vec3(const Place&)>;

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

void add_swapped(std::vector<Hypothesis>& list, const Blame& blame, bool of_value, double eta) {
  Hypothesis h;
  h.kind = CauseKind::directions_swapped;
  // A refraction's f with both exchanged differs by η² alone.
  h.complexity = of_value && eta != 1 ? 3 : 0.5;
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
  with_cosine.complexity += 0.2;
  with_cosine.prediction = [](const Place& p, std::span<const double>) {
    return f_at(*p.view, p.x, p.wo) * std::abs(p.wo[2]);
  };
  list.push_back(std::move(with_cosine));
}

/// Both directions with x and y exchanged: the two roughnesses of an anisotropic lobe.
void add_axes_exchanged(std::vector<Hypothesis>& list, const Blame& blame, bool of_value) {
  Hypothesis h;
  h.kind = CauseKind::mirrored;
  h.complexity = 1;
  h.prediction = [of_value](const Place& p, std::span<const double>) {
    const Vec3 wo{p.wo[1], p.wo[0], p.wo[2]}, wi{p.x[1], p.x[0], p.x[2]};
    return of_value ? f_at(*p.view, wo, wi) * std::abs(wi[2]) : pdf_at(*p.view, wo, wi);
  };
  h.words = [blame](std::span<const double>) {
    return "x and y are exchanged in " + blame.function + ": " + blame.numerator +
           " is what it gives for both directions with x and y exchanged (as with the roughnesses "
           "along x and y)";
  };
  list.push_back(std::move(h));
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

/// The azimuth from wo's around an axis, of a fibre along x or y, with its sign changed: mirrored
/// in the plane of the axis and wo.
void add_azimuth_negated(std::vector<Hypothesis>& list, const Blame& blame, const Asked& ask) {
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    list.push_back(at_another_point(
        CauseKind::mirrored, 0.4, ask,
        [axis](const Place& p) {
          Vec3 along{};
          along[axis] = 1;
          const Vec3 across = cross(along, p.wo);
          const double size = length(across);
          if (!(size > 0)) return p.x;
          const Vec3 n = scaled(across, 1 / size);
          return sum(p.x, scaled(n, -2 * dot(n, p.x)));
        },
        "the azimuth around the " + std::string(axis == 0 ? "x" : "y") +
            " axis, counted from that of wo, has " + "the other sign in " + blame.function));
  }
}

/// Directions of points of the whole cube, where those outside the ball ought to be rejected: r³/3
/// of the way to the border, of the cube's volume 8.
void add_corners_of_cube(std::vector<Hypothesis>& list, const Blame& blame) {
  Hypothesis h;
  h.kind = CauseKind::not_rejected;
  h.complexity = 2;
  h.prediction = [](const Place& p, std::span<const double>) {
    const double most = std::max({std::abs(p.x[0]), std::abs(p.x[1]), std::abs(p.x[2])});
    return 1 / (24 * most * most * most);
  };
  h.words = [blame](std::span<const double>) {
    return "points of the cube outside the ball are not rejected, where " + blame.function +
           " is that of the ball";
  };
  list.push_back(std::move(h));
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
  Hypothesis even;
  even.kind = CauseKind::choice_probability;
  even.complexity = 1;
  even.prediction = [size](const Place&, std::span<const double>) { return 1 / size; };
  even.words = [blame](std::span<const double>) {
    return "all are chosen alike, whatever " + blame.function + " says";
  };
  list.push_back(std::move(even));
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
    if (bsdf) {
      add_swapped(list, blame, of_value, view.eta);
      add_axes_exchanged(list, blame, of_value);
    }
    add_mirrored_directions(list, blame, ask);
    if (bsdf) {
      add_azimuth_negated(list, blame, ask);
      add_turned(list, blame, ask);
      add_mirrored_behind(list, blame, ask);
      if (view.stray_share > 0) add_turned_as_a_whole(list, evidence, blame, ask);
    } else {
      add_turned_as_a_whole(list, evidence, blame, ask);
      if (!of_value) add_corners_of_cube(list, blame);
    }
  } else {
    add_mirrored_points(list, domain, blame, ask);
  }
  std::vector<Hypothesis> shifts = shift_hypotheses(evidence, blame, of_value);
  std::move(shifts.begin(), shifts.end(), std::back_inserter(list));
  return list;
}

}  // namespace plumbline::verify
