#include "all_cases.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace plumbline::tests::corpus {
namespace {

void append(std::vector<Case>& cases, std::vector<Case> more) {
  cases.insert(cases.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
}

}  // namespace

verify::ContractOptions with_effort(verify::ContractOptions options, Effort effort, bool is_twin) {
  if (effort == Effort::user) return options;
  options.finest_bins /= is_twin ? 4 : 16;
  options.first_look /= 4;
  options.deviation *= is_twin ? 2 : 4;
  options.mass_tolerance = std::max(2e-3, options.mass_tolerance.value_or(0));
  if (is_twin) options.evaluations /= 4;
  return options;
}

std::vector<Case> all_cases(Half half) {
  std::vector<Case> cases, chosen;
  if (half == Half::sealed) {
#ifdef PLUMBLINE_SEALED_BSDF
    append(cases, sealed_bsdf_cases());
#endif
#ifdef PLUMBLINE_SEALED_PAIR
    append(cases, sealed_pair_cases());
#endif
    return cases;
  }
  append(cases, bsdf_cases());
  append(cases, pair_cases());
  for (Case& c : cases) {
    if (c.fault.empty() == (half == Half::correct)) chosen.push_back(std::move(c));
  }
  return chosen;
}

}  // namespace plumbline::tests::corpus
