#pragma once

#include <optional>
#include <string>

#include <plumbline/verify/detail/cause.h>

#include "diagnosis/evidence.h"

/// Causes that are seen without any fit: by asking twice, or by where samples fall.
namespace plumbline::verify {

struct Finding {
  CauseKind kind = CauseKind::none;
  std::string words;
};

/// The same question gets another answer after other questions.
std::optional<Finding> find_stale_state(const ReportEvidence& evidence);

/// Samples that share a coordinate to the last bit, or of which there are few different ones.
std::optional<Finding> find_samples_on_a_line(const ReportEvidence& evidence);

/// Samples that crowd around one cosine, where the pdf is as on either side: lifted to the horizon,
/// or clamped and normalised again.
std::optional<Finding> find_samples_near_a_line(const ReportEvidence& evidence);

/// A density that is negative or not a number in a good part of the domain.
std::optional<Finding> find_bad_density(const ReportEvidence& evidence);

/// Records of atoms that state a density; nothing but atoms beside a density.
std::optional<Finding> find_atoms_with_density(const ReportEvidence& evidence);

/// Atoms that are drawn another share of times than the mass that they state.
std::optional<Finding> find_atoms_of_other_mass(const ReportEvidence& evidence);

/// A cap's even density whose solid angle is 2π times a few roundings of 1 in float.
std::optional<Finding> find_rounded_cap(const ReportEvidence& evidence);

/// NaN, infinity or a negative density.
std::optional<Finding> find_not_finite(const ReportEvidence& evidence);

/// Sampled points that are NaN or infinite, in one of two hundred samples or more.
std::optional<Finding> find_points_not_finite(const ReportEvidence& evidence);

/// What the numerator of a ratio depends on, judged by samples that lie next to each other.
enum class Dependence {
  on_the_point,     ///< neighbours agree
  on_a_choice,      ///< neighbours fall in two groups
  on_the_last_bits  ///< neighbours scatter
};

/// Of the record's pdf, or weight · pdf() (of_weight).
Dependence dependence_of(const ReportEvidence& evidence, bool of_weight);

/// The record's pdf is one of a few multiples of pdf(), seldom pdf() itself: how many there are; 0
/// where it is not so.
std::size_t multiples_in_records(const ReportEvidence& evidence);

/// A sampler with a generator takes more numbers for one sample than for another: it draws again.
bool takes_more_at_times(const SamplingPair& pair);

/// Left and right of the plane of incidence the pdf is the same, and turned around the normal it is
/// as well; but samples are not.
bool samples_break_a_symmetry(const ReportEvidence& evidence);

/// Share of pdf() in places where no sample falls though many are expected: whole cells of a grid.
double share_never_sampled(const ViewEvidence& view);

}  // namespace plumbline::verify
