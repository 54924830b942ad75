#include "diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/direct.h"
#include "diagnosis/discrete.h"
#include "diagnosis/geometry.h"
#include "diagnosis/hypothesis.h"
#include "diagnosis/part_explanations.h"
#include "diagnosis/shape.h"
#include "diagnosis/strays.h"
#include "diagnosis/values.h"
#include "text.h"

namespace plumbline::verify {

namespace {

/// Another explanation is close where it has as many free numbers.
constexpr double kCloseSecond = 30;

/// Kinds of f and weights for factors that were looked for in a density.
CauseKind of_value(CauseKind kind) {
  switch (kind) {
    case CauseKind::constant:
      return CauseKind::value_constant;
    case CauseKind::cosine:
      return CauseKind::value_cosine;
    default:
      return kind;
  }
}

/// Factors that are 0 nowhere: none of them keeps samples away.
bool is_positive_factor(CauseKind kind) {
  switch (kind) {
    case CauseKind::constant:
    case CauseKind::constant_per_hemisphere:
    case CauseKind::fresnel:
    case CauseKind::half_vector_jacobian:
    case CauseKind::lobe_probability:
    case CauseKind::masking:
    case CauseKind::roughness:
      return true;
    default:
      return false;
  }
}

class Diagnosis {
 public:
  explicit Diagnosis(const ReportEvidence& evidence) : evidence_(evidence) {}

  Cause run() {
    if (!anything_failed()) return {};
    if (const auto f = find_stale_state(evidence_)) return named(*f);
    if (const auto f = find_atoms_with_density(evidence_)) return named(*f);
    if (const auto f = find_atoms_of_other_mass(evidence_)) return named(*f);
    if (const auto f = find_points_not_finite(evidence_)) return named(*f);
    if (const auto f = find_samples_on_a_line(evidence_)) return named(*f);
    if (const auto f = find_samples_near_a_line(evidence_)) return named(*f);
    if (const auto f = find_bad_density(evidence_)) return named(*f);
    Cause cause = of_the_rest();
    if (const auto f = find_not_finite(evidence_)) {
      // A number that is none may follow from what was named, or be all there is.
      if (cause.kind == CauseKind::none) return named(*f);
      cause.second = f->words;
      cause.second_kind = f->kind;
    }
    return cause;
  }

 private:
  bool anything_failed() const {
    return std::any_of(evidence_.views.begin(), evidence_.views.end(),
                       [](const ViewEvidence& v) { return v.failed; }) ||
           reciprocity_fails(evidence_) || energy_fails(evidence_);
  }

  /// Share of pdf() where no sample falls; it takes samples, once and only where somebody asks.
  double never() {
    if (!never_) never_ = never_sampled(evidence_);
    return *never_;
  }

  static Cause named(const Finding& f) { return {f.kind, f.words, {}, CauseKind::none}; }

  Cause of_the_rest() {
    if (evidence_.views.empty()) return of_values();
    if (auto cause = of_lobes()) return *cause;
    const Observations density = Observations::of_density(evidence_);
    if (!density.empty() && !density.judge(as_stated).admissible) return of_density(density);
    const Observations record = Observations::of_series(evidence_, RatioKind::record_over_pdf);
    if (!record.empty() && !record.judge(as_stated).admissible) return of_record(record);
    const Observations weight = Observations::of_series(evidence_, RatioKind::weight_over_value);
    if (!weight.empty() && !weight.judge(as_stated).admissible) return of_weight(weight);
    return of_values();
  }

  Cause from(const std::vector<Explanation>& found, const std::string& remark = {}) const {
    if (found.empty()) return {};
    const auto words = [](const Explanation& e) {
      std::span<const double> numbers;
      if (!e.numbers.empty()) numbers = e.numbers.front();
      return e.hypothesis->words(numbers);
    };
    Cause cause{found.front().hypothesis->kind, words(found.front()) + remark, {}, CauseKind::none};
    for (const Explanation& e : found) {
      if (e.hypothesis->kind == cause.kind || e.cost > found.front().cost + kCloseSecond) continue;
      cause.second = words(e);
      cause.second_kind = e.hypothesis->kind;
      break;
    }
    return cause;
  }

