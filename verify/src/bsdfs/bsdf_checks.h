#pragma once

#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>

#include "diagnosis/evidence.h"

namespace plumbline::verify {

/// The result of the reciprocity check with the pairs of directions that it looked at.
struct ReciprocityOutcome {
  CheckResult result;
  std::vector<ReciprocityAt> pairs;
};

ReciprocityOutcome judge_reciprocity(const std::string& name, const ErasedBsdf& bsdf,
                                     const BsdfOptions& options);

/// What the result of the energy check says of the albedo.
AlbedoAt albedo_seen(const CheckResult& energy, const Vec3& wo, const BsdfOptions& options);

}  // namespace plumbline::verify
