#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include <plumbline/renderer/core/math.h>

/// How many of N samples each of two techniques gets, learnt from the samples already drawn.
///
/// With N₁ = αN samples from p₁ and the rest from p₂, balanced, the variance of one sample of the
/// mixture p = αp₁ + (1 − α)p₂ is V(α) = ∫ f²/p − μ². From ∂p/∂α = p₁ − p₂:
///   V′(α) = ∫ f² (p₂ − p₁)/p²,   V″(α) = 2 ∫ f² (p₂ − p₁)²/p³ ≥ 0.
/// V is convex: the best α is the one root of V′, or the end of the range that V falls towards.
/// @source Szirmay-Kalos, Sbert, "Root adaptive multiple importance sampling" (Eqs. 3 and 4)
namespace plumbline::renderer {

enum class Allocation {
  equal,           ///< α = 1/2
  lu,              ///< one Newton step from α = 1/2 with V′(1/2) and V″(1/2); Lu et al. 2013
  sbert_moment,    ///< each share ∝ 1/∫ f²/p_i; Sbert et al. 2018
  sbert_variance,  ///< each share ∝ 1/(∫ f²/p_i − μ²); Sbert et al. 2018
  root_v1,         ///< Newton's method, V′ by Eqs. 6 and 7 of the paper above
  root_v2,         ///< Newton's method, V′ by Eqs. 8 and 9
  root_nodes,      ///< root of V′ between nodes at which all samples estimate it; our own
  cost_aware       ///< the same for V(α)·(cost of a sample at α): least variance × time
};

inline constexpr std::array kAllocations{
    Allocation::equal,   Allocation::lu,      Allocation::sbert_moment, Allocation::sbert_variance,
    Allocation::root_v1, Allocation::root_v2, Allocation::root_nodes,   Allocation::cost_aware};

/// The name on the command line: "equal", "lu", "sbert-moment", "root-v1", …
std::string_view name(Allocation policy);

struct AllocationOptions {
  Allocation policy = Allocation::equal;
  double limit = 0.1;             ///< α stays in [limit, 1 − limit]; in (0, 0.5]
  std::uint32_t iterations = 20;  ///< ≥ 1; the first draws both techniques equally often
  double cost_ratio = 1;          ///< time of a sample of technique 1 over one of technique 2, > 0
};

/// A sample as the policies see it: everything relative to the density p = a p₁ + (1 − a)p₂ that it
/// was drawn from, a the fraction of the counts drawn.
struct MixtureSample {
  double value = 0;               ///< g = f/p
  std::array<double, 2> share{};  ///< p₁/p and p₂/p; a·share₁ + (1 − a)·share₂ = 1

  /// p(α)/p, what importance-corrects the sample from a to α.
  double density_at(double alpha) const { return alpha * share[0] + (1 - alpha) * share[1]; }
  double difference() const { return share[1] - share[0]; }  ///< (p₂ − p₁)/p
};

using TechniqueCounts = std::array<std::uint32_t, 2>;

inline double total_count(const TechniqueCounts& counts) {
  return static_cast<double>(counts[0]) + static_cast<double>(counts[1]);
}

/// V′ and V″ at the α that the samples were drawn with. Samples with f = 0 need not be added: the
/// counts know of them.
/// @source Szirmay-Kalos, Sbert, Eqs. 7, 9 and 10
class SlopeSums {
 public:
  void add(std::size_t technique, const MixtureSample& sample);

  /// E₂[f²/p²] − E₁[f²/p²], each technique by its own samples.
  double version_1(const TechniqueCounts& drawn) const;
  /// E_p[f² (p₂ − p₁)/p³], by all samples.
  double version_2(const TechniqueCounts& drawn) const { return slope_ / total_count(drawn); }
  /// 2 E_p[f² (p₂ − p₁)²/p⁴]
  double curvature(const TechniqueCounts& drawn) const { return curvature_ / total_count(drawn); }

 private:
  std::array<double, 2> squares_{};
  double slope_ = 0, curvature_ = 0;
};

/// A policy sees the samples of an iteration, then is asked for the next α.
///
/// `next` returns nullopt where the samples say nothing (no light, equal densities); what it
/// returns may lie outside any range.
class EqualAllocation {
 public:
  void add(std::size_t, const MixtureSample&) {}
  std::optional<double> next(const TechniqueCounts&) { return 0.5; }
};

class LuAllocation {
 public:
  void add(std::size_t, const MixtureSample& sample);
  std::optional<double> next(const TechniqueCounts&);

 private:
  double slope_ = 0, curvature_ = 0;  // at 1/2, from all samples
};

class SbertAllocation {
 public:
  explicit SbertAllocation(bool variance) : variance_(variance) {}
  void add(std::size_t, const MixtureSample& sample);
  std::optional<double> next(const TechniqueCounts& drawn);

