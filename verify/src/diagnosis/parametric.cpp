#include <cmath>
#include <optional>

#include "diagnosis/geometry.h"
#include "diagnosis/hypothesis.h"
#include "text.h"

namespace plumbline::verify {

namespace {

using Numbers = std::vector<std::vector<double>>;
using Starts = std::vector<std::vector<double>>;

/// log α.
Starts roughness_starts() { return {{-5.5}, {-4.0}, {-3.0}, {-2.0}, {-1.2}, {-0.6}, {0.0}}; }

std::string alpha(double log_alpha) { return "α = " + number(std::exp(log_alpha)); }

/// Roughnesses that renderers have. A fit that ends elsewhere has found the shape of another fault.
bool is_roughness(double log_alpha) {
  constexpr double kLeast = 1e-5, kMost = 1.001;
  return std::exp(log_alpha) >= kLeast && std::exp(log_alpha) <= kMost;
}

std::optional<double> if_roughnesses(const Numbers& n) {
  for (const double log_alpha : n.front()) {
    if (!is_roughness(log_alpha)) return std::nullopt;
  }
  return 0;
}

std::string of_missing(double power, const Blame& blame) {
  return (power > 0 ? " missing from " : " too many in ") + blame.function;
}

void add_masking(std::vector<Hypothesis>& list, const Blame& blame) {
  struct Form {
    const char* name;
    double rank;
    std::function<double(const Place&, double)> g;
  };
  const Form forms[] = {
      {"G1(wo)", 0, [](const Place& p, double a) { return smith_g1(p.wo, a); }},
      {"G1(wi)", 1, [](const Place& p, double a) { return smith_g1(p.x, a); }},
      {"G1(wo) G1(wi)", 2,
       [](const Place& p, double a) { return smith_g1(p.wo, a) * smith_g1(p.x, a); }},
      {"G1(wo)/G1(wi)", 3,
       [](const Place& p, double a) { return smith_g1(p.wo, a) / smith_g1(p.x, a); }},
      {"G1 of both directions together", 4,
       [](const Place& p, double a) {
         // Height-correlated: 1/(1 + Λo + Λi). @source Heitz 2014 (JCGT 3:2), Eq. 99
         return 1 / (1 / smith_g1(p.wo, a) + 1 / smith_g1(p.x, a) - 1);
       }},
      {"the part of G beyond G1(wo)", 4, [](const Place& p, double a) {
         return 1 / (1 / smith_g1(p.wo, a) + 1 / smith_g1(p.x, a) - 1) / smith_g1(p.wo, a);
       }}};
  for (const Form& f : forms) {
    for (const double power : {1.0, -1.0}) {
      Hypothesis h;
      h.kind = CauseKind::masking;
      h.complexity = f.rank;
      h.starts = roughness_starts();
      h.charge = if_roughnesses;
      h.prediction = [g = f.g, power](const Place& p, std::span<const double> n) {
        return p.base * std::pow(g(p, std::exp(n[0])), power);
      };
      h.words = [name = std::string(f.name), power, blame](std::span<const double> n) {
        return "masking " + name + of_missing(power, blame) + " (GGX, " + alpha(n[0]) + ")";
      };
      list.push_back(h);
      // With visible normals against all: D cosθh/(4 wo·h) for G1 D/(4 cosθo), and the reverse.
      if (f.rank > 0) continue;
      h.complexity = 3;
      h.prediction = [power](const Place& p, std::span<const double> n) {
        const Vec3 m = half_of(p);
        const double visible =
            smith_g1(p.wo, std::exp(n[0])) * std::abs(dot(p.wo, m)) / std::abs(p.wo[2] * m[2]);
        return p.base * std::pow(visible, power);
      };
      h.words = [power, blame](std::span<const double> n) {
        return std::string(power > 0 ? "visible normals are sampled, but all normals are in "
                                     : "all normals are sampled, but visible ones are in ") +
               blame.function + " (GGX, " + alpha(n[0]) + ")";
      };
      list.push_back(h);
    }
  }
  Hypothesis other;
  other.kind = CauseKind::masking;
  other.starts = {{-1.0, -2.0}, {-2.0, -1.0}, {-0.5, -3.0}, {-3.0, -0.5}};
  other.charge = if_roughnesses;
  other.prediction = [](const Place& p, std::span<const double> n) {
    return p.base * smith_g1(p.wo, std::exp(n[0])) / smith_g1(p.wo, std::exp(n[1]));
  };
  other.words = [blame](std::span<const double> n) {
    return "G1(wo) in " + blame.function + " is of another roughness, " + alpha(n[1]) + " for " +
           alpha(n[0]);
  };
  list.push_back(other);
  other.prediction = [](const Place& p, std::span<const double> n) {
    return p.base * smith_g1(p.x, std::exp(n[0])) / smith_g1(p.x, std::exp(n[1]));
  };
  list.push_back(other);
  other.prediction = [](const Place& p, std::span<const double> n) {
    const double right = std::exp(n[0]), wrong = std::exp(n[1]);
    return p.base * smith_g1(p.x, right) * smith_g1(p.wo, right) / smith_g1(p.x, wrong) /
           smith_g1(p.wo, wrong);
  };
  list.push_back(other);
  const auto together = [](const Place& p, double a) {
    return 1 / (1 / smith_g1(p.wo, a) + 1 / smith_g1(p.x, a) - 1);
  };
  other.words = [blame](std::span<const double> n) {
    return "G of both directions in " + blame.function + " is of another roughness, " +
           alpha(n[1]) + " for " + alpha(n[0]);
  };
  other.prediction = [together](const Place& p, std::span<const double> n) {
    return p.base * together(p, std::exp(n[0])) / together(p, std::exp(n[1]));
  };
  list.push_back(other);
}

/// Distributions of normals with two roughnesses.
void add_roughness(std::vector<Hypothesis>& list, const Blame& blame) {
  using D = std::function<double(const Place&, double)>;
  struct Form {
    const char* name;
    double rank;
    D d;
  };
  const Form forms[] = {
      {"GGX", 0, [](const Place& p, double a) { return ggx_d(half_of(p), a); }},
      {"GGX, visible normals", 0.1,
       [](const Place& p, double a) { return ggx_d(half_of(p), a) * smith_g1(p.wo, a); }},
      {"GGX with masking", 0.2,
       [](const Place& p, double a) {
         return ggx_d(half_of(p), a) * smith_g1(p.wo, a) * smith_g1(p.x, a);
       }},
      {"GGX with correlated masking", 0.3,
       [](const Place& p, double a) {
         return ggx_d(half_of(p), a) / (1 / smith_g1(p.wo, a) + 1 / smith_g1(p.x, a) - 1);
       }},
      {"Beckmann", 0.4, [](const Place& p, double a) { return beckmann_d(half_of(p), a); }},
      // @source Burley 2012, Physically-based shading at Disney, Eq. 4
      {"GTR of exponent 1", 0.5, [](const Place& p, double a) {
         const double c = half_of(p)[2], a2 = a * a;
         return (a2 - 1) / (std::log(a2) * (1 + (a2 - 1) * c * c));
       }}};
  for (const Form& f : forms) {
    const auto add =
        [&](double complexity, Starts starts,
            const std::function<std::pair<double, double>(std::span<const double>)>& two) {
          Hypothesis h;
          h.kind = CauseKind::roughness;
          h.complexity = complexity;
          h.starts = std::move(starts);
          h.prediction = [d = f.d, two](const Place& p, std::span<const double> n) {
            const auto [right, wrong] = two(n);
            return p.base * d(p, std::exp(right)) / d(p, std::exp(wrong));
          };
          // Two that hardly differ are a sign of something else.
          h.charge = [two](const auto& numbers) -> std::optional<double> {
            constexpr double kApart = 0.01;
            const auto [right, wrong] = two(numbers.front());
            const bool sane = is_roughness(right) && is_roughness(wrong);
            return sane && std::abs(right - wrong) > kApart ? std::optional(0.0) : std::nullopt;
          };
          h.words = [two, name = std::string(f.name), blame](std::span<const double> n) {
            const auto [right, wrong] = two(n);
            return "the roughness in " + blame.function + " is another: " + alpha(wrong) +
                   " there, " + alpha(right) + " elsewhere (" + name + ")";
          };
          list.push_back(std::move(h));
        };
    const Starts one = {{-0.1}, {-0.3}, {-0.7}, {-1.2}, {-2.0}, {-3.0}};
    add(f.rank, one, [](std::span<const double> n) { return std::pair{n[0], 2 * n[0]}; });
    add(f.rank, one, [](std::span<const double> n) { return std::pair{2 * n[0], n[0]}; });
    Starts both;
    for (const double a : {-4.5, -3.0, -2.0, -1.2, -0.6, -0.1}) {
      for (const double ratio : {-0.7, -0.1, 0.1, 0.7}) both.push_back({a, a + ratio});
    }
    add(f.rank, std::move(both), [](std::span<const double> n) { return std::pair{n[0], n[1]}; });
  }
}

/// A power of a cosine with its normalisation: Phong lobes, cos^n warps.
void add_exponents(std::vector<Hypothesis>& list, bool bsdf, const Blame& blame) {
  struct Form {
    const char* name;
    std::function<double(const Place&)> cosine;
  };
  std::vector<Form> forms = {{"cosθ", [](const Place& p) { return std::abs(p.x[2]); }}};
  if (bsdf) {
    forms.push_back({"cosθh", [](const Place& p) { return std::abs(half_of(p)[2]); }});
    forms.push_back(
        {"the cosine to wo", [](const Place& p) { return std::max(0.0, dot(p.wo, p.x)); }});
    forms.push_back({"the cosine to the mirror direction", [](const Place& p) {
                       return std::max(0.0, p.wo[2] * p.x[2] - p.wo[0] * p.x[0] - p.wo[1] * p.x[1]);
                     }});
  }
  for (const Form& f : forms) {
    Hypothesis h;
    h.kind = CauseKind::roughness;
    h.complexity = 3;
    h.starts = {{0.0, 1.5}, {0.0, -1.5}, {0.0, 20.0}, {0.0, -20.0}};
    h.prediction = [cosine = f.cosine](const Place& p, std::span<const double> n) {
      return p.base * std::exp(n[0]) * std::pow(cosine(p), n[1]);
    };
    h.words = [name = std::string(f.name), blame](std::span<const double> n) {
      return "the exponent of " + name + " in " + blame.function + " is off by " + number(-n[1]) +
             ", with a factor of " + number(std::exp(n[0]));
    };
    list.push_back(std::move(h));
  }
}

/// Phase functions and lobes around an axis: another width, or the other sign.
void add_axial(std::vector<Hypothesis>& list, const Blame& blame) {
  const auto hg = [](double c, double g) {
    return (1 - g * g) / std::pow(1 + g * g - 2 * g * c, 1.5);
  };
  for (const std::size_t axis : {std::size_t{2}, std::size_t{1}, std::size_t{0}}) {
    Hypothesis h;
    h.kind = CauseKind::mirrored;
    h.complexity = axis == 2 ? 0 : 1;
    h.starts = {{0.8}, {-0.8}, {0.2}, {-0.2}};
    h.prediction = [=](const Place& p, std::span<const double> n) {
      const double g = std::tanh(n[0]);
      return p.base * hg(p.x[axis], g) / hg(p.x[axis], -g);
    };
    h.words = [=](std::span<const double> n) {
      return "g has the other sign in " + blame.function +
             " (Henyey-Greenstein, g = " + number(std::tanh(n[0])) + ")";
    };
    list.push_back(h);
    h.kind = CauseKind::roughness;
    h.starts = {{0.3, 0.6}, {0.6, 0.3}, {-0.3, -0.6}, {-0.6, -0.3}, {1.5, 1.0}, {1.0, 1.5}};
    h.prediction = [=](const Place& p, std::span<const double> n) {
      return p.base * hg(p.x[axis], std::tanh(n[0])) / hg(p.x[axis], std::tanh(n[1]));
    };
    h.words = [=](std::span<const double> n) {
      return "g is " + number(std::tanh(n[1])) + " in " + blame.function + ", " +
             number(std::tanh(n[0])) + " in the samples (Henyey-Greenstein)";
    };
    list.push_back(h);
    h.starts = {{0.0, 1.0}, {0.0, -1.0}};
    h.complexity += 1;
    h.prediction = [=](const Place& p, std::span<const double> n) {
      return p.base * std::exp(n[0] + n[1] * p.x[axis]);
    };
    h.words = [=](std::span<const double> n) {
      return "the concentration in " + blame.function + " is off by " + number(-n[1]) +
             " (exp(κ cosθ), with a factor of " + number(std::exp(n[0])) + ")";
    };
    list.push_back(std::move(h));
  }
}

/// Along an interval: exp(−k x) of another rate.
void add_rates(std::vector<Hypothesis>& list, const Blame& blame) {
  Hypothesis h;
  h.kind = CauseKind::constant;
  h.complexity = 3;
  h.starts = {{0.0, 1.0}, {0.0, -1.0}, {0.0, 0.1}, {0.0, -0.1}};
  h.prediction = [](const Place& p, std::span<const double> n) {
    return p.base * std::exp(n[0] + n[1] * p.x[0]);
  };
  h.words = [=](std::span<const double> n) {
    return "the rate of the exponential in " + blame.function + " is off by " + number(n[1]) +
           ", with a factor of " + number(std::exp(n[0]));
  };
  list.push_back(h);
  h.kind = CauseKind::radius;
  h.needs_exact = true;
  h.prediction = [](const Place& p, std::span<const double> n) {
    const double t = p.view->pair->domain.chart().to_square(p.x)[0];
    return p.base * std::exp(n[0]) * std::pow(t, n[1]);
  };
  h.words = [=](std::span<const double> n) {
    return "a power of x in " + blame.function + " is off by " + number(-n[1]) +
           ", with a factor of " + number(std::exp(n[0]));
  };
  list.push_back(std::move(h));
}

}  // namespace

std::vector<Hypothesis> parametric_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                              const Observations&) {
  std::vector<Hypothesis> list;
  const ViewEvidence& view = evidence.views.front();
  const Domain& domain = view.pair->domain;
  if (domain.dimension() == 1) add_rates(list, blame);
  if (!domain.directions()) return list;
  const bool bsdf = view.bsdf != nullptr && has_wo(view);
  add_exponents(list, bsdf, blame);
  if (bsdf) {
    add_masking(list, blame);
    add_roughness(list, blame);
    add_fresnel(list, evidence, blame);
  } else {
    add_axial(list, blame);
  }
  return list;
}

}  // namespace plumbline::verify
