#pragma once

#include <vector>

#include "corpus.h"

/// Each family's cases, those of the sealed half apart.
namespace plumbline::tests::corpus {

void add_diffuse_cases(std::vector<Case>& cases);
void add_phong_cases(std::vector<Case>& cases);
void add_ggx_cases(std::vector<Case>& cases);
void add_glass_cases(std::vector<Case>& cases);
void add_mixture_cases(std::vector<Case>& cases);
void add_layers_cases(std::vector<Case>& cases);
void add_measured_cases(std::vector<Case>& cases);
void add_hair_cases(std::vector<Case>& cases);
void add_conventions_cases(std::vector<Case>& cases);

void add_sealed_diffuse_cases(std::vector<Case>& cases);
void add_sealed_phong_cases(std::vector<Case>& cases);
void add_sealed_ggx_cases(std::vector<Case>& cases);
void add_sealed_glass_cases(std::vector<Case>& cases);
void add_sealed_mixture_cases(std::vector<Case>& cases);
void add_sealed_layers_cases(std::vector<Case>& cases);
void add_sealed_measured_cases(std::vector<Case>& cases);
void add_sealed_hair_cases(std::vector<Case>& cases);
void add_sealed_conventions_cases(std::vector<Case>& cases);

}  // namespace plumbline::tests::corpus
