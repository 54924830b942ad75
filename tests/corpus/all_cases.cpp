#include "all_cases.h"

#include <iterator>
#include <utility>

namespace plumbline::tests::corpus {
namespace {

void append(std::vector<Case>& cases, std::vector<Case> more) {
  cases.insert(cases.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
}

}  // namespace

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
#ifdef PLUMBLINE_CORPUS_PAIRS
  append(cases, pair_cases());
#endif
  for (Case& c : cases) {
    if (c.fault.empty() == (half == Half::correct)) chosen.push_back(std::move(c));
  }
  return chosen;
}

}  // namespace plumbline::tests::corpus
