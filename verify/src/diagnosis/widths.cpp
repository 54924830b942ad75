#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "diagnosis/geometry.h"
#include "diagnosis/hypothesis.h"
#include "text.h"

/// Lobes around any axis (a fibre, the mirror direction, one of their own) and stretched ones,
/// whose width differs between sample and pdf.
namespace plumbline::verify {

namespace {

using Starts = std::vector<std::vector<double>>;
using Numbers = std::vector<std::vector<double>>;

/// Roughnesses that hardly differ are a sign of something else.
constexpr double kApart = 0.01;

/// Shapes of a lobe over a length t in units of its width, without their normalisation.
struct Shape {
  const char* name;
  double (*logarithm)(double t);
};
constexpr Shape kShapes[] = {
    {"Gaussian", [](double t) { return -t * t / 2; }},
    {"logistic", [](double t) { return -std::abs(t) - 2 * std::log1p(std::exp(-std::abs(t))); }}};

/// The inclination to a fibre, from that of the cone that wo is reflected to.
void add_inclinations(std::vector<Hypothesis>& list, const Blame& blame) {
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    const auto from_cone = [axis](const Place& p) {
      const auto inclination = [axis](const Vec3& w) {
        return std::asin(std::min(1.0, std::max(-1.0, w[axis])));
      };
      return inclination(p.x) + inclination(p.wo);
    };
    for (const Shape& shape : kShapes) {
      const auto add = [&](double complexity, Starts starts, auto widths) {
        Hypothesis h;
        h.kind = CauseKind::roughness;
        h.complexity = complexity;
        h.needs_exact = true;
        h.starts = std::move(starts);
        h.prediction = [=, f = shape.logarithm](const Place& p, std::span<const double> n) {
          const auto [right, wrong] = widths(n);
          const double t = from_cone(p);
          return p.base * std::exp(n[0] + f(t / std::exp(right)) - f(t / std::exp(wrong)));
        };
        h.charge = [widths](const Numbers& n) -> std::optional<double> {
          const auto [right, wrong] = widths(n.front());
          return std::abs(right - wrong) > kApart ? std::optional(0.0) : std::nullopt;
        };
        h.words = [=, name = std::string(shape.name)](std::span<const double> n) {
          const auto [right, wrong] = widths(n);
          return "the width of the lobe in the inclination to the fibre (along " +
                 std::string(axis == 0 ? "x" : "y") + ") is " + number(std::exp(wrong)) + " in " +
                 blame.function + ", " + number(std::exp(right)) + " in the samples (" + name + ")";
        };
        list.push_back(std::move(h));
      };
      add(5, {{0, -0.4}, {0, -1.0}, {0, -1.8}}, [](std::span<const double> n) {
        return std::pair{n[1], 2 * n[1]};
      });
      add(5, {{0, -0.4}, {0, -1.0}, {0, -1.8}}, [](std::span<const double> n) {
        return std::pair{2 * n[1], n[1]};
      });
      add(6, {{0, -1, -1.5}, {0, -1.5, -1}, {0, -2.2, -1.2}, {0, -1.2, -2.2}},
          [](std::span<const double> n) {
            return std::pair{n[1], n[2]};
          });
    }
  }
}

/// exp(κ c) of another concentration around a direction that wo gives.
void add_concentrations(std::vector<Hypothesis>& list, const Blame& blame) {
  struct Form {
    const char* name;
    double (*cosine)(const Place&);
  };
  constexpr Form kForms[] = {
      {"exp(κ c), c the cosine to the mirror direction",
       [](const Place& p) { return p.wo[2] * p.x[2] - p.wo[0] * p.x[0] - p.wo[1] * p.x[1]; }},
      {"exp(κ c), c the cosine to wo", [](const Place& p) { return dot(p.wo, p.x); }},
      {"exp(κ c), c the cosine of the half vector", [](const Place& p) { return half_of(p)[2]; }},
      {"exp(−κ tan²), of the half vector's angle", [](const Place& p) {
         const double c = half_of(p)[2];
         return -(1 - c * c) / (c * c);
       }}};
  for (const Form& f : kForms) {
    Hypothesis h;
    h.kind = CauseKind::roughness;
    h.complexity = 4;
    h.needs_exact = true;
    h.starts = {{0.0, 1.0}, {0.0, -1.0}, {0.0, 10.0}, {0.0, -10.0}};
    h.prediction = [cosine = f.cosine](const Place& p, std::span<const double> n) {
      return p.base * std::exp(n[0] + n[1] * cosine(p));
    };
    h.words = [=, name = std::string(f.name)](std::span<const double> n) {
      return "the concentration in " + blame.function + " is off by " + number(-n[1]) + " (" +
             name + ", with a factor of " + number(std::exp(n[0])) + ")";
    };
    list.push_back(std::move(h));
  }
}

/// Roughnesses along x and y.
struct Stretched {
  double x = 1, y = 1;
};

double ggx_stretched(const Place& p, const Stretched& a) {
  const Vec3 h = half_of(p);
  const double s = h[0] * h[0] / (a.x * a.x) + h[1] * h[1] / (a.y * a.y) + h[2] * h[2];
  return 1 / (a.x * a.y * s * s);
}
double beckmann_stretched(const Place& p, const Stretched& a) {
  const Vec3 h = half_of(p);
  const double s = h[0] * h[0] / (a.x * a.x) + h[1] * h[1] / (a.y * a.y);
  return std::exp(-s / (h[2] * h[2])) / (a.x * a.y);
}
double ggx_masking(const Vec3& w, const Stretched& a) {
  const double t = (w[0] * w[0] * a.x * a.x + w[1] * w[1] * a.y * a.y) / (w[2] * w[2]);
  return 2 / (1 + std::sqrt(1 + t));
}

/// Two roughnesses in a lobe: exchanged, squared, one of them for both.
void add_stretched(std::vector<Hypothesis>& list, const Blame& blame) {
  struct Form {
    const char* name;
    double (*d)(const Place&, const Stretched&);
  };
  constexpr Form kForms[] = {{"GGX", ggx_stretched},
                             {"GGX, visible normals",
                              [](const Place& p, const Stretched& a) {
                                return ggx_stretched(p, a) * ggx_masking(p.wo, a);
                              }},
                             {"GGX with correlated masking",
                              [](const Place& p, const Stretched& a) {
                                return ggx_stretched(p, a) /
                                       (1 / ggx_masking(p.wo, a) + 1 / ggx_masking(p.x, a) - 1);
                              }},
                             {"Beckmann or Ward", beckmann_stretched}};
  struct Mistake {
    const char* words;
    Stretched (*wrong)(const Stretched&);
  };
  constexpr Mistake kMistakes[] = {{"exchanged",
                                    [](const Stretched& a) {
                                      return Stretched{a.y, a.x};
                                    }},
                                   {"squared",
                                    [](const Stretched& a) {
                                      return Stretched{a.x * a.x, a.y * a.y};
                                    }},
                                   {"taken the root of",
                                    [](const Stretched& a) {
                                      return Stretched{std::sqrt(a.x), std::sqrt(a.y)};
                                    }},
                                   {"both that along x",
                                    [](const Stretched& a) {
                                      return Stretched{a.x, a.x};
                                    }},
                                   {"both that along y",
                                    [](const Stretched& a) {
                                      return Stretched{a.y, a.y};
                                    }},
                                   {"both their mean", [](const Stretched& a) {
                                      return Stretched{std::sqrt(a.x * a.y), std::sqrt(a.x * a.y)};
                                    }}};
  for (const Form& f : kForms) {
    for (const Mistake& m : kMistakes) {
      Hypothesis h;
      h.kind = CauseKind::roughness;
      h.complexity = 2;
      h.needs_exact = true;
      h.starts = {{-2.2, -0.8}, {-0.8, -2.2}, {-1.4, -0.7}, {-0.7, -1.4}};
      h.prediction = [d = f.d, wrong = m.wrong](const Place& p, std::span<const double> n) {
        const Stretched a{std::exp(n[0]), std::exp(n[1])};
        return p.base * d(p, a) / d(p, wrong(a));
      };
      // As round as that, one number says the same.
      h.charge = [](const Numbers& n) -> std::optional<double> {
        const bool stretched = std::abs(n.front()[0] - n.front()[1]) > kApart;
        return stretched ? std::optional(0.0) : std::nullopt;
      };
      h.words = [=, mistake = std::string(m.words),
                 name = std::string(f.name)](std::span<const double> n) {
        return "the roughnesses along x and y, " + number(std::exp(n[0])) + " and " +
               number(std::exp(n[1])) + ", are " + mistake + " in " + blame.function + " (" + name +
               ")";
      };
      list.push_back(std::move(h));
    }
  }
}

}  // namespace

std::vector<Hypothesis> width_hypotheses(const ReportEvidence& evidence, const Blame& blame) {
  std::vector<Hypothesis> list;
  const ViewEvidence& view = evidence.views.front();
  if (!view.pair->domain.directions() || view.bsdf == nullptr || !has_wo(view)) return list;
  add_inclinations(list, blame);
  add_concentrations(list, blame);
  add_stretched(list, blame);
  return list;
}

}  // namespace plumbline::verify