 private:
  bool variance_;
  // Of f/p_i, each from the samples of both techniques: one without hits yet is none without
  // variance.
  std::array<double, 2> second_moments_{};
  double sum_ = 0, count_ = 0;
};

/// Newton's method on V′, the derivatives aggregated over the iterations: the new ones get weight
/// 1/√n, the old V′ is first moved to the new α by V″.
/// @source Szirmay-Kalos, Sbert, Eq. 5 and Section 3.4
class RootAllocation {
 public:
  explicit RootAllocation(bool version_1) : version_1_(version_1) {}
  void add(std::size_t technique, const MixtureSample& sample) { sums_.add(technique, sample); }
  std::optional<double> next(const TechniqueCounts& drawn);

 private:
  bool version_1_;
  SlopeSums sums_;  // of this iteration
  double slope_ = 0, curvature_ = 0, alpha_ = 0.5, iteration_ = 0;
};

/// V′ at a few α, each from all samples of all iterations, importance-corrected from the mixture
/// that each was drawn with: nothing is forgotten and nothing is extrapolated. The sums grow with α
/// (every sample's term does), so that their root is bracketed by two nodes; between them V′ is
/// taken as A/(1 − α)² − B/α², exact where each technique has the region of the domain that it
/// samples to itself.
///
/// With a cost ratio c other than 1: the root of (V·C)′, C = αc + 1 − α.
class NodeAllocation {
 public:
  NodeAllocation(double limit, double cost_ratio);
  void add(std::size_t, const MixtureSample& sample);
  std::optional<double> next(const TechniqueCounts& drawn);

 private:
  static constexpr std::size_t kNodes = 9;

  double slope_at(std::size_t k) const;

  double cost_ratio_;
  std::array<double, kNodes> alpha_{}, slope_{}, moment_{};
  double sum_ = 0, count_ = 0;
};

/// A policy at work on one integral: one pixel.
class Allocator {
 public:
  explicit Allocator(const AllocationOptions& options);

  /// Wanted share of technique 1, always within the limits.
  double alpha() const { return alpha_; }

  /// αn rounded, each technique at least once. n ≥ 2.
  TechniqueCounts counts(std::uint32_t n) const;

  /// Samples of f = 0 may be left out; what is not finite is.
  void add(std::size_t technique, const MixtureSample& sample);

  /// Ends an iteration in which these counts were drawn, and finds the next α.
  void end_iteration(const TechniqueCounts& drawn);

 private:
  using Policy =
      std::variant<EqualAllocation, LuAllocation, SbertAllocation, RootAllocation, NodeAllocation>;
  static Policy make_policy(const AllocationOptions& options);

  Policy policy_;
  double limit_;
  double alpha_ = 0.5;
};

/// What a technique drew: f over its own density, and both densities at the point, in one measure.
/// A technique that failed gives value 0.
template <class Value>
struct TechniqueSample {
  Value value{};         ///< f/pdf
  double pdf = 1;        ///< of the technique that drew it, > 0; the mass of an atom
  double other_pdf = 0;  ///< of the other one, ≥ 0
};

namespace allocation_detail {

/// What the policies see of a contribution.
inline double brightness(double value) { return value; }
inline double brightness(const Rgbd& value) { return luminance(value); }

}  // namespace allocation_detail

/// Draws `samples` samples in the iterations that the options ask for.
///
/// Each counts once, as f/p with p the mixture of the integer counts that its iteration really
/// drew: the balance heuristic. Their mean is unbiased, because an iteration's α depends on those
/// before it only. Weighting the iterations by their estimated variances instead would be biased.
///
/// @param samples  ≥ 2 · iterations
/// @param draw     draw(technique) → TechniqueSample, technique 0 or 1
/// @param record   record(iteration, technique, f/p), for every sample
template <class Draw, class Record>
void allocate_samples(const AllocationOptions& options, std::uint64_t samples, const Draw& draw,
                      const Record& record) {
  Allocator allocator(options);
  for (std::uint64_t i = 0; i < options.iterations; ++i) {
    const auto size = static_cast<std::uint32_t>(samples * (i + 1) / options.iterations -
                                                 samples * i / options.iterations);
    const TechniqueCounts counts = allocator.counts(size);
    for (std::size_t t = 0; t < 2; ++t) {
      const double own = counts[t] / total_count(counts);
      for (std::uint32_t s = 0; s < counts[t]; ++s) {
        const auto sample = draw(t);
        const double ratio = sample.other_pdf / sample.pdf;
        const double share = 1 / (own + (1 - own) * ratio);
        const auto contribution = sample.value * share;
        record(static_cast<std::uint32_t>(i), t, contribution);
        MixtureSample seen{allocation_detail::brightness(contribution), {}};
        if (seen.value == 0) continue;
        seen.share[t] = share;
        seen.share[1 - t] = ratio * share;
        allocator.add(t, seen);
      }
    }
    allocator.end_iteration(counts);
  }
}

}  // namespace plumbline::renderer
