#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/geometry.h"
#include "diagnosis/hypothesis.h"
#include "text.h"

namespace plumbline::verify {

namespace {

/// Something that densities have as a factor.
struct Factor {
  std::string name;
  CauseKind kind = CauseKind::none;
  std::function<double(const Place&)> value;
  double rank = 1;
  /// What its lack and its excess are called, where not "factor … missing from".
  std::string lack = {}, excess = {};
  bool alone = false;  ///< a constant: not with another, nor beside other factors
};

/// Where a factor counts: in a BSDF that reflects and transmits, often on one side only.
enum class Part { all, reflection, transmission };

Factor on_part(const Factor& f, Part part) {
  if (part == Part::all) return f;
  const bool through = part == Part::transmission;
  Factor g = f;
  g.name += through ? " in transmission" : " in reflection";
  g.value = [value = f.value, through](const Place& p) {
    return transmits(p.wo, p.x) == through ? value(p) : 1.0;
  };
  g.rank += 1;
  return g;
}

void add_of_directions(std::vector<Factor>& list, bool bsdf) {
  const char* cosine = bsdf ? "cosθi" : "cosθ";
  list.push_back({cosine, CauseKind::cosine, [](const Place& p) { return std::abs(p.x[2]); }});
  list.push_back(
      {"sinθ", CauseKind::sine, [](const Place& p) { return std::hypot(p.x[0], p.x[1]); }});
  // Of another pole: lights and maps are written with y up as often as not, fibres lie along x or
  // y.
  for (const std::size_t axis : {std::size_t{1}, std::size_t{0}}) {
    const std::string of = axis == 1 ? " from the y axis" : " from the x axis";
    if (!bsdf) {
      list.push_back({"cosθ" + of, CauseKind::cosine,
                      [axis](const Place& p) { return std::abs(p.x[axis]); }, 3});
    }
    list.push_back(
        {bsdf ? "cosine of the inclination to the fibre (sinθ" + of + ")" : "sinθ" + of,
         bsdf ? CauseKind::cosine : CauseKind::sine,
         [axis](const Place& p) { return std::sqrt(std::max(0.0, 1 - p.x[axis] * p.x[axis])); },
         3});
  }
}

void add_of_half_vectors(std::vector<Factor>& list) {
  const auto woh = [](const Place& p) { return std::abs(dot(p.wo, half_of(p))); };
  list.push_back(
      {"cosθo", CauseKind::cosine, [](const Place& p) { return std::abs(p.wo[2]); }, 1.5});
  list.push_back({"4 (wo·h)", CauseKind::half_vector_jacobian,
                  [woh](const Place& p) { return 4 * woh(p); }, 1, "",
                  "the half-vector Jacobian 1/(4 wo·h) is missing from"});
  list.push_back({"(wo·h)", CauseKind::half_vector_jacobian, woh, 1.2});
  // Of a density of normals, D cosθh: a cosine, though it is lost together with the Jacobian.
  list.push_back(
      {"cosθh", CauseKind::cosine, [](const Place& p) { return std::abs(half_of(p)[2]); }, 1.1});
  // Of a density of slopes: D cos⁴θh, or cos³θh with the cosine of a density of normals.
  for (const auto& [name, power] : {std::pair{"cos³θh", 3}, {"cos⁴θh", 4}}) {
    list.push_back({name, CauseKind::cosine,
                    [n = power](const Place& p) { return std::pow(std::abs(half_of(p)[2]), n); },
                    1.4});
  }
  list.push_back({"sinθh", CauseKind::sine,
                  [](const Place& p) {
                    const Vec3 m = half_of(p);
                    return std::hypot(m[0], m[1]);
                  },
                  1.3});
}

/// The true Jacobian of a refraction over what may stand in its place.
void add_of_refraction(std::vector<Factor>& list) {
  using J = std::function<double(const Vec3&, const Vec3&, const Vec3&, double, double)>;
  const auto add = [&list](const char* name, double rank, const J& instead) {
    list.push_back({name, CauseKind::refraction_jacobian,
                    [instead](const Place& p) {
                      if (!transmits(p.wo, p.x)) return 1.0;
                      const double eta = p.view->eta;
                      const Vec3 h = half_vector_of(p.wo, p.x, eta);
                      const double o = index_of(p.wo, eta), i = index_of(p.x, eta);
                      return refraction_jacobian(p.wo, p.x, h, o, i) / instead(p.wo, p.x, h, o, i);
                    },
                    rank});
  };
  add("dω_h/dω_i of the refraction", 1,
      [](const Vec3&, const Vec3&, const Vec3&, double, double) { return 1.0; });
  add("dω_h/dω_i with η the right way up (η_i² and η_o² exchanged)", 1.2,
      [](const Vec3& wo, const Vec3& wi, const Vec3& h, double o, double i) {
        return refraction_jacobian(wo, wi, h, i, o);
      });
  add("η_i² of dω_h/dω_i in place of η_o²", 1.3,
      [](const Vec3& wo, const Vec3& wi, const Vec3& h, double o, double i) {
        return refraction_jacobian(wo, wi, h, o, i) * o * o / (i * i);
      });
  add("η_i² of dω_h/dω_i", 1.3,
      [](const Vec3& wo, const Vec3& wi, const Vec3& h, double o, double i) {
        return refraction_jacobian(wo, wi, h, o, i) / (i * i);
      });
  add("|wi·h| of dω_h/dω_i in place of |wo·h|", 1.4,
      [](const Vec3& wo, const Vec3& wi, const Vec3& h, double o, double i) {
        return refraction_jacobian(wo, wi, h, o, i) * std::abs(dot(wo, h) / dot(wi, h));
      });
  add("|wi·h| of dω_h/dω_i", 1.5,
      [](const Vec3& wo, const Vec3& wi, const Vec3& h, double o, double i) {
        return refraction_jacobian(wo, wi, h, o, i) / std::abs(dot(wi, h));
      });
  add("|wi·h|/|cosθi| of dω_h/dω_i", 1.6,
      [](const Vec3& wo, const Vec3& wi, const Vec3& h, double o, double i) {
        return refraction_jacobian(wo, wi, h, o, i) * std::abs(wi[2] / dot(wi, h));
      });
  add("dω_h/dω_i of a refraction in place of the 1/(4 wo·h) of a reflection", 1.5,
      [](const Vec3& wo, const Vec3&, const Vec3& h, double, double) {
        return 1 / (4 * std::abs(dot(wo, h)));
      });
  list.push_back({"η_i²/η_o²", CauseKind::eta_squared,
                  [](const Place& p) {
                    const double r = index_of(p.x, p.view->eta) / index_of(p.wo, p.view->eta);
                    return r * r;
                  },
                  0.9});
}

double extent_of(const Domain& domain) {
  constexpr int kSteps = 64;
  double total = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      total += domain.chart().element({(i + 0.5) / kSteps, (j + 0.5) / kSteps});
    }
  }
  return total / (kSteps * kSteps);
}

