#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/detail/domain.h>
#include <plumbline/verify/detail/many.h>
#include <plumbline/verify/detail/plain_maps.h>
#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/detail/record.h>
#include <plumbline/verify/detail/report.h>
#include <plumbline/verify/detail/settings.h>
#include <plumbline/verify/detail/vector_access.h>

namespace plumbline::verify {

/// One lobe of a mixture, as if it were the whole: with probability `probability` the sampler draws
/// from it, so that pdf = Σ probability · lobe pdf.
struct PairLobe {
  std::string name;
  double probability = 1;

  /// Empty where it takes a generator, or more numbers than the domain has dimensions: the Jacobian
  /// of that lobe is skipped then.
  Many<std::optional<SampleRecord>(Uniforms)> sample;

  Many<double(Vec3)> pdf;

  /// In place of `sample`.
  std::function<std::optional<SampleRecord>(Random&)> draw = {};
};

/// A point with probability mass.
struct Atom {
  Vec3 x{};
  double mass = 0;
};

/// Something that a wrong pdf may have lost or gained as a factor, for the diagnosis: "cosθ at the
/// light", "G1". Its inverse and its square are suspected too.
struct Suspect {
  std::string name;
  std::function<double(const Vec3&)> value;
};

/// `sample` with its `pdf` over a domain: what the contract checks are about. BSDFs, lights, light
/// selection, warps and phase functions are all brought into this form.
struct SamplingPair {
  std::string name;
  Domain domain = Domain::sphere();

  /// How many of the uniform numbers the map uses: the Jacobian needs as many as the domain has
  /// dimensions.
  int numbers = 2;

  /// Rounding unit of the code under test: 2^-24 for float, 2^-53 for double. Decides which uniform
  /// numbers it gets and how closely it can be expected to agree with itself.
  double epsilon = 0x1p-53;

  // All of these are written for one point, or for spans of them: see many.h.

  /// nullopt: the sample was rejected.
  Many<std::optional<SampleRecord>(Uniforms)> sample;

  /// In place of `sample`, for code that takes a random generator. The Jacobian is skipped then.
  std::function<std::optional<SampleRecord>(Random&)> draw;

  Many<double(Vec3)> pdf;

  /// What weight · pdf must equal: f·|cosθ| of a BSDF. Empty where the pair has no weight.
  Many<Channels(Vec3)> value;

  /// Numbers that lead to a point: of several, any. Empty where the pair has no inverse.
  Many<Uniforms(Vec3)> inverse;

  std::vector<PairLobe> lobes;  ///< of a mixture; empty: one smooth map

  /// Several u lead to the same point. With `preimages` the Jacobian check sums over them; without,
  /// and without lobes, it is skipped, and says so.
  bool many_to_one = false;
  std::function<std::vector<Uniforms>(const Vec3&)> preimages;

  std::vector<Atom> atoms;  ///< that are known beforehand; others are taken from the records

  std::vector<Suspect> suspects;

  /// One sample from the generator, by whichever of `sample` and `draw` there is.
  std::optional<SampleRecord> next(Random& random) const;

  /// The next ones: the same as one by one.
  void next(Random& random, std::span<std::optional<SampleRecord>> samples) const;
};

/// A pair from a plain map and its density, for warps, lights and the like.
///
/// @tparam Point   of the user: a number, or a vector with x, y (, z) or operator[]
/// @param sample   one to eight uniform numbers of the point's scalar type, or a Random&; to a
/// point
///                 or an optional one, or to a record of a point (point, position, wi, direction or
///                 dir) with weight (throughput, value, f), pdf or both. With more than three
///                 numbers the Jacobian is skipped.
/// @param pdf      of a point
/// @param value    of a point, a number or colour: what weight · pdf must equal
template <class Point, class Sample, class Pdf, class Value = detail::NoValue>
SamplingPair sampling_pair(std::string name, Domain domain, Sample sample, Pdf pdf,
                           Value value = {}) {
  SamplingPair pair;
  pair.name = std::move(name);
  pair.domain = std::move(domain);
  using T = PointScalar<Point>;
  pair.epsilon = std::is_same_v<T, float> ? 0x1p-24 : 0x1p-53;
  constexpr std::size_t numbers = detail::numbers_taken<T, Sample>();
  if constexpr (numbers == 0) {
    pair.draw = [sample](Random& random) { return detail::record_of_plain(sample(random)); };
  } else if constexpr (numbers > std::tuple_size_v<Uniforms>) {
    pair.draw = [sample](Random& random) {
      std::array<T, numbers> u;
      for (T& number : u) number = uniform<T>(random);
      return detail::record_of_plain(std::apply(sample, u));
    };
  } else {
    pair.numbers = static_cast<int>(numbers);
    pair.sample = [sample](const Uniforms& u) {
      return detail::record_of_plain(detail::call_with<T, numbers>(sample, u));
    };
  }
  pair.pdf = [pdf](const Vec3& x) { return static_cast<double>(pdf(from_point<Point>(x))); };
  if constexpr (!std::is_same_v<Value, detail::NoValue>) {
    pair.value = [value](const Vec3& x) { return to_channels(value(from_point<Point>(x))); };
  }
  return pair;
}

/// The same pair with the inverse of its map.
///
/// @tparam Point    as for `sampling_pair`
/// @param inverse   of a point, to the numbers that lead there: one, or as many as x, y (, z) or
///                  operator[] give
template <class Point, class Inverse>
SamplingPair with_inverse(SamplingPair pair, Inverse inverse) {
  pair.inverse = [inverse](const Vec3& x) -> Uniforms {
    return to_point(inverse(from_point<Point>(x)));
  };
  return pair;
}

/// How hard a sampling pair is looked at.
struct ContractOptions : CheckSettings {
  // Deterministic checks.
  int points = 10'000;          ///< of the pointwise checks
  int jacobian_points = 2'000;  ///< at most

