#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "diagnosis/direct.h"
#include "diagnosis/hypothesis.h"

namespace plumbline::verify {

/// What samplers taken apart tell: of the views that fail, two at most, when first asked.
class PartExplanations {
 public:
  struct Apart;

  explicit PartExplanations(const ReportEvidence& evidence);
  ~PartExplanations();

  /// pdf() as a sum of the parts' densities, with other weights than they are chosen with.
  ///
  /// @param only_steady  only where these weights are the same in two views
  std::optional<Finding> by_parts(bool only_steady);

  /// The densities of the parts, added up, are not what an explanation says: it was found by
  /// counts, which see less.
  bool contradict(const Explanation& e);

 private:
  const std::vector<std::unique_ptr<Apart>>& views();

  const ReportEvidence& evidence_;
  std::vector<std::unique_ptr<Apart>> views_;
  bool looked_ = false;
};

/// A map that comes to points on several ways, of which pdf() knows one.
std::optional<Finding> explain_by_branches(const ReportEvidence& evidence);

}  // namespace plumbline::verify
