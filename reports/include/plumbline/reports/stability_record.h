#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace plumbline::reports {

/// What rounding costs one function of one BSDF: float as rendered against the same code in quad
/// precision, over many hard points. JSON format "plumbline.stability/1".
struct StabilityRecord {
  std::string bsdf;          ///< with its parameters: "GgxConductor/alpha 0.1"
  std::string function;      ///< "sample", "eval", "pdf" or "weight"
  std::uint64_t points = 0;  ///< at which both precisions were asked
  double error = 0;      ///< largest relative one; of "sample" the absolute one of a unit vector
  double tolerance = 0;  ///< what `error` is held against
  std::string place;     ///< of the largest error: "wo (0, 0, 1), u (0.5, 0.25)"; may be empty

  /// Points at which no code can do better: the error is above the tolerance, but not above what
  /// one ulp in each input changes. They do not count in `error`.
  std::uint64_t ill_conditioned = 0;
  double ill_conditioned_error = 0;  ///< largest of them
  double condition = 0;              ///< condition number there: 2²⁴ × the change by one ulp
  std::string ill_conditioned_place;

  bool operator==(const StabilityRecord&) const = default;
};

std::string to_json(const StabilityRecord& record);

/// @throws FormatError
StabilityRecord parse_stability_record(std::string_view json);

}  // namespace plumbline::reports