  /// |∫pdf + atoms + rejected − 1| that a pass allows. Unless stated, the promise is 5e-5 where the
  /// integral is known that well, else 1e-3 (a density with jumps, a rejected share that only
  /// samples show); the result says which. What rounding of the points may do to the pdf is
  /// measured and added: nothing to speak of in double, 1e-3 for a lobe as narrow as float
  /// resolves.
  std::optional<double> mass_tolerance;

  std::uint64_t evaluations = 4'000'000;  ///< of the pdf, at most, to integrate it

  // Chi-square.
  std::uint64_t first_look = 100'000;
  std::uint64_t samples = 1'000'000;  ///< at the last look
  int finest_bins = 4096;             ///< of about equal expected mass; coarser levels are merged

  /// A pass proves that the relative deviation of the samples' density from the pdf, root mean
  /// square over the 64 bins of the coarsest level, is at most this.
  double deviation = 0.0125;

  // How it is run.

  /// Is given each result of a battery as soon as its verdict is certain, before its cause is
  /// looked for: what needs no statistics of all directions first. Of several threads, one at a
  /// time.
  std::function<void(const CheckResult&)> decided = {};

  /// Directions of a BSDF that are looked at at the same time; the results are the same. More than
  /// one for code whose functions may be called from several threads: first it is asked the same
  /// twice, in another order, and one that answers differently is refused
  /// (std::invalid_argument).
  int threads = 1;
};

/// The whole battery on one sampling pair: record and weight pointwise, support, Jacobian, inverse,
/// integral, chi-square. Results are named pair/check; a check that the pair has no ground for is
/// left out, one that it asks to skip says so (inconclusive, as expected).
///
/// On failure the report names its cause: the one hypothesis that explains everything in it up to
/// rounding and sampling error, or none.
Report check_pair(const SamplingPair& pair, const ContractOptions& options = {});

/// pdf · |∂x/∂u| = 1 by extrapolated differences, lobe by lobe. Points at a fold or seam of the
/// map, where differences do not converge, are counted and left out. A pass bounds the relative
/// error by 1e-4 for code in double and by 5e-3 for code in float, whose rounding differences
/// magnify.
///
/// @source Ridders 1982 (Adv. Eng. Software 4:2)
CheckResult check_jacobian(const SamplingPair& pair, const ContractOptions& options = {});

/// The density that the record states equals `pdf`; weight · pdf equals `value`; the density is
/// finite, not negative, and positive wherever the value is; points lie in the domain, also at the
/// corners of the unit square. What rounding of the point itself may change is allowed for.
Report check_pointwise(const SamplingPair& pair, const ContractOptions& options = {});

/// sample(inverse(x)) = x, at samples and anywhere where the density is positive. What rounding of
/// the point and of the numbers may change is allowed for.
///
/// @throws std::invalid_argument for a pair without `inverse`, or without a `sample` of numbers
CheckResult check_inverse(const SamplingPair& pair, const ContractOptions& options = {});

/// ∫pdf + atoms + rejected share = 1: a fit on adaptive cells, corrected at random nodes, with its
/// sampling error.
CheckResult check_integral(const SamplingPair& pair, const ContractOptions& options = {});

/// Chi-square test of samples against the integral of their density over bins that follow it.
///
/// The domain is halved at medians of pilot samples until each bin holds about the same mass, and
/// the density is integrated over each bin with its sampling error. Bins are tested coarse to fine
/// under one level, at growing sample counts. Pooled bins keep what is left over; a bin where the
/// pdf is 0 fails on its first sample, as does any sample where the pdf is 0; rejected samples and
/// atoms are categories of their own.
///
/// `fail` at the level of the error budget; `pass` if the deviation is proven below `deviation` and
/// the masses add up; else `inconclusive`, also where the masses are not known well enough.
CheckResult check_chi_square(const SamplingPair& pair, const ContractOptions& options = {});

/// The same of a sampler of directions alone, for a user's own vector type.
///
/// @param density  pdf_w [1/sr] of a unit direction
/// @param sampler  two numbers uniform in [0, 1), in the scalar of the direction's type, to an
///                 optional direction
template <class Direction, class Density, class Sampler>
CheckResult check_chi_square(std::string subject, Density density, Sampler sampler,
                             const ContractOptions& options = {}) {
  return check_chi_square(sampling_pair<Direction>(std::move(subject), Domain::sphere(),
                                                   std::move(sampler), std::move(density)),
                          options);
}

}  // namespace plumbline::verify
