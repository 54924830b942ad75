#pragma once

#include <optional>
#include <vector>

#include "diagnosis/direct.h"
#include "diagnosis/evidence.h"

/// A sampler taken apart: one of its numbers chooses a part, a lobe as a rule, and what each part
/// adds to the density is found by itself, without a word from the code about it.
namespace plumbline::verify {

/// Which number chooses, and where it goes from one part to the next: 0, …, 1. Less than three
/// borders: there is one part only, or far too many.
struct Parts {
  std::size_t chooser = 0;
  std::vector<double> borders;

  std::size_t count() const { return borders.size() < 3 ? 1 : borders.size() - 1; }
  double share(std::size_t part) const { return borders[part + 1] - borders[part]; }
};

/// The number whose map jumps at the same values whatever the other numbers are.
Parts parts_of(const SamplingPair& pair);

/// pdf() = Σ a q over the densities q of the parts, with a that are not the shares of the numbers
/// that choose them: where Σ a is ∫pdf, the probabilities are wrong; else parts are sampled by
/// half.
std::optional<Finding> explain_by_parts(const ReportEvidence& evidence);

/// Where several random numbers lead to one point, pdf() is the density that one of them brings.
std::optional<Finding> explain_by_branches(const ReportEvidence& evidence);

}  // namespace plumbline::verify