  std::optional<Cause> of_lobes() {
    const std::size_t lobes = evidence_.views.front().pair->lobes.size();
    for (std::size_t i = 0; i < lobes; ++i) {
      const Observations lobe =
          Observations::of_series(evidence_, RatioKind::lobe_density_over_pdf, static_cast<int>(i));
      if (lobe.empty() || lobe.judge(as_stated).admissible) continue;
      const Blame blame{"the pdf of " + evidence_.views.front().pair->lobes[i].name,
                        "the density of its samples"};
      std::vector<Hypothesis> all;
      for (auto&& list :
           {constant_hypotheses(evidence_, blame, lobe), factor_hypotheses(evidence_, blame, lobe),
            parametric_hypotheses(evidence_, blame, lobe), width_hypotheses(evidence_, blame),
            number_hypotheses(evidence_, blame)}) {
        all.insert(all.end(), list.begin(), list.end());
      }
      return from(explain(lobe, all));
    }
    return std::nullopt;
  }

  /// In which function it is, by what the record says.
  std::string which_function(const Explanation& e) const {
    const Observations record = Observations::of_series(evidence_, RatioKind::record_over_pdf);
    if (record.empty()) return {};
    if (record.judge(as_stated).admissible) return " (the record states the same)";
    for (std::size_t v = 0; v < record.views().size(); ++v) {
      const Fit fit = record.judge_view(v, e.hypothesis->prediction, e.numbers[v]);
      if (fit.tested > 0 && !fit.admissible) return {};
    }
    return " (the pdf in the record is right)";
  }

  Cause of_density(const Observations& seen) {
    const Blame blame{"pdf()", "the density of the samples"};
    if (all_rejected(evidence_)) return {};
    if (auto cause = explain_strays(evidence_, seen)) return *cause;
    if (const auto f = find_rounded_cap(evidence_)) return named(*f);
    if (const auto f = explain_atoms(evidence_, seen)) return named(*f);
    // Counts admit what a few exact ratios do not.
    PartExplanations parts(evidence_);
    constexpr std::size_t kManyExact = 100;
    const bool few_exact = seen.exact() < kManyExact;
    const Observations density = few_exact ? parts.with_exact(seen) : seen;
    const auto all = all_hypotheses(evidence_, blame, density, false);
    auto found = explain(density, all);
    std::vector<Hypothesis> widths;
    if (found.empty()) {
      widths = width_hypotheses(evidence_, blame);
      found = explain(density, widths);
    }
    if (few_exact) {
      std::erase_if(found, [&parts](const Explanation& e) { return parts.contradict(e); });
    }
    // Where nothing falls, a factor explains nothing.
    constexpr double kNever = 0.02;
    const auto is_factor = [](const Explanation& e) {
      return is_positive_factor(e.hypothesis->kind);
    };
    if (std::any_of(found.begin(), found.end(), is_factor) && never() > kNever) {
      std::erase_if(found, is_factor);
    }
    // Of a mixture whose parts are known, no number has to be guessed.
    if (found.empty() || found.front().cost >= kPerNumber) {
      if (auto cause = of_parts(parts, found)) return *cause;
    }
    if (!found.empty()) return from(found, which_function(found.front()));
    if (const auto f = explain_by_branches(evidence_)) return named(*f);
    if (const auto f = explain_discrete(evidence_)) return named(*f);
    if (const auto f = explain_shape(evidence_, density, never())) return named(*f);
    if (const auto f = explain_empty_places(density, never())) return named(*f);
    return {};
  }

