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
  std::vector<double> rounding;  ///< variance that rounded samples add; empty: none
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

/// @param n              samples drawn, rejected ones included
/// @param error_of_mass  a bin is tested where the error of its mass adds no more than that share
///                       to the variance of its count; the others are pooled
LevelTest test_level(const BinTable& table, int depth, double n, double error_of_mass);

/// Coarse to fine.
std::vector<int> depths_of(int finest);

/// Smallest deviation, root mean square over the bins, that a test at a level finds with 99 %.
double detectable_deviation(double degrees, double level, double n);

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
