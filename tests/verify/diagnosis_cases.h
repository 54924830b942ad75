#pragma once

#include <gtest/gtest.h>
#include <plumbline_tests/directions.h>
#include <plumbline_tests/support.h>

#include <cstdio>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/pair.h>

#include "bsdfs/bsdf_checks.h"
#include "correct_pairs.h"
#include "diagnosis/diagnosis.h"
#include "judged_pair.h"

/// Faults put on correct pairs, with what the diagnosis has to name.
namespace plumbline::verify {

struct FaultyCase {
  std::string name;
  CauseKind right = CauseKind::none;
  std::function<Cause(std::uint64_t seed)> run;
};

inline std::vector<Vec3> looked_from(const std::vector<double>& degrees, bool back) {
  std::vector<Vec3> directions;
  double phi = 0.3;
  for (const double d : degrees) {
    phi += 2.1;
    directions.push_back(tests::direction_at(d, phi));
    if (back) directions.push_back(tests::direction_at(d, phi, false));
  }
  return directions;
}

/// What check_bsdf would name, as a kind.
inline Cause cause_of(const ErasedBsdf& bsdf, const BsdfOptions& options) {
  ReportEvidence evidence;
  std::deque<SamplingPair> pairs;
  std::uint64_t seed = options.contract.seed;
  for (const Vec3& wo : looked_from(options.angles, options.back)) {
    ContractOptions contract = options.contract;
    contract.seed = seed += 17;
    PairOutcome outcome =
        judge_pair(pairs.emplace_back(bsdf_pair("", bsdf, wo, options)), contract);
    outcome.view.wo = wo;
    outcome.view.bsdf = &bsdf;
    outcome.view.eta = options.eta;
    evidence.views.push_back(std::move(outcome.view));
    if (options.conserves_energy) {
      evidence.albedos.push_back(albedo_seen(check_energy("", bsdf, wo, options), wo, options));
    }
  }
  if (options.reciprocal) evidence.reciprocity = judge_reciprocity("", bsdf, options).pairs;
  return diagnose(evidence);
}

inline Cause cause_of(const SamplingPair& pair, std::uint64_t seed) {
  ContractOptions options;
  options.seed = seed;
  return diagnose({{judge_pair(pair, options).view}, {}, {}});
}

inline FaultyCase of(std::string name, CauseKind right, const SamplingPair& pair) {
  return {std::move(name), right, [pair](std::uint64_t seed) { return cause_of(pair, seed); }};
}

/// From the front at these angles [°], held to neither reciprocity nor energy.
inline BsdfOptions from(std::vector<double> angles) {
  BsdfOptions o;
  o.angles = std::move(angles);
  o.back = false;
  o.reciprocal = false;
  o.conserves_energy = false;
  return o;
}

inline FaultyCase of(std::string name, CauseKind right, ErasedBsdf b,
                     BsdfOptions options = from({30, 60, 75})) {
  return {std::move(name), right, [b, options](std::uint64_t seed) {
            BsdfOptions o = options;
            o.contract.seed = seed;
            return cause_of(b, o);
          }};
}

inline void expect_named(const std::vector<FaultyCase>& cases) {
  for (const FaultyCase& c : cases) {
    const Cause cause = c.run(tests::check_seed(c.name));
    std::printf("%-40s %-22s %s%s%s\n", c.name.c_str(), std::string(to_string(cause.kind)).c_str(),
                cause.headline.c_str(),
                cause.second.empty() ? "" : " | or: ", cause.second.c_str());
    std::fflush(stdout);
    EXPECT_EQ(to_string(cause.kind), to_string(c.right)) << c.name << ": " << cause.headline;
  }
}

}  // namespace plumbline::verify