  /// Wrong probabilities of parts, or a factor of one part's pdf, whichever takes fewer numbers.
  static std::optional<Cause> of_parts(PartExplanations& parts,
                                       const std::vector<Explanation>& found) {
    const auto probabilities = parts.by_parts(!found.empty());
    if (probabilities && (parts.is_steady() || parts.views_known() < 2)) {
      return named(*probabilities);
    }
    // Other probabilities from each direction are as many numbers.
    const auto one = parts.in_one_part();
    const double least = probabilities   ? 1.5 * kPerNumber
                         : found.empty() ? std::numeric_limits<double>::infinity()
                                         : found.front().cost - kCloseSecond;
    if (one && one->cost < least) {
      Cause cause = one->cause;
      if (probabilities && one->cost >= kPerNumber && cause.second.empty()) {
        cause.second = probabilities->words;
        cause.second_kind = probabilities->kind;
      }
      return cause;
    }
    if (probabilities) return named(*probabilities);
    if (!found.empty()) return std::nullopt;
    auto ways = parts.by_two_ways();
    if (!ways) ways = parts.by_fresnel();
    return ways ? std::optional(named(*ways)) : std::nullopt;
  }

  Cause of_record(const Observations& record) {
    if (auto cause = of_chosen_lobe(record)) return *cause;
    const std::string right = "the pdf in the record is wrong: samples are as dense as pdf() says";
    const auto of_record_pdf = [&right](const Cause& cause) {
      return Cause{CauseKind::record_pdf, right + "; " + cause.headline, cause.headline,
                   cause.kind};
    };
    const Blame blame{"the pdf in the record", "pdf()"};
    const Observations inverted = record.inverted();
    std::vector<Hypothesis> factors;
    for (auto&& list : {constant_hypotheses(evidence_, blame, inverted),
                        factor_hypotheses(evidence_, blame, inverted),
                        parametric_hypotheses(evidence_, blame, inverted)}) {
      factors.insert(factors.end(), list.begin(), list.end());
    }
    Cause cause = from(explain(inverted, factors));
    if (cause.kind != CauseKind::none) return of_record_pdf(cause);
    if (const std::size_t multiples = multiples_in_records(evidence_); multiples > 0) {
      return {CauseKind::record_pdf,
              right + "; it is one of " + number(double(multiples)) +
                  " multiples of it: the probability of a choice is missing from the record",
              "the probability of a choice is missing from the record",
              CauseKind::choice_probability};
    }
    if (dependence_of(evidence_, false) == Dependence::on_a_choice) {
      return {CauseKind::chosen_lobe_only,
              "the record's pdf is not a function of the directions: it states that of the chosen "
              "lobe in place of the mixture's",
              {},
              CauseKind::none};
    }
    const auto others = argument_hypotheses(evidence_, {"the pdf in the record", "it"}, false);
    cause = from(explain(record, others));
    if (cause.kind != CauseKind::none) return of_record_pdf(cause);
    return {CauseKind::record_pdf, right, {}, CauseKind::none};
  }

  /// Lobes that are exposed: every ratio is one of theirs.
  std::optional<Cause> of_chosen_lobe(const Observations& series) const {
    if (evidence_.views.front().pair->lobes.size() < 2) return std::nullopt;
    for (const bool weighed : {false, true}) {
      std::size_t tested = 0, matching = 0;
      for (const ViewObservations& v : series.views()) {
        for (const ExactPoint& p : v.exact) {
          ++tested;
          for (const PairLobe& lobe : p.place.view->pair->lobes) {
            const double expected = (weighed ? lobe.probability : 1.0) * lobe.pdf(p.place.x) /
                                    pdf_at(*v.view, p.place.x);
            if (std::abs(std::log(p.ratio / expected)) <= 4 * p.error + 1e-9) {
              ++matching;
              break;
            }
          }
        }
      }
      // A point where rounding is more than its estimate says nothing against all the others.
      if (tested > 8 && 50 * (tested - matching) <= tested) {
        return Cause{CauseKind::chosen_lobe_only,
                     weighed ? "one lobe's part stands for that of the whole mixture"
                             : "the pdf of the chosen lobe stands in the place of the mixture's",
                     {},
                     CauseKind::none};
      }
    }
    return std::nullopt;
  }

