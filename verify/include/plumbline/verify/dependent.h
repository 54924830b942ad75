#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/detail/domain.h>
#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/detail/report.h>
#include <plumbline/verify/detail/settings.h>
#include <plumbline/verify/detail/vector_access.h>
#include <plumbline/verify/mean.h>
#include <plumbline/verify/pair.h>

/// Samples that depend on each other: nets and strata, resampled candidates, Markov chains. A test
/// for independent samples says nothing of them; what can be proven rests on replicates that are
/// independent.
namespace plumbline::verify {

// Nets and strata.

/// Randomised point sets in [0, 1)^d.
struct PointSets {
  std::string name;
  std::size_t dimensions = 2;

  /// n points, one after the other: n × dimensions numbers. `replicate` seeds the randomisation;
  /// sets of different replicates are independent. The checks ask for consecutive replicates from
  /// a random one on, as pixels are numbered.
  std::function<std::vector<double>(std::uint64_t replicate, std::size_t n)> points;
};

struct StratifiedOptions : CheckSettings {
  std::size_t points = 256;  ///< n, ≥ 1
  int replicates = 16;       ///< looked at, ≥ 1
};

/// In each dimension exactly one point in each of the strata [k/n, (k + 1)/n): a Latin hypercube.
/// Exact: one point too many fails. Where n is no power of 2, points are to be in double: what lies
/// less than 2^-48 below an edge counts as on it. Nothing is said of how points lie within their
/// strata, or of what the dimensions have to do with each other: `check_replicates`.
///
/// @source McKay, Beckman, Conover 1979 (Technometrics 21:2), Section 2.1
/// @throws std::invalid_argument for options that make no sense, or where other than n ×
///         dimensions numbers are returned; so do the others
CheckResult check_stratified(const PointSets& sets, const StratifiedOptions& options = {});

struct NetOptions : CheckSettings {
  int base = 2;  ///< b, ≥ 2
  int m = 8;     ///< b^m points, at most 2^24
  int t = 0;     ///< quality, 0 ≤ t ≤ m

  /// Dimensions are looked at in groups of so many, 0 1, 2 3, …: 2 for padded pairs. 0: all are one
  /// group.
  std::size_t group = 2;

  /// Each aligned block of b^k points, t ≤ k ≤ m, is a net too: what a (t, s)-sequence promises.
  bool sequence = false;

  int replicates = 16;  ///< looked at, ≥ 1
};

/// Whether the points of each group are a (t, m, s)-net in base b: every elementary interval
/// Π [a_i/b^d_i, (a_i + 1)/b^d_i) of volume b^(t − m) holds exactly b^t of them. Exact; in
/// bases that are no power of 2 with double's rounding, as above.
///
/// @source Niederreiter 1992 (SIAM CBMS 63), Definitions 4.1 and 4.2
CheckResult check_net(const PointSets& sets, const NetOptions& options = {});

struct ReplicateOptions : CheckSettings {
  std::size_t points = 16;          ///< n, ≥ 1; each is tested by itself
  std::uint64_t replicates = 8192;  ///< ≥ 2048

  /// A pass proves that no tested marginal deviates from the uniform density by more than that,
  /// root mean square over 64 bins, relative.
  double deviation = 0.25;
};

/// Whether the randomisation makes each point uniform by itself, which is what makes means
/// unbiased: point i over the replicates in each dimension (64 bins), and in each pair of
/// neighbouring dimensions (8 × 8): two that are scrambled alike are each uniform, and together on
/// a diagonal. Points of one replicate may depend on each other as they like.
///
/// `fail` at the level of the error budget, split over the tests, also where a point lies outside
/// [0, 1)^d; `pass` where `deviation` is proven of all.
///
/// @source Owen 1995, Proposition 2 (each point of a scrambled net is uniform)
CheckResult check_replicates(const PointSets& sets, const ReplicateOptions& options = {});

/// Means over the points of one replicate each, as samples for `check_mean` and
/// `check_agreement`: independent, as the points of one set are not.
///
/// @param n     points of a set
/// @param f     of a point
/// @param seed  from which the replicates are numbered
MomentSampler replicate_means(PointSets sets, std::size_t n,
                              std::function<double(std::span<const double>)> f, std::uint64_t seed);

// Resampled importance sampling.

/// A function on the domain that is to be integrated.
struct TestFunction {
  std::string name;
  std::function<double(const Vec3&)> value;
};

/// A point with its unbiased contribution weight W, which stands for 1/density where there is no
/// density to be had.
struct WeightedPoint {
  Vec3 x{};
  double weight = 0;
};

/// A sampler that chooses among candidates, by reservoirs or otherwise.
struct ContributionSampler {
  std::string name;
  Domain domain = Domain::unit_square();  ///< not discrete

