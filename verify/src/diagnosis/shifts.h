#pragma once

#include <functional>
#include <vector>

#include "diagnosis/hypothesis.h"

namespace plumbline::verify {

/// Densities asked at another point, or values: what a prediction is over `base`.
using Asked = std::function<double(const Place&, const Vec3&)>;

inline Asked asked(bool of_value) {
  if (of_value) return [](const Place& p, const Vec3& x) { return value_at(*p.view, x); };
  return [](const Place& p, const Vec3& x) { return pdf_at(*p.view, x); };
}

/// The blamed function is that of points moved by a cell, a row, or half of one, of maps and tables
/// of usual sizes; on a line, by any length.
std::vector<Hypothesis> shift_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                         bool of_value);

}  // namespace plumbline::verify
