#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/dependent.h>
#include <plumbline/verify/image.h>
#include <plumbline/verify/joint.h>
#include <plumbline/verify/mean.h>
#include <plumbline/verify/pair.h>
#include <plumbline/verify/ratio.h>
#include <plumbline/verify/stochastic.h>

#include "correct_pairs.h"
#include "joint_pairs.h"
#include "means/joint_agreement.h"

/// What every result says of itself: its kind, its subject, its seed, that it took a time and how
/// many samples.
namespace plumbline::verify {
namespace {

constexpr std::uint64_t kSeed = 77;

Moments zeros_and_ones(std::uint64_t, std::uint64_t count) {
  Moments m;
  for (std::uint64_t i = 0; i < count; ++i) m.add(i % 2 == 0 ? 0 : 1);
  return m;
}

SamplingPair root() {
  SamplingPair pair;
  pair.name = "root";
  pair.domain = Domain::interval(0, 1);
  pair.numbers = 1;
  pair.sample = [](const Uniforms& u) -> std::optional<SampleRecord> {
    return SampleRecord{{std::sqrt(u[0]), 0, 0}, {}, {}};
  };
  pair.pdf = [](const Vec3& x) { return 2 * x[0]; };
  pair.inverse = [](const Vec3& x) -> Uniforms { return {x[0] * x[0], 0, 0}; };
  return pair;
}

ContractOptions little_effort() {
  ContractOptions o;
  o.seed = kSeed;
  o.points = 500;
  o.jacobian_points = 200;
  o.evaluations = 20'000;
  o.first_look = o.samples = 20'000;
  o.finest_bins = 64;
  o.deviation = 0.2;
  return o;
}

template <class Options>
Options seeded() {
  Options o;
  o.seed = kSeed;
  return o;
}

template <class Options>
Options named() {
  Options o = seeded<Options>();
  o.subject = "subject";
  return o;
}

Image gray_image() {
  Image image;
  image.width = image.height = 4;
  image.mean.assign(16, 0.5);
  image.variance.assign(16, 0.01);
  image.count.assign(16, 100);
  return image;
}

/// Stratified in both dimensions, and a (0, 2, 2)-net: the diagonal.
PointSets diagonal() {
  PointSets sets{"diagonal", 2, {}};
  sets.points = [](std::uint64_t, std::size_t n) {
    std::vector<double> x;
    for (std::size_t i = 0; i < n; ++i) {
      x.push_back((static_cast<double>(i) + 0.5) / static_cast<double>(n));
      x.push_back((static_cast<double>(i) + 0.5) / static_cast<double>(n));
    }
    return x;
  };
  return sets;
}

BsdfOptions bsdf_options() {
  BsdfOptions o;
  o.contract = little_effort();
  o.back = false;
  return o;
}

std::vector<CheckResult> all_checks() {
  std::vector<CheckResult> all;
  MeanOptions mean = named<MeanOptions>();
  mean.reference = 0.5;
  mean.tolerance = 0.1;
  mean.max_samples = 20'000;
  all.push_back(check_mean(mean, zeros_and_ones));
  all.push_back(check_agreement(mean, zeros_and_ones, zeros_and_ones));
  const JointSampler joint = [](std::uint64_t count, JointMoments& m) {
    for (std::uint64_t i = 0; i < count; ++i) m.add(0, i % 2 == 0 ? 0 : 1);
  };
  all.push_back(agree_jointly(mean, {{"all", 0}}, joint, joint));
  VarianceRatioOptions ratio = named<VarianceRatioOptions>();
  ratio.at_least = 0.5;
  const std::vector<Moments> batches(16, zeros_and_ones(0, 100));
  all.push_back(check_variance_ratio(ratio, std::span<const Moments>(batches),
                                     std::span<const Moments>(batches)));
  all.push_back(check_proportion(named<ProportionOptions>(), 1, 2));
  all.push_back(check_image(named<ImageOptions>(), gray_image(), gray_image()).check);
  const ContractOptions contract = little_effort();
  all.push_back(check_jacobian(root(), contract));
  all.push_back(check_inverse(root(), contract));
  all.push_back(check_integral(root(), contract));
  all.push_back(check_chi_square(root(), contract));
  for (const CheckResult& r : check_pair(root(), contract)) all.push_back(r);
  all.push_back(check_jacobian(joint_pairs::roots(), contract));
  all.push_back(check_integral(joint_pairs::roots(), contract));
  all.push_back(check_chi_square(joint_pairs::roots(), contract));
  for (const CheckResult& r : check_pair(joint_pairs::roots(), contract)) all.push_back(r);
  all.push_back(check_stratified(diagonal(), seeded<StratifiedOptions>()));
  all.push_back(check_net(diagonal(), seeded<NetOptions>()));
  all.push_back(check_replicates(diagonal(), seeded<ReplicateOptions>()));
  const ErasedBsdf diffuse = erased(Diffuse{});
  all.push_back(check_reciprocity("diffuse", diffuse, bsdf_options()));
  all.push_back(check_energy("diffuse", diffuse, {0, 0.6, 0.8}, bsdf_options()));
  return all;
}

TEST(Bookkeeping, EveryResultSaysWhatItIsOf) {
  for (const CheckResult& r : all_checks()) {
    const std::string name = r.subject + ", " + std::string(to_string(r.kind));
    EXPECT_NE(r.kind, CheckKind::other) << name;
    EXPECT_FALSE(r.subject.empty()) << name;
    EXPECT_EQ(r.seed, kSeed) << name;
    EXPECT_GT(r.seconds, 0) << name;
    // An albedo is an integral over nodes, not over samples.
    EXPECT_EQ(r.samples > 0, r.kind != CheckKind::energy) << name;
    EXPECT_FALSE(r.leaned_on.empty() && r.verdict == Verdict::pass) << name;
    // What is not passed says why, and what is undecided says what helps.
    EXPECT_NE(r.reason.empty(), r.verdict != Verdict::pass) << name << ": " << r.reason;
    EXPECT_FALSE(r.advice.empty() && r.verdict == Verdict::inconclusive) << name;
  }
}

}  // namespace
}  // namespace plumbline::verify
