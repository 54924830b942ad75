#include <plumbline/calibration/experiments.h>

#include <plumbline/verify/detail/stopwatch.h>

#include "tables.h"

namespace plumbline::calibration {

std::vector<Experiment> experiments() {
  std::vector<Experiment> list;
  add_null_experiments(list);
  add_false_failure_experiments(list);
  add_wrong_pass_experiments(list);
  add_detection_experiments(list);
  add_coverage_experiments(list);
  add_same_code_experiments(list);
  return list;
}

verify::CheckResult run(const Experiment& experiment, const Effort& effort) {
  const verify::Stopwatch watch;
  verify::CheckResult result = experiment.run(effort);
  result.kind = verify::CheckKind::calibration;
  result.seconds = watch.seconds();
  result.subject = "calibration/";
  result.subject += experiment.table + "/" + experiment.name;
  result.seed = effort.seed;
  return result;
}

}  // namespace plumbline::calibration
