#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/hypothesis.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

using Starts = std::vector<std::vector<double>>;

/// A planar light, by area for solid angle: dA = r²/cosθ_l dω and r = D/cosθ_l.
void add_planar_light(std::vector<Hypothesis>& list, const Blame& blame) {
  struct Form {
    double power;
    const char* words;
    double of_receiver = 0;  // power of the cosine at the shaded point, whose normal is z
  };
  const Form forms[] = {
      {-3, "density per area in place of solid angle in "},
      {-2, "r² missing from "},
      {-1, "cosθ at the light missing from "},
      {1, "cosθ at the light too many in "},
      {-4, "cosθ at the light multiplied instead of divided, and no r², in "},
      {2, "cosθ at the light multiplied instead of divided in "},
      {-1, "the cosine of the shaded point in place of that of the light in ", 1}};
  for (const Form& f : forms) {
    const auto add = [&](Starts starts, double complexity, bool fixed, std::size_t axis) {
      Hypothesis h;
      h.kind = CauseKind::distance_or_area;
      h.complexity = complexity;
      h.starts = std::move(starts);
      h.prediction = [=, power = f.power, receiver = f.of_receiver](const Place& p,
                                                                    std::span<const double> n) {
        double c = 0;
        if (fixed) {
          c = std::abs(p.x[axis]);
        } else {
          const double s = std::sin(n[1]);
          c = std::abs(s * std::cos(n[2]) * p.x[0] + s * std::sin(n[2]) * p.x[1] +
                       std::cos(n[1]) * p.x[2]);
        }
        return p.base * std::exp(n[0]) * std::pow(c, power) * std::pow(std::abs(p.x[2]), receiver);
      };
      h.words = [=, text = std::string(f.words)](std::span<const double>) {
        return text + blame.function + " (a planar light)";
      };
      list.push_back(std::move(h));
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      add({{0.0}}, 1 + (std::abs(f.power) < 2 ? 0.5 : 0), true, axis);
    }
    Starts starts;
    for (const double theta : {0.3, 0.8, 1.3}) {
      for (int k = 0; k < 8; ++k) starts.push_back({0.0, theta, 0.1 + k * 0.7854});
    }
    add(std::move(starts), 2, false, 0);
  }
}

/// A sphere as it is seen: the direction of its centre, and the sine of the angle that it spans.
struct SeenSphere {
  Vec3 axis{};
  double sine = 0;

  double sine_from_axis(const Vec3& x) const { return length(cross(axis, x)); }

  /// Cosine at the sphere where a ray meets it.
  double cosine(const Vec3& x) const {
    const double s = sine_from_axis(x) / sine;
    return std::sqrt(std::max(1e-12, 1 - s * s));
  }

  /// Distance to there, in units of that of the centre.
  double distance(const Vec3& x) const {
    const double s = sine_from_axis(x);
    return dot(axis, x) - std::sqrt(std::max(0.0, sine * sine - s * s));
  }
};

/// From where samples fall: they cover it all, about evenly around its centre.
std::optional<SeenSphere> seen_sphere(const ViewEvidence& view) {
  constexpr int kPerSide = 400;
  if (!view.pair->sample || view.pair->numbers > 2) return std::nullopt;
  const auto middle = [](int i) { return (i + 0.5) / kPerSide; };
  std::vector<Uniforms> inside, ends;
  for (int i = 0; i < kPerSide * kPerSide; ++i) {
    inside.push_back({middle(i % kPerSide), middle(i / kPerSide), 0});
  }
  std::vector<Vec3> points = points_of_density(ask(view.pair->sample, inside));
  Vec3 mean{};
  for (const Vec3& x : points) mean = sum(mean, x);
  // The border may lie at the end of a number.
  for (int i = 0; i < kPerSide; ++i) {
    for (const double end : {1e-12, 1 - 1e-12}) {
      ends.push_back({end, middle(i), 0});
      ends.push_back({middle(i), end, 0});
    }
  }
  const std::vector<Vec3> border = points_of_density(ask(view.pair->sample, ends));
  points.insert(points.end(), border.begin(), border.end());
  if (points.size() < 1000 || !(length(mean) > 0)) return std::nullopt;
  SeenSphere sphere{normalized(mean), 0};
  double lowest = 1;
  for (const Vec3& x : points) {
    sphere.sine = std::max(sphere.sine, sphere.sine_from_axis(x));
    lowest = std::min(lowest, dot(sphere.axis, x));
  }
  constexpr double kMost = 0.999;
  if (lowest < 0 || sphere.sine > kMost) return std::nullopt;
  return sphere;
}

/// A spherical light by its area: dA = r²/cosθ_l dω.
void add_spherical_light(std::vector<Hypothesis>& list, const ReportEvidence& evidence,
                         const Blame& blame) {
  const auto seen = seen_sphere(evidence.views.front());
  if (!seen) return;
  struct Form {
    double of_cosine, of_distance;
    const char* words;
  };
  const Form forms[] = {{-1, 0, "cosθ at the light missing from "},
                        {1, 0, "cosθ at the light too many in "},
                        {-2, 0, "cosθ at the light multiplied instead of divided in "},
                        {0, 1, "r in place of r² in "},
                        {0, 2, "r² missing from "},
                        {0, 4, "r² divided instead of multiplied in "},
                        {-1, 2, "density per area in place of solid angle in "}};
  const Vec3 other = std::abs(seen->axis[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 right = normalized(cross(other, seen->axis)), up = cross(seen->axis, right);
  for (const Form& f : forms) {
    Hypothesis h;
    h.kind = CauseKind::distance_or_area;
    h.complexity = 2;
    for (const double beyond : {1e-12, 1e-8, 1e-4}) {
      h.starts.push_back({0.0, std::log(seen->sine) + beyond, 0.0, 0.0});
    }
    h.prediction = [f, axis = seen->axis, right, up](const Place& p, std::span<const double> n) {
      const Vec3 turned = normalized(sum(axis, sum(scaled(right, n[2]), scaled(up, n[3]))));
      const SeenSphere sphere{turned, std::min(1.0, std::exp(n[1]))};
      return p.base * std::exp(n[0]) * std::pow(sphere.cosine(p.x), f.of_cosine) *
             std::pow(sphere.distance(p.x), f.of_distance);
    };
    h.words = [text = f.words + blame.function + " (a spherical light)"](std::span<const double>) {
      return text;
    };
    list.push_back(std::move(h));
  }
}

}  // namespace

std::vector<Hypothesis> light_hypotheses(const ReportEvidence& evidence, const Blame& blame) {
  std::vector<Hypothesis> list;
  const ViewEvidence& view = evidence.views.front();
  if (!view.pair->domain.directions() || (view.bsdf != nullptr && has_wo(view))) return list;
  add_planar_light(list, blame);
  add_spherical_light(list, evidence, blame);
  return list;
}

}  // namespace plumbline::verify
