#pragma once

#include <string>
#include <vector>

#include <plumbline/verify/pair.h>

#include "pairs/binned_pair.h"
#include "pairs/rejected_share.h"

namespace plumbline::verify {

/// Expected and observed counts of the bins of one depth.
struct BinTable {
  std::vector<double> expected, variance, observed;  ///< variance: of the expected
};
BinTable table_of(const BinnedPair& pair, int depth);

/// Pearson's test over the bins of one depth.
struct LevelTest {
  int depth = 0;
  double statistic = 0;  ///< without the error of the expected masses: for the bound of a pass
  double degrees = 0, p_value = 1;
  std::size_t worst_bin = 0;
  double worst_pull = 0;
  double unresolved = 0;  ///< share of the mass in bins whose mass is not known well enough
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
  double excess_ = 0, excess_error_ = 0;
  std::vector<LevelTest> levels_;
  double tests_ = 0, level_ = 0;  // how many share a level, and that of one
  double atoms_p_ = 1;
  std::size_t worst_atom_ = 0;
  double bound_ = 0, detectable_ = 0;
};

/// Draws and looks until decided or at the cap.
CheckResult run_chi_square(const ContractOptions& options, BinnedPair& binned,
                           const RejectedShare& rejected);

}  // namespace plumbline::verify