  /// A weight that is f·|cosθ| or f, not over the density, or over it twice.
  std::optional<Cause> of_undivided(const Observations& weight) const {
    for (const double power : {1.0, -1.0}) {
      for (const bool cosine : {false, true}) {
        const Prediction over = [=](const Place& p, std::span<const double>) {
          return p.base * std::pow(pdf_at(*p.view, p.x), power) / (cosine ? std::abs(p.x[2]) : 1);
        };
        if (!weight.judge(over).admissible) continue;
        return Cause{CauseKind::weight,
                     power > 0 ? "the weight is not divided by the pdf"
                               : "the weight is divided by the pdf twice",
                     {},
                     CauseKind::none};
      }
    }
    return std::nullopt;
  }

  Cause of_weight(const Observations& weight) {
    const bool bsdf = evidence_.views.front().bsdf != nullptr;
    const Blame blame{bsdf ? "f·|cosθ|" : "the value", "weight · pdf()"};
    if (auto cause = of_chosen_lobe(weight)) return *cause;
    if (dependence_of(evidence_, true) == Dependence::on_a_choice) {
      return {CauseKind::chosen_lobe_only,
              "the weight is not a function of the directions: it holds f or the pdf of the chosen "
              "lobe in place of the mixture's",
              {},
              CauseKind::none};
    }
    const auto all = all_hypotheses(evidence_, blame, weight, true);
    std::vector<Explanation> found = explain(weight, all);
    std::vector<Hypothesis> widths;
    if (found.empty()) {
      widths = width_hypotheses(evidence_, blame);
      found = explain(weight, widths);
    }
    // What f is blamed for has to make it as asymmetric as it is; if f is symmetric, the weight is.
    const bool asymmetric = reciprocity_fails(evidence_);
    if (asymmetric) {
      std::erase_if(found, [this](const Explanation& e) {
        return e.hypothesis->kind != CauseKind::directions_swapped &&
               !explains_reciprocity(evidence_, e.hypothesis->prediction, e.numbers.front());
      });
    }
    Cause cause = from(found);
    if (cause.kind != CauseKind::none && !bsdf) {
      return {CauseKind::weight, "the weight is not value/pdf(): " + cause.headline, cause.headline,
              cause.kind};
    }
    cause.kind = of_value(cause.kind);
    cause.second_kind = of_value(cause.second_kind);
    if (cause.kind != CauseKind::none) return cause;
    // Only then: the density of a diffuse lobe is cosθ/π, and 1/π missing in f looks the same.
    if (const auto undivided = of_undivided(weight)) return *undivided;
    if (asymmetric || energy_fails(evidence_)) return of_values();
    // Densities and the record are right, and f is what it should be from both sides.
    return {CauseKind::weight,
            "the weight is wrong: it is not f·|cosθ|/pdf(), though samples are as dense as pdf() "
            "says",
            {},
            CauseKind::none};
  }

  Cause of_values() const {
    std::vector<Finding> found;
    if (reciprocity_fails(evidence_)) {
      found = explain_asymmetry(evidence_);
    } else if (energy_fails(evidence_)) {
      found = explain_energy(evidence_);
    }
    if (found.empty()) return {};
    Cause cause = named(found.front());
    for (const Finding& f : found) {
      if (f.kind == cause.kind) continue;
      cause.second = f.words;
      cause.second_kind = f.kind;
      break;
    }
    return cause;
  }

  const ReportEvidence& evidence_;
  std::optional<double> never_;
};

}  // namespace

Cause diagnose(const ReportEvidence& evidence) { return Diagnosis(evidence).run(); }

}  // namespace plumbline::verify