void add_of_points(std::vector<Factor>& list, const Domain& domain) {
  const bool line = domain.dimension() == 1;
  const double extent = extent_of(domain);
  const std::string size = line ? "length" : "area";
  if (std::abs(extent - 1) > 1e-6) {
    // A constant in the end; what is twice there was multiplied by instead of divided.
    list.push_back({size, CauseKind::constant, [extent](const Place&) { return extent; }, -1, "",
                    "1/" + size + " is missing from", true});
    list.push_back({size + "²", CauseKind::distance_or_area,
                    [extent](const Place&) { return extent * extent; }, 1,
                    "the " + size + " is divided by where it should be multiplied by, in",
                    "the " + size + " is multiplied by where it should be divided by, in", true});
  }
  const auto along = [&list](const char* name, std::size_t i, bool from_end, double power,
                             double rank) {
    list.push_back({name, CauseKind::radius,
                    [i, from_end, power](const Place& p) {
                      const double c = p.view->pair->domain.chart().to_square(p.x)[i];
                      return std::pow(from_end ? 1 - c : c, power);
                    },
                    rank});
  };
  if (domain.name() == "disk") {
    along("r (a root of a random number)", 0, false, 0.5, 1);
  } else if (domain.name() == "triangle") {
    along("x + y (the root of a random number)", 0, false, 0.5, 1);
    list.push_back({"x", CauseKind::radius, [](const Place& p) { return p.x[0]; }, 1.1});
    list.push_back({"y", CauseKind::radius, [](const Place& p) { return p.x[1]; }, 1.1});
    list.push_back({"1 − x", CauseKind::radius, [](const Place& p) { return 1 - p.x[0]; }, 1.2});
    list.push_back({"1 − y", CauseKind::radius, [](const Place& p) { return 1 - p.x[1]; }, 1.2});
    list.push_back(
        {"1 − x − y", CauseKind::radius, [](const Place& p) { return 1 - p.x[0] - p.x[1]; }, 1.2});
  } else {
    along(line ? "x" : "the first coordinate", 0, false, 1, 1);
    along(line ? "1 − x" : "1 − the first coordinate", 0, true, 1, 1.2);
    if (line) return;
    along("the second coordinate", 1, false, 1, 1.1);
    along("1 − the second coordinate", 1, true, 1, 1.2);
  }
}

