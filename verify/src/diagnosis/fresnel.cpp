#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include "diagnosis/geometry.h"
#include "diagnosis/hypothesis.h"
#include "text.h"

namespace plumbline::verify {

namespace {

using Starts = std::vector<std::vector<double>>;

using FresnelLaw = std::function<double(const Place&, double cosine, std::span<const double>)>;

/// Whether F is 1 from wherever a view looks, as beyond the critical angle: no Fresnel term shows.
bool all_is_reflected(const ReportEvidence& evidence, const FresnelLaw& f,
                      std::span<const double> number) {
  return std::all_of(evidence.views.begin(), evidence.views.end(), [&](const ViewEvidence& v) {
    constexpr double kAll = 0.999;
    return has_wo(v) && f({.view = &v, .wo = *v.wo, .x = *v.wo}, (*v.wo)[2], number) > kAll;
  });
}

void add_one_fresnel(std::vector<Hypothesis>& list, const ReportEvidence& evidence,
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
    FresnelLaw f;
    double least = 0, most = 0;  ///< of the number; beyond them it is 0 or 1, a constant
  };
  std::vector<Law> laws = {
      {0,
       {{-3.2}, {-1.0}, {0.5}},
       "Schlick",
       [](const Place&, double c, auto n) { return fresnel_schlick(c, 1 / (1 + std::exp(-n[0]))); },
       -7,
       7},
      {0.1,
       {{0.4}, {-0.4}, {0.1}},
       "dielectric",
       [](const Place&, double c, auto n) { return fresnel_dielectric(c, std::exp(n[0])); },
       -1.4,
       1.4}};
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
        // Of cosθo alone it is a constant for each view, which counts cannot tell from others.
        h.needs_exact = std::string_view(c.name) == "cosθo" && !law.starts.empty();
        h.starts = law.starts;
        if (!law.starts.empty()) {
          h.charge = [&evidence, law](const auto& n) -> std::optional<double> {
            const double x = n.front().front();
            if (!(law.least < x && x < law.most)) return std::nullopt;
            return all_is_reflected(evidence, law.f, n.front()) ? std::nullopt : std::optional(0.0);
          };
        }
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

/// The side is chosen with a probability that is none of F's, and pdf() has F.
void add_fresnel_for_choice(std::vector<Hypothesis>& list, const Blame& blame) {
  struct Cosine {
    const char* name;
    double (*value)(const Place&);
  };
  constexpr Cosine kCosines[] = {{"wo·h", [](const Place& p) { return dot(p.wo, half_of(p)); }},
                                 {"cosθo", [](const Place& p) { return p.wo[2]; }},
                                 {"cosθi", [](const Place& p) { return p.x[2]; }}};
  for (const Cosine& c : kCosines) {
    Hypothesis h;
    h.kind = CauseKind::fresnel;
    h.complexity = 3;
    h.per_view = true;
    h.needs_exact = true;
    h.starts = {{-2.0}, {0.0}, {2.0}};
    h.prediction = [cosine = c.value](const Place& p, std::span<const double> n) {
      const double eta = p.wo[2] < 0 ? 1 / p.view->eta : p.view->eta;
      const double f = fresnel_dielectric(cosine(p), eta), chosen = 1 / (1 + std::exp(-n[0]));
      return p.base * (transmits(p.wo, p.x) ? (1 - chosen) / (1 - f) : chosen / f);
    };
    h.words = [blame, name = std::string(c.name)](std::span<const double> n) {
      return "reflection is chosen with a probability (here " + number(1 / (1 + std::exp(-n[0]))) +
             ") that is the same for all normals, but " + blame.function + " has F of " + name;
    };
    list.push_back(std::move(h));
  }
}

}  // namespace

void add_fresnel(std::vector<Hypothesis>& list, const ReportEvidence& evidence,
                 const Blame& blame) {
  add_one_fresnel(list, evidence, blame);
  if (evidence.views.front().eta == 1) return;
  add_other_fresnel(list, blame);
  add_fresnel_for_choice(list, blame);
}

}  // namespace plumbline::verify
