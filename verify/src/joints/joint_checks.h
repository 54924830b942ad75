#pragma once

#include <vector>

#include <plumbline/verify/joint.h>

#include "joints/joint_bins.h"

/// The parts of the battery, which share what they have drawn and integrated.
namespace plumbline::verify {

/// Results without subject prefix where the pair has no ground for them are left out.
std::vector<CheckResult> judge_joint_pointwise(const JointPair& pair,
                                               const ContractOptions& options);

struct JointJacobian {
  CheckResult result;
  bool below_everywhere = false;  ///< where it fails, the map is less dense than the pdf says
};
JointJacobian judge_joint_jacobian(const JointPair& pair, const ContractOptions& options);

/// ∫pdf + rejected share.
struct JointBalance {
  MassIntegral integral;
  CountedShare rejected;

  double excess() const { return integral.total + rejected.value() - 1; }
  double error(double level) const {
    return integral.error(level / 2) + (rejected.hits > 0 ? rejected.error(level / 2) : 0);
  }
};

CheckResult judge_joint_integral(const JointBins& bins, const CountedShare& rejected,
                                 const ContractOptions& options);

/// Draws and looks until decided or at the cap.
CheckResult run_joint_chi_square(JointBins& bins, const CountedShare& rejected,
                                 const ContractOptions& options);

}  // namespace plumbline::verify
