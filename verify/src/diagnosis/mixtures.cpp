#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/geometry.h"
#include "diagnosis/hypothesis.h"
#include "text.h"

namespace plumbline::verify {

namespace {

using std::numbers::pi;

double logistic(double x) { return 1 / (1 + std::exp(-x)); }

double lobe_sum(const Place& p, const std::function<double(std::size_t)>& share) {
  double sum = 0;
  for (std::size_t i = 0; i < p.view->pair->lobes.size(); ++i) {
    const double s = share(i);
    if (s > 0) sum += s * p.view->pair->lobes[i].pdf(p.x);
  }
  return sum;
}

/// Lobes that are exposed: the density is a sum of theirs, with other probabilities than the pdf's.
void add_exposed(std::vector<Hypothesis>& list, const ReportEvidence& evidence,
                 const Blame& blame) {
  const std::size_t count = evidence.views.front().pair->lobes.size();
  Hypothesis stated;
  stated.kind = CauseKind::lobe_probability;
  stated.complexity = 0.8;
  stated.prediction = [](const Place& p, std::span<const double>) {
    const auto& lobes = p.view->pair->lobes;
    return lobe_sum(p, [&lobes](std::size_t i) { return lobes[i].probability; });
  };
  stated.words = [blame](std::span<const double>) {
    return "the probabilities of the lobes are missing from, or wrong in, " + blame.function +
           ": " + blame.numerator + " is Σ probability · lobe pdf";
  };
  list.push_back(std::move(stated));

  Hypothesis equal = list.back();
  equal.complexity = 0.9;
  equal.prediction = [](const Place& p, std::span<const double>) {
    return lobe_sum(
        p, [&](std::size_t) { return 1 / static_cast<double>(p.view->pair->lobes.size()); });
  };
  equal.words = [](std::span<const double>) {
    return std::string("lobes are chosen with equal probabilities, the pdf has others");
  };
  list.push_back(std::move(equal));

  Hypothesis any = list.back();
  any.complexity = 1;
  any.per_view = true;
  any.starts.assign(1, std::vector<double>(count, -1.0));
  any.prediction = [](const Place& p, std::span<const double> n) {
    return lobe_sum(p, [n](std::size_t i) { return i < n.size() ? std::exp(n[i]) : 0.0; });
  };
  any.words = [](std::span<const double> n) {
    std::string text = "lobes are chosen with other probabilities than the pdf has: here ";
    for (std::size_t i = 0; i < n.size(); ++i) {
      text += (i > 0 ? ", " : "") + number(std::exp(n[i]));
    }
    return text;
  };
  list.push_back(std::move(any));
}

/// A density that stands beside another in many a mixture, and needs nothing to be known of it.
struct Companion {
  const char* name;
  std::function<double(const Place&)> density;
  double rank;
};

double side_of(const Place& p) { return has_wo(*p.view) && p.wo[2] < 0 ? -1 : 1; }

std::vector<Companion> companions(bool both_sides) {
  std::vector<Companion> list = {
      {"diffuse", [](const Place& p) { return std::max(0.0, side_of(p) * p.x[2]) / pi; }, 0},
      {"uniform", [](const Place& p) { return side_of(p) * p.x[2] > 0 ? 1 / (2 * pi) : 0; }, 0.5}};
  if (both_sides) {
    list.push_back({"uniform on the whole sphere", [](const Place&) { return 1 / (4 * pi); }, 1});
    list.push_back({"diffuse transmission",
                    [](const Place& p) { return std::max(0.0, -side_of(p) * p.x[2]) / pi; }, 1});
  }
  return list;
}

/// d = A p + B c for the companion's density c: probabilities P, 1 − P that p has as P', 1 − P'
/// (A + B = 1), lacks altogether (B = 1 − 2A), lacks in one of the two.
void add_companion_probability(std::vector<Hypothesis>& list, const Companion& c,
                               const Blame& blame) {
  struct Form {
    double rank;
    const char* words;
    std::function<double(double)> own, other;
  };
  const auto one = [](double) { return 1.0; };
  const Form forms[] = {
      {0, "the lobes' probabilities are missing from ", [](double a) { return logistic(a); },
       [](double a) { return 1 - 2 * logistic(a); }},
      {1, "lobes are chosen with other probabilities than those in ",
       [](double a) { return std::exp(a); }, [](double a) { return 1 - std::exp(a); }},
      {2, "the probability of this lobe is wrong in, or missing from, ", one,
       [](double a) { return a; }},
      {3, "the probability of the other lobe is missing from ",
       [](double a) { return logistic(a); },
       [](double a) { return (1 - logistic(a)) * (1 - logistic(a)); }}};
  for (const Form& form : forms) {
    for (const bool by_view : {false, true}) {
      Hypothesis h;
      h.kind = CauseKind::lobe_probability;
      h.complexity = 4 + form.rank + c.rank;
      h.per_view = by_view;
      h.needs_exact = by_view || c.rank > 0;
      h.starts = {{-0.5}, {0.5}};
      h.prediction = [density = c.density, own = form.own, other = form.other](
                         const Place& p, std::span<const double> n) {
        return std::max(0.0, own(n[0]) * p.base + other(n[0]) * density(p));
      };
      h.words = [text = std::string(form.words) + blame.function,
                 name = std::string(c.name)](std::span<const double>) {
        return text + " (a mixture with a lobe that is " + name + ")";
      };
      list.push_back(std::move(h));
    }
  }
  Hypothesis any = list.back();
  any.complexity = 9 + c.rank;
  any.per_view = false;
  any.starts = {{0.7, 0.3}};
  any.prediction = [density = c.density](const Place& p, std::span<const double> n) {
    return std::max(0.0, n[0] * p.base + n[1] * density(p));
  };
  // Without a part of the companion it is a constant for each view, which explains nothing.
  any.charge = [](const std::vector<std::vector<double>>& numbers) -> std::optional<double> {
    constexpr double kPart = 0.05;
    double part = 0;
    for (const auto& n : numbers) part = std::max(part, std::abs(n[1]));
    return part > kPart ? std::optional(0.0) : std::nullopt;
  };
  any.words = [name = std::string(c.name), blame](std::span<const double>) {
    return "the probabilities of the lobes are wrong in " + blame.function +
           " (a mixture with a lobe that is " + name + ")";
  };
  list.push_back(any);
  any.per_view = true;
  list.push_back(std::move(any));
}

struct LobeFactor {
  const char* name;
  CauseKind kind;
  std::function<double(const Place&)> value;
};

std::vector<LobeFactor> lobe_factors() {
  const auto woh = [](const Place& p) { return std::abs(dot(p.wo, half_of(p))); };
  const auto wh = [](const Place& p) { return std::abs(half_of(p)[2]); };
  return {
      {"1/(4 wo·h)", CauseKind::half_vector_jacobian,
       [woh](const Place& p) { return 1 / (4 * woh(p)); }},
      {"cosθh", CauseKind::cosine, wh},
      {"1/cosθh", CauseKind::cosine, [wh](const Place& p) { return 1 / wh(p); }},
      {"wo·h", CauseKind::half_vector_jacobian, woh},
      {"1/(wo·h)", CauseKind::half_vector_jacobian, [woh](const Place& p) { return 1 / woh(p); }},
      {"1/4", CauseKind::half_vector_jacobian, [](const Place&) { return 0.25; }},
      {"4", CauseKind::half_vector_jacobian, [](const Place&) { return 4.0; }},
      {"cosθh/(4 wo·h)", CauseKind::half_vector_jacobian,
       [woh, wh](const Place& p) { return wh(p) / (4 * woh(p)); }},
      {"cosθi", CauseKind::cosine, [](const Place& p) { return std::abs(p.x[2]); }},
      {"1/cosθi", CauseKind::cosine, [](const Place& p) { return 1 / std::abs(p.x[2]); }},
      {"cosθo", CauseKind::cosine, [](const Place& p) { return std::abs(p.wo[2]); }},
      {"1/cosθo", CauseKind::cosine, [](const Place& p) { return 1 / std::abs(p.wo[2]); }}};
}

/// p = w c + s with a factor missing from s: d = w c + X (p − w c).
void add_factor_of_other_lobe(std::vector<Hypothesis>& list, const Companion& c,
                              const Blame& blame) {
  for (const LobeFactor& f : lobe_factors()) {
    for (const bool by_view : {false, true}) {
      Hypothesis h;
      h.kind = f.kind;
      h.complexity = 3 + c.rank;
      h.per_view = by_view;
      h.starts = {{-2.0}, {0.0}, {2.0}};
      h.prediction = [density = c.density, value = f.value](const Place& p,
                                                            std::span<const double> n) {
        const double beside = logistic(n[0]) * density(p);
        return beside + value(p) * std::max(0.0, p.base - beside);
      };
      h.words = [name = std::string(f.name), beside = std::string(c.name),
                 blame](std::span<const double>) {
        return "factor " + name + " missing from " + blame.function +
               " of one lobe (beside one that is " + beside + ")";
      };
      list.push_back(std::move(h));
    }
  }
  for (const double power : {1.0, -1.0}) {
    Hypothesis h;
    h.kind = CauseKind::masking;
    h.complexity = 3 + c.rank;
    h.starts = {{0.0, -3.0}, {0.0, -2.0}, {0.0, -1.0}, {0.0, -0.3}};
    h.prediction = [density = c.density, power](const Place& p, std::span<const double> n) {
      const double beside = logistic(n[0]) * density(p);
      return beside +
             std::pow(smith_g1(p.wo, std::exp(n[1])), power) * std::max(0.0, p.base - beside);
    };
    h.words = [power, blame](std::span<const double> n) {
      return std::string("G1(wo) of the visible normals ") +
             (power > 0 ? "missing from " : "too many in ") + blame.function +
             " of one lobe (GGX, α = " + number(std::exp(n[1])) + ")";
    };
    list.push_back(std::move(h));
  }
}

/// p = w q + s with another density q where samples have c.
void add_other_companion(std::vector<Hypothesis>& list, const Companion& samples,
                         const Companion& stated, CauseKind kind, const Blame& blame) {
  for (const bool by_view : {false, true}) {
    Hypothesis h;
    h.kind = kind;
    h.complexity = 5;
    h.per_view = by_view;
    h.starts = {{-1.0}, {1.0}};
    h.prediction = [a = samples.density, b = stated.density](const Place& p,
                                                             std::span<const double> n) {
      return std::max(0.0, p.base + logistic(n[0]) * (a(p) - b(p)));
    };
    h.words = [text = "one lobe is sampled as " + std::string(samples.name) + ", but " +
                      std::string(stated.name) + " in " +
                      blame.function](std::span<const double>) { return text; };
    list.push_back(std::move(h));
  }
}

/// One lobe with wo and wi exchanged beside one that knows wi alone: p = q(wi, wo) + w (c(wi) −
/// c(wo)).
void add_swapped_beside(std::vector<Hypothesis>& list, const Companion& c, const Blame& blame) {
  Hypothesis h;
  h.kind = CauseKind::directions_swapped;
  h.complexity = 3 + c.rank;
  h.starts = {{-1.0}, {1.0}};
  h.prediction = [density = c.density](const Place& p, std::span<const double> n) {
    const Place turned{p.view, p.x, p.wo, 0};
    return std::max(0.0,
                    pdf_at(*p.view, p.x, p.wo) + logistic(n[0]) * (density(p) - density(turned)));
  };
  h.words = [name = std::string(c.name), blame](std::span<const double>) {
    return "wo and wi are exchanged in " + blame.function + " of one lobe (beside one that is " +
           name + ")";
  };
  list.push_back(std::move(h));
}

void add_another_density(std::vector<Hypothesis>& list, const std::vector<Companion>& companions,
                         const Blame& blame) {
  for (const Companion& c : companions) {
    Hypothesis h;
    h.kind = CauseKind::weight;
    h.complexity = 6 + c.rank;
    h.prediction = [density = c.density](const Place& p, std::span<const double>) {
      return density(p);
    };
    h.words = [name = std::string(c.name), blame](std::span<const double>) {
      return blame.numerator + " is " + name + ", whatever " + blame.function + " says";
    };
    // What should have been sampled is not known: named only where nothing else is, in words.
    h.kind = CauseKind::chosen_lobe_only;
    list.push_back(std::move(h));
  }
}

}  // namespace

std::vector<Hypothesis> mixture_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                           const Observations&) {
  std::vector<Hypothesis> list;
  const ViewEvidence& view = evidence.views.front();
  if (view.pair->lobes.size() > 1) add_exposed(list, evidence, blame);
  if (view.bsdf == nullptr || !has_wo(view)) return list;
  const std::vector<Companion> beside = companions(true);
  add_companion_probability(list, beside[0], blame);
  add_companion_probability(list, beside[1], blame);
  add_swapped_beside(list, beside[0], blame);
  add_factor_of_other_lobe(list, beside[0], blame);
  add_factor_of_other_lobe(list, beside[1], blame);
  add_other_companion(list, beside[0], beside[1], CauseKind::cosine, blame);
  add_other_companion(list, beside[1], beside[0], CauseKind::cosine, blame);
  const Companion unscaled{"cosθ without 1/π",
                           [c = beside[0].density](const Place& p) { return pi * c(p); }, 0};
  add_other_companion(list, beside[0], unscaled, CauseKind::constant, blame);
  add_another_density(list, beside, blame);
  return list;
}

}  // namespace plumbline::verify
