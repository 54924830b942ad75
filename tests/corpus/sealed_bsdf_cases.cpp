#include "bsdf_families.h"
#include "corpus.h"

namespace plumbline::tests::corpus {

std::vector<Case> sealed_bsdf_cases() {
  std::vector<Case> cases;
  add_sealed_diffuse_cases(cases);
  add_sealed_phong_cases(cases);
  add_sealed_ggx_cases(cases);
  add_sealed_glass_cases(cases);
  add_sealed_mixture_cases(cases);
  add_sealed_layers_cases(cases);
  add_sealed_measured_cases(cases);
  add_sealed_hair_cases(cases);
  add_sealed_conventions_cases(cases);
  return cases;
}

}  // namespace plumbline::tests::corpus
