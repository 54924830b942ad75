#include "bsdf_families.h"
#include "corpus.h"

namespace plumbline::tests::corpus {

std::vector<Case> bsdf_cases() {
  std::vector<Case> cases;
  add_diffuse_cases(cases);
  add_phong_cases(cases);
  add_ggx_cases(cases);
  add_glass_cases(cases);
  add_mixture_cases(cases);
  add_layers_cases(cases);
  add_measured_cases(cases);
  add_hair_cases(cases);
  add_conventions_cases(cases);
  return cases;
}

}  // namespace plumbline::tests::corpus