  /// nullopt: no candidate could be chosen; counts as W = 0.
  std::function<std::optional<WeightedPoint>(Random&)> sample;

  /// p̂ ≥ 0, not normalised. Where it is 0 nothing is chosen, and nothing can be integrated.
  std::function<double(const Vec3&)> target;
};

struct ContributionOptions : CheckSettings {
  /// Error that a pass allows of ∫f over a region, relative to ∫f over all.
  double tolerance = 0.01;
  std::uint64_t max_samples = std::uint64_t{1} << 23;  ///< of each check

  /// ∫1 too. Only where the target is bounded away from 0, as for `functions`.
  bool constants = false;

  /// Further f. f(X) W is f/p̂ at X times the mean of what candidates weigh: where f/p̂ varies by
  /// thousands, rare choices carry the mean, and as long as no sample shows them correct code may
  /// fail.
  std::vector<TestFunction> functions;
};

/// Whether E[f(X) W] = ∫ f for f the target and further functions, each over 8 regions that hold
/// equally many samples, and over all; f is taken as 0 wherever the target is. The target over
/// every region is enough in principle: E[W | x] times the density of X is 1 wherever it is right.
///
/// X does not have the target's density for any finite number of candidates, and its own is not to
/// be had; so neither a chi-square against the target nor W against 1/pdf would be right. That the
/// mean is right for enough f is all that unbiased means. The integrals are estimated at points of
/// the check's own. Results are named name/function.
///
/// @source Talbot, Cline, Egbert 2005 (EGSR) · Bitterli et al. 2020 (ReSTIR), Eq. 6 and Algorithm 6
///         (1/Z) · Wyman et al. 2023 ("A Gentle Introduction to ReSTIR"), Eq. 3.1
/// @throws std::invalid_argument for a discrete domain, or where `sample` or `target` is missing
Report check_contribution_weights(const ContributionSampler& sampler,
                                  const ContributionOptions& options = {});

// Markov chains.

/// A chain that is to leave a target's distribution as it is.
struct MarkovChain {
  std::string name;
  Domain domain = Domain::unit_square();  ///< not discrete

  /// States of one chain, the first drawn exactly from the target, each other one step on: as many
  /// as there is room for. A rejected proposal repeats the state.
  std::function<void(Random&, std::span<Vec3> states)> run;

  /// Normalised density of the target. Empty: only `run` knows it, by its first states.
  Many<double(Vec3)> pdf = {};
};

/// From init(random) and step(state, random), which return states of any type.
///
/// @param point  of a state: a number or vector; std::identity where the state is one
template <class Init, class Step, class Point>
MarkovChain markov_chain(std::string name, Domain domain, Init init, Step step, Point point,
                         Many<double(Vec3)> pdf = {}) {
  MarkovChain chain{std::move(name), std::move(domain), {}, std::move(pdf)};
  chain.run = [init, step, point](Random& random, std::span<Vec3> states) {
    auto state = init(random);
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (i > 0) state = step(state, random);
      states[i] = to_point(point(state));
    }
  };
  return chain;
}

struct InvarianceOptions {
  /// Seed and budget; chi-square's samples, bins and deviation.
  ContractOptions contract;

  std::vector<std::size_t> steps = {1, 2, 8};  ///< after which to look

  /// Without a pdf: error that a pass allows of the share of a region.
  double tolerance = 0.005;
  std::uint64_t max_samples = std::uint64_t{1} << 22;
};

/// Whether chains that start in the target are in the target after k steps: each look takes the
/// last states of independent chains, so that nothing need be known of how the states of one depend
/// on each other. With a pdf a chi-square test, of the first states too ("start": what fails there
/// is no fault of the step). Without, the shares of 32 regions against those of chains that have
/// made no step.
///
/// It says nothing of how fast a chain mixes, or whether it reaches everything: one that never
/// moves passes, but for a result that says so (inconclusive). Results are named name/k steps.
///
/// @source Gandy, Scott 2020 ("Unit testing for MCMC and other Monte Carlo methods"), Section 2 ·
///         Veach, Guibas 1997 (Metropolis light transport: start from exact samples), Section 3
/// @throws std::invalid_argument for a discrete domain or no `run`
Report check_invariance(const MarkovChain& chain, const InvarianceOptions& options = {});

}  // namespace plumbline::verify
