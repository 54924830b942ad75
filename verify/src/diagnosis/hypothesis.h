#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <plumbline/verify/detail/cause.h>

#include "diagnosis/observations.h"

namespace plumbline::verify {

/// One way in which a ratio can come about, with what it would say.
struct Hypothesis {
  CauseKind kind = CauseKind::none;
  Prediction prediction;

  /// Where a fit of the free numbers begins; empty: there are none. All may take any value.
  std::vector<std::vector<double>> starts = {};
  bool per_view = false;  ///< the free numbers are others in each view

  /// Counts alone do not tell it from others: it is judged where exact ratios are known.
  bool needs_exact = false;

  /// How far-fetched it is among those with as many free numbers; 0: the simplest.
  double complexity = 0;

  /// In words; given the numbers of the first view that failed.
  std::function<std::string(std::span<const double>)> words;

  /// Last say on the fitted numbers of all views: what they add to the cost (less, if they are no
  /// free numbers after all: a usual constant), or nothing if they make no sense.
  std::function<std::optional<double>(const std::vector<std::vector<double>>&)> charge = {};
};

/// A hypothesis that was found admissible.
struct Explanation {
  const Hypothesis* hypothesis = nullptr;
  std::vector<std::vector<double>> numbers;  ///< per view; equal where they are not per view
  double cost = 0;                           ///< free numbers, then complexity
  double worst = 0;
};

/// Free numbers cost more than any complexity does.
inline constexpr double kPerNumber = 100;

/// The admissible ones, simplest first, but for those that say nothing else than what is stated.
std::vector<Explanation> explain(const Observations& observations,
                                 const std::vector<Hypothesis>& hypotheses);

/// What the denominator is called in a sentence: "pdf()", "f·|cosθ|", "the pdf in the record".
struct Blame {
  std::string function;
  std::string numerator;  ///< "the density of the samples"
};

/// "2", "1/π", …: usual constants within relative `error` of the value; empty if none or several.
std::string usual_constant(double value, double error);

/// The usual constant nearest to a value.
double nearest_usual_constant(double value);

/// How well a common factor of all residuals is known, relative.
double error_of_constant(const Observations& observations);

/// A factor is missing from, or too many in, the blamed function: with a constant, without, and by
/// powers.
std::vector<Hypothesis> factor_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                          const Observations& observations);

/// Constants: one, one per hemisphere, one per view.
std::vector<Hypothesis> constant_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                            const Observations& observations);

/// The blamed function is asked with other arguments: exchanged, mirrored, shifted.
std::vector<Hypothesis> argument_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                            bool of_value);

/// Mixtures: probabilities of lobes, a factor of one lobe, another density in their place.
std::vector<Hypothesis> mixture_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                           const Observations& observations);

/// A random number enters the map as another power of itself: a root missing, or too many.
std::vector<Hypothesis> number_hypotheses(const ReportEvidence& evidence, const Blame& blame);

/// Area against solid angle of planar and spherical lights.
std::vector<Hypothesis> light_hypotheses(const ReportEvidence& evidence, const Blame& blame);

/// Microfacet terms with a free number: masking, roughness, Fresnel, exponents, rates.
std::vector<Hypothesis> parametric_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                              const Observations& observations);

/// Fresnel's reflectance, missing, too many, or of another cosine; part of the parametric ones.
void add_fresnel(std::vector<Hypothesis>& list, const ReportEvidence& evidence, const Blame& blame);

/// Lobes whose width differs: around a fibre or the mirror direction, stretched ones.
std::vector<Hypothesis> width_hypotheses(const ReportEvidence& evidence, const Blame& blame);

/// All of these but the widths, which are looked at where none of the others is admissible; of a
/// density also what numbers and mixtures tell.
std::vector<Hypothesis> all_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                       const Observations& observations, bool of_value);

}  // namespace plumbline::verify
