#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/dependent.h>

#include "means/joint_agreement.h"
#include "pairs/regions.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr int kPilotPoints = 1 << 15;
constexpr int kDepthOfWeightRegions = 3;

std::vector<Vec3> pilot_points(const ContributionSampler& sampler, std::uint64_t seed) {
  Random random = random_for(seed, Stream::contribution_pilot);
  std::vector<Vec3> points;
  for (int i = 0; i < kPilotPoints; ++i) {
    const std::optional<WeightedPoint> p = sampler.sample(random);
    if (p && p->weight != 0) points.push_back(p->x);
  }
  return points;
}

CheckResult check_function(const ContributionSampler& sampler, const ContributionOptions& options,
                           const Regions& regions, const TestFunction& f) {
  std::vector<JointQuantity> quantities{{"the integral", 0}};
  for (std::size_t r = 0; r < regions.count(); ++r) {
    quantities.push_back({"the integral over the region around " + place(regions.center(r)), 0});
  }
  const auto add = [](JointMoments& moments, std::size_t region, double value) {
    moments.add(0, value);
    moments.add(1 + region, value);
  };
  // 0 where the target is: no such point is ever chosen, and none needs to be.
  const auto value = [&](const Vec3& x) { return sampler.target(x) > 0 ? f.value(x) : 0; };
  Random of_samples = random_for(options.seed, Stream::contribution_samples);
  Random of_points = random_for(options.seed, Stream::contribution_points);
  MeanOptions o;
  o.subject = sampler.name + "/" + f.name;
  o.seed = options.seed;
  o.budget = options.budget;
  o.tolerance = options.tolerance;
  o.n0 = kFirstJointLook;
  o.max_samples = options.max_samples;
  return agree_jointly(
      o, quantities,
      [&](std::uint64_t count, JointMoments& moments) {
        for (std::uint64_t i = 0; i < count; ++i) {
          const std::optional<WeightedPoint> p = sampler.sample(of_samples);
          if (p) add(moments, regions.locate(p->x), value(p->x) * p->weight);
        }
      },
      [&](std::uint64_t count, JointMoments& moments) {
        for (std::uint64_t i = 0; i < count; ++i) {
          const Regions::Point p = regions.draw(of_points);
          add(moments, p.region, value(p.x) * p.inverse_density);
        }
      });
}

}  // namespace

Report check_contribution_weights(const ContributionSampler& sampler,
                                  const ContributionOptions& options) {
  if (!sampler.sample || !sampler.target) {
    throw std::invalid_argument("sampler '" + sampler.name + "': needs `sample` and `target`");
  }
  const Regions regions(sampler.domain, pilot_points(sampler, options.seed), kDepthOfWeightRegions);
  std::vector<TestFunction> functions{{"target", sampler.target}};
  if (options.constants) functions.push_back({"one", [](const Vec3&) { return 1.0; }});
  functions.insert(functions.end(), options.functions.begin(), options.functions.end());
  Report report;
  for (const TestFunction& f : functions) {
    report.results.push_back(check_function(sampler, options, regions, f));
  }
  return report;
}

}  // namespace plumbline::verify
