#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "diagnosis/apart.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/direct.h"
#include "diagnosis/hypothesis.h"

namespace plumbline::verify {

/// A cause with its cost, to be held against others.
struct CostedCause {
  double cost = 0;
  Cause cause;
};

/// What samplers taken apart tell: of two views at most, failing ones first, when first asked.
class PartExplanations {
 public:
  explicit PartExplanations(const ReportEvidence& evidence);
  ~PartExplanations();

  /// pdf() as a sum of the parts' densities, with other weights than they are chosen with.
  ///
  /// @param only_steady  only where these weights are the same in two views
  std::optional<Finding> by_parts(bool only_steady);

  /// What was found so is the same in several views, and not a function of wo.
  bool is_steady() const { return steady_; }

  /// The observations with the densities of the parts, added up: exact ratios where there were
  /// counts alone.
  Observations with_exact(const Observations& density);

  /// A fault in the pdf of one part, or of several alike, the others being right.
  std::optional<CostedCause> in_one_part();

  /// Probabilities of two ways that pdf() lacks, or has exchanged: found without a law for them.
  std::optional<Finding> by_two_ways();

  /// Two parts chosen by a number of wo alone, which pdf() weighs by F of another cosine.
  std::optional<Finding> by_fresnel();

  /// The densities of the parts, added up, are not what an explanation says: it was found by
  /// counts, which see less.
  bool contradict(const Explanation& e);

  /// How many views are known in parts.
  std::size_t views_known();

 private:
  const std::vector<std::unique_ptr<Apart>>& views();

  const ReportEvidence& evidence_;
  std::vector<std::unique_ptr<Apart>> views_;
  bool looked_ = false, steady_ = false;
};

/// A map that comes to points on several ways, of which pdf() knows one.
std::optional<Finding> explain_by_branches(const ReportEvidence& evidence);

}  // namespace plumbline::verify
