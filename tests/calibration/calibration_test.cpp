#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include <plumbline/calibration/experiments.h>

/// The rows of `plumbline calibrate`, with the gate's or the night's numbers of runs. The controls
/// among them, tests that are known to be badly calibrated, must fail.
namespace plumbline::tests {
namespace {

using calibration::Experiment;

class Calibration : public testing::TestWithParam<Experiment> {};

TEST_P(Calibration, HoldsWhatTheChecksPromise) {
  const Experiment& experiment = GetParam();
  const std::uint64_t seed = check_seed(experiment.table + "/" + experiment.name);
  expect_verdict(calibration::run(experiment, {nightly(), seed}));
}

/// "mean, 0.1 % shift" as "mean_0_1_shift".
std::string test_name(const testing::TestParamInfo<Experiment>& info) {
  std::string name;
  for (const char c : info.param.table + " " + info.param.name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Of, Calibration, testing::ValuesIn(calibration::experiments()), test_name);

TEST(CalibrationTables, EachHasRowsAndTheNullTableItsControls) {
  const std::vector<Experiment> all = calibration::experiments();
  for (const char* table :
       {calibration::kTableNull, calibration::kTableFalseFailures, calibration::kTableWrongPasses,
        calibration::kTableDetection, calibration::kTableCoverage, calibration::kTableSameCode}) {
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Experiment& e) {
      return e.table == table;
    })) << table;
  }
}

}  // namespace
}  // namespace plumbline::tests
