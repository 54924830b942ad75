#pragma once

#include <string>
#include <vector>

#include <plumbline/verify/pair.h>

#include "pairs/binned_pair.h"
#include "pairs/mass_balance.h"

namespace plumbline::verify {

/// Expected and observed counts of the bins of one depth.
struct BinTable {
  std::vector<double> expected, observed;
};
BinTable table_of(const BinnedPair& pair, int depth);

/// Chi-square statistic over the bins of one depth.
struct LevelTest {
  int depth = 0;
  double statistic = 0, degrees = 0, p_value = 1;
  std::size_t worst_bin = 0;
  double worst_pull = 0;
};

/// One look at the counts: all depths under one level, then the verdict.
class ChiSquareLook {
 public:
  ChiSquareLook(const ContractOptions& options, const BinnedPair& pair,
                const RejectedShare& rejected, double fail_level, double pass_level);

  CheckResult result() const;

 private:
  const LevelTest& worst() const;
  void judge(CheckResult& r) const;

  const ContractOptions& options_;
  const BinnedPair& pair_;
  MassBalance mass_;
  std::vector<LevelTest> levels_;
  double level_ = 0;  // of one test
  double bound_ = 0, detectable_ = 0;
};

/// Draws and looks until decided or at the cap.
CheckResult run_chi_square(const ContractOptions& options, BinnedPair& binned,
                           const RejectedShare& rejected);

}  // namespace plumbline::verify
