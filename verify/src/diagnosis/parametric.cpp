#include <cmath>

#include "diagnosis/geometry.h"
#include "diagnosis/hypothesis.h"
#include "text.h"

namespace plumbline::verify {

namespace {

using Numbers = std::vector<std::vector<double>>;
using Starts = std::vector<std::vector<double>>;

Vec3 half_of(const Place& p) { return half_vector_of(p.wo, p.x, p.view->eta); }

/// log α.
Starts roughness_starts() { return {{-5.5}, {-4.0}, {-3.0}, {-2.0}, {-1.2}, {-0.6}, {0.0}}; }

std::string alpha(double log_alpha) { return "α = " + number(std::exp(log_alpha)); }

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
      {"Beckmann", 0.4, [](const Place& p, double a) { return beckmann_d(half_of(p), a); }}};
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
            return std::abs(right - wrong) > kApart ? std::optional(0.0) : std::nullopt;
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

void add_fresnel(std::vector<Hypothesis>& list, const ReportEvidence& evidence,
                 const Blame& blame) {
  struct Cosine {
    const char* name;
    double rank;
    std::function<double(const Place&)> value;
  };
  const Cosine cosines[] = {{"wo·h", 0, [](const Place& p) { return dot(p.wo, half_of(p)); }},
                            {"cosθo", 0.3, [](const Place& p) { return p.wo[2]; }},
                            {"cosθi", 0.4, [](const Place& p) { return p.x[2]; }}};
  // What F is of the number n: exact with the index of the BSDF, with any, and Schlick's.
  struct Law {
    double rank;
    Starts starts;
    const char* name;
    std::function<double(const Place&, double cosine, std::span<const double>)> f;
  };
  std::vector<Law> laws = {
      {0,
       {{-3.2}, {-1.0}, {0.5}},
       "Schlick",
       [](const Place&, double c, auto n) {
         return fresnel_schlick(c, 1 / (1 + std::exp(-n[0])));
       }},
      {0.1, {{0.4}, {-0.4}, {0.1}}, "dielectric", [](const Place&, double c, auto n) {
         return fresnel_dielectric(c, std::exp(n[0]));
       }}};
  if (evidence.views.front().eta != 1) {
    laws.push_back({0, {}, "of the index given", [](const Place& p, double c, auto) {
                      const double eta = p.view->eta;
                      return fresnel_dielectric(c, p.wo[2] < 0 ? 1 / eta : eta);
                    }});
  }
  struct Form {
    const char* words;
    double rank;
    CauseKind kind;
    std::function<double(double f, bool through)> ratio;
  };
  const Form forms[] = {
      {"F of reflection and 1 − F of transmission are missing from ", 0,
       CauseKind::lobe_probability, [](double f, bool through) { return through ? 1 - f : f; }},
      {"F and 1 − F choose the side, a half stands for either in ", 1, CauseKind::fresnel,
       [](double f, bool through) { return 2 * (through ? 1 - f : f); }},
      {"F of reflection and 1 − F of transmission are exchanged in ", 1, CauseKind::fresnel,
       [](double f, bool through) { return through ? (1 - f) / f : f / (1 - f); }},
      {"F of reflection is missing from ", 1, CauseKind::fresnel,
       [](double f, bool through) { return through ? 1 : f; }},
      {"F of reflection is too many in ", 1.1, CauseKind::fresnel,
       [](double f, bool through) { return through ? 1 : 1 / f; }},
      {"F of reflection stands for 1 − F of transmission in ", 1, CauseKind::fresnel,
       [](double f, bool through) { return through ? (1 - f) / f : 1; }},
      {"1 − F of transmission is missing from ", 1, CauseKind::fresnel,
       [](double f, bool through) { return through ? 1 - f : 1; }},
      {"1 − F of transmission is too many in ", 1.1, CauseKind::fresnel,
       [](double f, bool through) { return through ? 1 / (1 - f) : 1; }},
      {"1 − F is missing from ", 2, CauseKind::fresnel, [](double f, bool) { return 1 - f; }},
      {"1 − F is too many in ", 2.1, CauseKind::fresnel,
       [](double f, bool) { return 1 / (1 - f); }}};
  for (const Cosine& c : cosines) {
    for (const Law& law : laws) {
      for (const Form& form : forms) {
        Hypothesis h;
        h.kind = form.kind;
        h.complexity = 1 + c.rank + law.rank + form.rank;
        h.starts = law.starts;
        h.prediction = [cosine = c.value, f = law.f, ratio = form.ratio](
                           const Place& p, std::span<const double> n) {
          return p.base * ratio(f(p, cosine(p), n), transmits(p.wo, p.x));
        };
        h.words = [text = std::string(form.words) + blame.function + " (Fresnel, " + law.name +
                          ", of " + c.name + ")"](std::span<const double>) { return text; };
        list.push_back(std::move(h));
      }
    }
  }
}

/// The side is chosen by F of one cosine, and pdf() has F of another.
void add_other_fresnel(std::vector<Hypothesis>& list, const Blame& blame) {
  struct Cosine {
    const char* name;
    double (*value)(const Place&);
  };
  constexpr Cosine kOfSurface{"cosθo", [](const Place& p) { return p.wo[2]; }};
  constexpr Cosine kOfHalf{"wo·h", [](const Place& p) { return dot(p.wo, half_of(p)); }};
  for (const auto& [right, wrong] :
       {std::pair{kOfSurface, kOfHalf}, std::pair{kOfHalf, kOfSurface}}) {
    Hypothesis h;
    h.kind = CauseKind::fresnel;
    h.complexity = 2;
    h.prediction = [r = right.value, w = wrong.value](const Place& p, std::span<const double>) {
      const double eta = p.wo[2] < 0 ? 1 / p.view->eta : p.view->eta;
      const double f = fresnel_dielectric(r(p), eta), g = fresnel_dielectric(w(p), eta);
      return p.base * (transmits(p.wo, p.x) ? (1 - f) / (1 - g) : f / g);
    };
    h.words = [text = std::string("the side is chosen by F of ") + right.name + ", but " +
                      blame.function + " has F of " +
                      wrong.name](std::span<const double>) { return text; };
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
    if (view.eta != 1) add_other_fresnel(list, blame);
  } else {
    add_axial(list, blame);
  }
  return list;
}

}  // namespace plumbline::verify
