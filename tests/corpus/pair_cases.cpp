#include "corpus.h"

namespace plumbline::tests::corpus {

void add_maps(std::vector<Case>& cases);
void add_lights(std::vector<Case>& cases);
void add_phase(std::vector<Case>& cases);
void add_shapes(std::vector<Case>& cases);
void add_lines(std::vector<Case>& cases);

std::vector<Case> pair_cases() {
  std::vector<Case> cases;
  add_maps(cases);
  add_lights(cases);
  add_phase(cases);
  add_shapes(cases);
  add_lines(cases);
  return cases;
}

}  // namespace plumbline::tests::corpus