void add_suspects(std::vector<Factor>& list, const ViewEvidence& view) {
  // The user's own, by name: the same list in every view.
  for (std::size_t i = 0; i < view.pair->suspects.size(); ++i) {
    list.push_back({view.pair->suspects[i].name, CauseKind::constant, [i](const Place& p) {
                      const auto& all = p.view->pair->suspects;
                      return i < all.size() ? all[i].value(p.x) : 0.0;
                    }});
  }
}

bool sees_both_sides(const Observations& observations) {
  bool same = false, other = false;
  for (const ViewObservations& v : observations.views()) {
    for (const ExactPoint& p : v.exact) {
      (transmits(p.place.wo, p.place.x) ? other : same) = true;
    }
    for (const CountedBin& b : v.bins) {
      (transmits(b.nodes[0].wo, b.nodes[0].x) ? other : same) = true;
    }
  }
  return same && other;
}

/// Whether a factor is another one in one place than in the next: else it is a constant, and not
/// its business.
bool varies(const Factor& f, const Observations& observations) {
  constexpr double kLittle = 0.01;
  double low = 1e300, high = 0;
  const auto look = [&](const Place& p) {
    const double value = f.value(p);
    if (!(value > 0) || !std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const ViewObservations& v : observations.views()) {
    for (const ExactPoint& p : v.exact) look(p.place);
    for (const CountedBin& b : v.bins) look(b.nodes[b.nodes.size() / 2]);
  }
  return high > (1 + kLittle) * low;
}

std::vector<Factor> factors_of(const ReportEvidence& evidence, const Observations& observations) {
  std::vector<Factor> list;
  const ViewEvidence& view = evidence.views.front();
  const bool bsdf = view.bsdf != nullptr && has_wo(view);
  add_suspects(list, view);
  if (view.pair->domain.dimension() == 0) return list;
  if (!view.pair->domain.directions()) {
    add_of_points(list, view.pair->domain);
    return list;
  }
  add_of_directions(list, bsdf);
  if (!bsdf) return list;
  add_of_half_vectors(list);
  if (sees_both_sides(observations)) {
    const std::vector<Factor> both = list;
    for (const Factor& f : both) {
      list.push_back(on_part(f, Part::reflection));
      list.push_back(on_part(f, Part::transmission));
    }
  }
  if (view.eta != 1) add_of_refraction(list);
  return list;
}

std::string with_power(const std::string& name, double power) {
  const bool plain = name.find(' ') == std::string::npos || name.front() == '(';
  const std::string group = plain ? name : "(" + name + ")";
  const std::string amount = std::abs(power) == 2     ? group + "²"
                             : std::abs(power) == 0.5 ? "√" + group
                                                      : name;
  if (power > 0) return amount;
  return "1/" + (std::abs(power) == 1 ? group : amount);
}

std::string missing(const Factor& f, double power, const Blame& blame) {
  if (power == 1 && !f.lack.empty()) return f.lack + " " + blame.function;
  if (power == -1 && !f.excess.empty()) return f.excess + " " + blame.function;
  const std::string amount = with_power(f.name, std::abs(power));
  if (power > 0) return "factor " + amount + " missing from " + blame.function;
  return "factor " + amount + " too many in " + blame.function;
}

double product(const std::vector<std::pair<Factor, double>>& terms, const Place& p) {
  double value = 1;
  for (const auto& [f, power] : terms) {
    const double v = f.value(p);
    value *= power == 1 ? v : power == -1 ? 1 / v : std::pow(v, power);
  }
  return value;
}

Hypothesis hypothesis_of(std::vector<std::pair<Factor, double>> terms, bool with_constant,
                         const Blame& blame, double error) {
  Hypothesis h;
  h.kind = terms.front().first.kind;
  // A cosine that is mistaken for another of the half vector's.
  for (const auto& [f, power] : terms) {
    if (f.kind == CauseKind::half_vector_jacobian) h.kind = f.kind;
    h.needs_exact = h.needs_exact || (with_constant && std::abs(power) == 0.5);
  }
  std::string formula, remark;
  for (const auto& [f, power] : terms) {
    h.complexity += f.rank + (std::abs(power) == 1 ? 0 : 2);
    formula += (formula.empty() ? "" : " · ") + with_power(f.name, power);
    remark += (remark.empty() ? "" : ", and ") + missing(f, power, blame);
  }
  h.complexity += 5 * static_cast<double>(terms.size() - 1);
  h.prediction = [terms, with_constant](const Place& p, std::span<const double> n) {
    return p.base * product(terms, p) * (with_constant ? std::exp(n[0]) : 1);
  };
  if (!with_constant) {
    h.words = [=](std::span<const double>) {
      return remark + ": " + blame.numerator + " is " + formula + " times as large";
    };
    return h;
  }
  h.starts = {{0.0}};
  h.charge = [error](const auto& numbers) -> std::optional<double> {
    const bool usual = !usual_constant(std::exp(numbers.front()[0]), error).empty();
    // A plain 1 is the hypothesis without the constant, which stands by itself.
    if (std::abs(numbers.front()[0]) <= error) return std::nullopt;
    return usual ? 4 - kPerNumber : 0;
  };
  h.words = [=](std::span<const double> n) {
    const double c = std::exp(n[0]);
    const std::string usual = usual_constant(c, error);
    return remark + ": " + blame.numerator + " is " + (usual.empty() ? number(c) : usual) + " · " +
           formula + " times as large";
  };
  return h;
}

}  // namespace

std::vector<Hypothesis> factor_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                          const Observations& observations) {
  constexpr double kPowers[] = {1, -1, 2, -2, 0.5, -0.5};
  std::vector<Factor> factors = factors_of(evidence, observations);
  std::erase_if(factors, [&](const Factor& f) { return !f.alone && !varies(f, observations); });
  const double error = error_of_constant(observations);
  std::vector<Hypothesis> list;
  for (const Factor& f : factors) {
    for (const double power : kPowers) {
      if (f.alone && std::abs(power) != 1) continue;
      list.push_back(hypothesis_of({{f, power}}, false, blame, error));
      if (!f.alone) list.push_back(hypothesis_of({{f, power}}, true, blame, error));
    }
  }
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (factors[i].alone) continue;
    for (std::size_t j = i + 1; j < factors.size(); ++j) {
      for (const double a : {1.0, -1.0}) {
        for (const double b : {1.0, -1.0}) {
          list.push_back(hypothesis_of({{factors[i], a}, {factors[j], b}}, false, blame, error));
          list.back().needs_exact = true;
        }
      }
    }
  }
  return list;
}

}  // namespace plumbline::verify
