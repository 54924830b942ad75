#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/dependent.h>
#include <plumbline/verify/detail/stopwatch.h>

#include "means/joint_agreement.h"
#include "pairs/regions.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr int kPilotChains = 1 << 13;
constexpr int kDepthOfChainRegions = 5;
constexpr int kChainsThatMove = 1'000;

Vec3 state_after_steps(const MarkovChain& chain, std::size_t steps, Random& random,
                       std::vector<Vec3>& states) {
  states.resize(steps + 1);
  chain.run(random, states);
  return states.back();
}

std::string name_after_steps(const MarkovChain& chain, std::size_t steps) {
  if (steps == 0) return chain.name + "/start";
  return chain.name + "/" + number(static_cast<std::uint64_t>(steps)) +
         (steps == 1 ? " step" : " steps");
}

CheckResult against_density(const MarkovChain& chain, const InvarianceOptions& options,
                            std::size_t steps) {
  SamplingPair pair;
  pair.name = name_after_steps(chain, steps);
  pair.domain = chain.domain;
  pair.pdf = chain.pdf;
  pair.draw = [&chain, steps, states = std::vector<Vec3>()](Random& random) mutable {
    return SampleRecord{state_after_steps(chain, steps, random, states)};
  };
  return check_chi_square(pair, options.contract);
}

CheckResult against_start(const MarkovChain& chain, const InvarianceOptions& options,
                          const Regions& regions, std::size_t steps) {
  std::vector<JointQuantity> quantities{{"all chains", 0}};
  for (std::size_t r = 0; r < regions.count(); ++r) {
    quantities.push_back({"the share of the region around " + place(regions.center(r)), 0});
  }
  std::vector<Vec3> states;
  const auto sampler = [&](Random& random, std::size_t made) {
    return [&, made](std::uint64_t count, JointMoments& moments) {
      for (std::uint64_t i = 0; i < count; ++i) {
        const std::size_t region = regions.locate(state_after_steps(chain, made, random, states));
        moments.add(0, 1);
        moments.add(1 + region, 1);
      }
    };
  };
  MeanOptions o;
  o.subject = name_after_steps(chain, steps) + "/agreement";
  o.seed = options.contract.seed;
  o.budget = options.contract.budget;
  o.tolerance = options.tolerance;
  o.n0 = kFirstJointLook;
  o.max_samples = options.max_samples;
  Random moved = random_for(options.contract.seed + steps, Stream::chains);
  Random start = random_for(options.contract.seed + steps, Stream::chains_start);
  return agree_jointly(o, quantities, sampler(moved, steps), sampler(start, 0));
}

Regions regions_of_start(const MarkovChain& chain, const InvarianceOptions& options) {
  Random random = random_for(options.contract.seed, Stream::chains_pilot);
  std::vector<Vec3> points, states;
  for (int i = 0; i < kPilotChains; ++i)
    points.push_back(state_after_steps(chain, 0, random, states));
  return {chain.domain, points, kDepthOfChainRegions};
}

bool any_moves(const MarkovChain& chain, const InvarianceOptions& options, std::size_t steps) {
  Random random = random_for(options.contract.seed, Stream::chains_pilot);
  std::vector<Vec3> states;
  for (int i = 0; i < kChainsThatMove; ++i) {
    const Vec3 last = state_after_steps(chain, steps, random, states);
    if (last != states.front()) return true;
  }
  return false;
}

}  // namespace

Report check_invariance(const MarkovChain& chain, const InvarianceOptions& options) {
  if (!chain.run || chain.domain.size() > 0 || options.steps.empty()) {
    throw std::invalid_argument("chain '" + chain.name +
                                "': needs `run`, steps, and a domain that is not discrete");
  }
  Report report;
  if (chain.pdf) {
    report.results.push_back(against_density(chain, options, 0));
    for (const std::size_t k : options.steps) {
      report.results.push_back(against_density(chain, options, k));
    }
  } else {
    const Regions regions = regions_of_start(chain, options);
    for (const std::size_t k : options.steps) {
      report.results.push_back(against_start(chain, options, regions, k));
    }
  }
  const std::size_t most = *std::max_element(options.steps.begin(), options.steps.end());
  if (!any_moves(chain, options, most)) {
    CheckResult r;
    r.kind = CheckKind::samples;
    r.subject = chain.name + "/samples";
    r.seed = options.contract.seed;
    r.reason = "none of 1000 chains has moved in " + number(static_cast<std::uint64_t>(most)) +
               " steps, so that nothing was tested";
    r.advice = "see that proposals are accepted at all";
    report.results.push_back(r);
  }
  return report;
}

}  // namespace plumbline::verify
