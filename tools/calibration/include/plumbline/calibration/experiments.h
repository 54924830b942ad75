#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <plumbline/verify/detail/result.h>

/// What the checks of plumbline::verify claim about themselves, measured: each is run many times on
/// code whose answer is known, correct or wrong by a known amount.
namespace plumbline::calibration {

struct Effort {
  bool full = false;  ///< the night's number of runs instead of the gate's
  std::uint64_t seed = 1;
};

/// One row of a table. `run` gives a share of runs with its 99.9 % interval and the range that it
/// must lie in: a pass proves that it does.
struct Experiment {
  std::string table;  ///< one of the kTable… below
  std::string name;
  std::function<verify::CheckResult(const Effort&)> run;
};

inline constexpr const char* kTableNull = "p-values of correct code";
inline constexpr const char* kTableFalseFailures = "false failures";
inline constexpr const char* kTableWrongPasses = "wrong passes";
inline constexpr const char* kTableDetection = "detection";
inline constexpr const char* kTableCoverage = "coverage";
inline constexpr const char* kTableSameCode = "same code twice";

/// All of them, table by table; those that must fail (tests that are known to be badly calibrated)
/// say so in `expected`.
std::vector<Experiment> experiments();

/// Runs one. The result is named calibration/table/name.
verify::CheckResult run(const Experiment& experiment, const Effort& effort);

}  // namespace plumbline::calibration
