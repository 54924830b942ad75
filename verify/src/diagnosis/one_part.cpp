#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "diagnosis/geometry.h"
#include "diagnosis/hypothesis.h"
#include "diagnosis/part_explanations.h"
#include "text.h"

namespace plumbline::verify {

namespace {

/// Which parts may be wrong together: any, of a few; of many each one, or all but one.
std::vector<std::vector<bool>> groups_of(std::size_t parts) {
  constexpr std::size_t kFew = 4;
  std::vector<std::vector<bool>> groups;
  for (std::size_t k = 0; k < parts; ++k) {
    groups.emplace_back(parts, false);
    groups.back()[k] = true;
  }
  if (parts <= 2) return groups;
  if (parts > kFew) {
    for (std::size_t k = 0; k < parts; ++k) {
      groups.emplace_back(parts, true);
      groups.back()[k] = false;
    }
    return groups;
  }
  for (std::size_t bits = 1; bits + 1 < std::size_t{1} << parts; ++bits) {
    std::vector<bool> group;
    for (std::size_t k = 0; k < parts; ++k) group.push_back((bits >> k & 1) != 0);
    if (std::count(group.begin(), group.end(), true) > 1) groups.push_back(std::move(group));
  }
  return groups;
}

/// What pdf() has in the place of the probabilities P and 1 − P of two ways.
struct Mistaken {
  const char* words;
  double (*first)(double p);
  double (*second)(double p);  ///< of the first way's probability as well
};

constexpr double one(double) { return 1; }
constexpr double half(double) { return 0.5; }
constexpr double right(double p) { return p; }
constexpr double other(double p) { return 1 - p; }
constexpr double squared(double p) { return p * p; }
constexpr double other_squared(double p) { return (1 - p) * (1 - p); }

constexpr Mistaken kMistaken[] = {{"are missing from pdf()", one, one},
                                  {"are exchanged in pdf()", other, right},
                                  {"are a half each in pdf()", half, half},
                                  {"are there twice in pdf()", squared, other_squared},
                                  {": the first is missing from pdf()", one, other},
                                  {": the second is missing from pdf()", right, one},
                                  {": the first is there twice in pdf()", squared, other},
                                  {": the second is there twice in pdf()", right, other_squared},
                                  {": pdf() has that of the first for both", right, right},
                                  {": pdf() has that of the second for both", other, other}};

/// ∫pdf() is what it is if the parts have the factor that an explanation says: a factor of what is
/// never sampled explains nothing.
bool adds_up(const Apart& apart, const std::vector<bool>& group, const Explanation& e,
             std::span<const double> numbers) {
  constexpr double kPulls = 5, kAllowed = 1e-3;
  const MassSeen& mass = *apart.view().mass;
  const auto predicted = apart.excess_of(group, e.hypothesis->prediction, numbers);
  const double seen = mass.integral + mass.atoms + mass.rejected + apart.view().stray_share - 1;
  const double error = mass.integral_error + mass.rejected_error + kPulls * predicted.error;
  return std::abs(seen - predicted.value) <= error + kAllowed + 0.02 * std::abs(seen);
}

bool is_constant(const Observations& seen) {
  Hypothesis h;
  h.starts = {{0.0}, {1.0}, {-1.0}};
  h.prediction = [](const Place& p, std::span<const double> n) { return p.base * std::exp(n[0]); };
  return !explain(seen, {h}).empty();
}

/// Multiples of both probabilities for which pdf() is their sum, by least squares on every other
/// point; nothing if the others contradict it.
std::optional<std::array<double, 2>> multiples_in(const Apart& apart) {
  double aa = 0, ab = 0, bb = 0, a = 0, b = 0;
  const auto& equations = apart.equations();
  for (std::size_t i = 0; i < equations.size(); i += 2) {
    const double x = equations[i].parts[0].contribution(), y = equations[i].parts[1].contribution();
    aa += x * x, ab += x * y, bb += y * y, a += x, b += y;
  }
  const double det = aa * bb - ab * ab;
  if (!(det > 1e-6 * aa * bb)) return std::nullopt;
  const std::array<double, 2> found{(bb * a - ab * b) / det, (aa * b - ab * a) / det};
  const double tolerance = tolerance_of_parts(*apart.view().pair);
  double off = 0, tested = 0;
  for (std::size_t i = 1; i < equations.size(); i += 2, ++tested) {
    const Equation& e = equations[i];
    const double sum = found[0] * e.parts[0].contribution() + found[1] * e.parts[1].contribution();
    off += std::abs(sum - 1) <= 10 * tolerance + 4 * e.error ? 0 : 1;
  }
  if (off > kMissed * tested || !(found[0] > 0) || !(found[1] > 0)) return std::nullopt;
  return found;
}

bool explains(const Apart& apart, const Mistaken& m) {
  const double tolerance = tolerance_of_parts(*apart.view().pair);
  double off = 0;
  for (const Equation& e : apart.equations()) {
    double sum = 0, error = e.error;
    for (std::size_t k = 0; k < 2; ++k) {
      const double p = e.parts[k].probability;
      sum += e.parts[k].q * (k == 0 ? m.first(p) : m.second(1 - p));
    }
    off += std::abs(sum - 1) <= tolerance + 4 * error ? 0 : 1;
  }
  return off <= kMissed * static_cast<double>(apart.equations().size());
}

}  // namespace

std::optional<Finding> PartExplanations::by_two_ways() {
  for (const Mistaken& m : kMistaken) {
    std::size_t tested = 0;
    bool all = true;
    for (const auto& apart : views()) {
      if (!apart->known() || apart->fixed()) continue;
      ++tested;
      all = all && explains(*apart, m);
    }
    if (tested == 0) return std::nullopt;
    if (!all) continue;
    return Finding{CauseKind::lobe_probability,
                   std::string("the probabilities of the two ways that a random number chooses, "
                               "which depend on the others,") +
                       (m.words[0] == ':' ? "" : " ") + m.words};
  }
  for (const auto& apart : views()) {
    if (!apart->known() || apart->fixed() || !apart->view().failed) continue;
    const auto multiples = multiples_in(*apart);
    if (!multiples) return std::nullopt;
    return Finding{CauseKind::lobe_probability,
                   "pdf() has the densities of the two ways that a random number chooses " +
                       number(multiples->front()) + " and " + number(multiples->back()) +
                       " times as large as they are chosen"};
  }
  return std::nullopt;
}

namespace {

/// pdf() = P q + (1 − P) r of two parts, solved for the P that it has at each point, over 1.
std::vector<ExactPoint> probabilities_in_pdf(const Apart& apart) {
  constexpr double kLeast = 0.05, kMargin = 1e-6;
  std::vector<ExactPoint> points;
  for (const Equation& e : apart.equations()) {
    const double q = e.parts[0].q, r = e.parts[1].q;
    const double apart_by = q - r;
    const double p = (1 - r) / apart_by;
    if (!(std::abs(apart_by) > kLeast) || !(p > kMargin) || !(p < 1)) continue;
    ExactPoint point;
    point.place = {&apart.view(), apart.view().wo.value_or(Vec3{}), e.x, 1};
    point.ratio = p;
    const double error = std::max(e.error, tolerance_of_parts(*apart.view().pair) / 4);
    point.error = error * std::max(q, r) / std::abs(apart_by) / p;
    points.push_back(point);
  }
  return points;
}

std::vector<Hypothesis> laws_of_fresnel(bool first, double eta) {
  struct Cosine {
    const char* name;
    double (*value)(const Place&);
  };
  constexpr Cosine kCosines[] = {{"wo·h", [](const Place& p) { return dot(p.wo, half_of(p)); }},
                                 {"cosθi", [](const Place& p) { return std::abs(p.x[2]); }}};
  std::vector<Hypothesis> list;
  for (const Cosine& c : kCosines) {
    const auto add = [&](std::vector<std::vector<double>> starts, const char* law, auto f) {
      Hypothesis h;
      h.kind = CauseKind::fresnel;
      h.starts = std::move(starts);
      h.prediction = [=, cosine = c.value](const Place& p, std::span<const double> n) {
        const double reflected = f(p, cosine(p), n);
        return first ? reflected : 1 - reflected;
      };
      h.words = [=, name = std::string(c.name)](std::span<const double>) {
        return "pdf() weighs its two parts by F and 1 − F of " + name + " (" + law +
               "), but they are chosen by a number that knows wo alone";
      };
      list.push_back(std::move(h));
    };
    add({{-3.2}, {-1.0}, {0.5}}, "Schlick", [](const Place&, double x, auto n) {
      return fresnel_schlick(x, 1 / (1 + std::exp(-n[0])));
    });
    add({{0.4}, {0.1}, {0.8}}, "dielectric",
        [](const Place&, double x, auto n) { return fresnel_dielectric(x, std::exp(n[0])); });
    // Weighed by how bright the parts are: F/(F + (1 − F) k).
    const auto weighed = [](double reflected, double k) {
      return reflected / (reflected + (1 - reflected) * std::exp(k));
    };
    add({{-3.2, 0}, {-3.2, -1}, {-1.0, 0}}, "Schlick, weighed by albedos",
        [weighed](const Place&, double x, auto n) {
          return weighed(fresnel_schlick(x, 1 / (1 + std::exp(-n[0]))), n[1]);
        });
    add({{0.4, 0}, {0.4, -1}, {0.1, 0}}, "dielectric, weighed by albedos",
        [weighed](const Place&, double x, auto n) {
          return weighed(fresnel_dielectric(x, std::exp(n[0])), n[1]);
        });
    if (eta == 1) continue;
    add({}, "dielectric, of the index given", [](const Place& p, double x, auto) {
      return fresnel_dielectric(x, p.wo[2] < 0 ? 1 / p.view->eta : p.view->eta);
    });
  }
  return list;
}

}  // namespace

std::optional<Finding> PartExplanations::by_fresnel() {
  constexpr std::size_t kFewest = 20;
  std::vector<ExactOfView> exact;
  for (const auto& apart : views()) {
    if (!apart->known() || !apart->fixed() || apart->count() != 2) continue;
    if (!apart->view().wo || apart->view().bsdf == nullptr) continue;
    exact.push_back({&apart->view(), probabilities_in_pdf(*apart)});
    if (exact.back().points.size() < kFewest) return std::nullopt;
  }
  if (exact.empty()) return std::nullopt;
  const Observations seen = Observations::of_points(evidence_, exact, kMissed);
  if (is_constant(seen)) return std::nullopt;
  for (const bool first : {true, false}) {
    const auto laws = laws_of_fresnel(first, exact.front().view->eta);
    const auto found = explain(seen, laws);
    if (found.empty()) continue;
    return Finding{CauseKind::fresnel,
                   found.front().hypothesis->words(found.front().numbers.front())};
  }
  return std::nullopt;
}

std::optional<CostedCause> PartExplanations::in_one_part() {
  constexpr std::size_t kFewest = 16;
  constexpr double kAlike = 2;  // several parts wrong in the same way are a little less likely
  std::vector<const Apart*> known;
  for (const auto& apart : views()) {
    if (apart->known()) known.push_back(apart.get());
  }
  if (known.empty()) return std::nullopt;
  const std::size_t parts = known.front()->count();
  // From behind the parts may be others.
  std::erase_if(known, [&](const Apart* a) {
    return a->count() != parts || a->fixed() != known.front()->fixed();
  });
  std::optional<CostedCause> best;
  for (const std::vector<bool>& group : groups_of(parts)) {
    std::vector<ExactOfView> exact;
    std::size_t points = 0;
    for (const Apart* apart : known) {
      auto of_view = apart->densities_of(group);
      if (!of_view) break;
      points += of_view->size();
      exact.push_back({&apart->view(), std::move(*of_view)});
    }
    if (exact.size() != known.size() || points < kFewest) continue;
    const Observations seen = Observations::of_points(evidence_, exact, kMissed);
    if (seen.empty() || seen.judge(as_stated).admissible) continue;
    // A constant of a part is its probability, and not a function that hardly varies.
    if (is_constant(seen)) continue;
    const Blame blame{"pdf() of " + known.front()->name_of(group), "the density of its samples"};
    const auto alike = static_cast<double>(std::count(group.begin(), group.end(), true) - 1);
    std::vector<Hypothesis> all = factor_hypotheses(evidence_, blame, seen);
    for (auto&& list :
         {parametric_hypotheses(evidence_, blame, seen), number_hypotheses(evidence_, blame)}) {
      all.insert(all.end(), list.begin(), list.end());
    }
    for (const Explanation& e : explain(seen, all)) {
      const bool adds = std::all_of(known.begin(), known.end(), [&](const Apart* apart) {
        const auto at = static_cast<std::size_t>(&apart->view() - evidence_.views.data());
        return adds_up(*apart, group, e, e.numbers[at]);
      });
      if (!adds) continue;
      const double cost = e.cost + kAlike * alike;
      const CauseKind kind = e.hypothesis->kind;
      if (!best || cost < best->cost) {
        const bool other = best && best->cause.kind != kind;
        const Cause before = best ? best->cause : Cause{};
        best =
            CostedCause{cost, {kind, e.hypothesis->words(e.numbers.front()), {}, CauseKind::none}};
        if (other) {
          best->cause.second = before.headline;
          best->cause.second_kind = before.kind;
        }
      } else if (kind != best->cause.kind && best->cause.second.empty()) {
        best->cause.second = e.hypothesis->words(e.numbers.front());
        best->cause.second_kind = kind;
      }
    }
  }
  return best;
}

}  // namespace plumbline::verify
