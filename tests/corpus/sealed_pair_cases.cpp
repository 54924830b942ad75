#include "corpus.h"

namespace plumbline::tests::corpus {

void add_sealed_maps(std::vector<Case>& cases);
void add_sealed_lights(std::vector<Case>& cases);
void add_sealed_phase(std::vector<Case>& cases);
void add_sealed_shapes(std::vector<Case>& cases);
void add_sealed_lines(std::vector<Case>& cases);

std::vector<Case> sealed_pair_cases() {
  std::vector<Case> cases;
  add_sealed_maps(cases);
  add_sealed_lights(cases);
  add_sealed_phase(cases);
  add_sealed_shapes(cases);
  add_sealed_lines(cases);
  return cases;
}

}  // namespace plumbline::tests::corpus
