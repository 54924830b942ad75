#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/detail/record_access.h>
#include <plumbline/verify/detail/report.h>
#include <plumbline/verify/detail/settings.h>
#include <plumbline/verify/pair.h>

/// BSDFs whose `eval` and `pdf` are random: layers that light walks through. What they return is an
/// estimate, right in the mean only.
///
/// What is unbiased, and what is not, with f̂ and p̂ what eval and pdf return, E[f̂] = f:
///
/// - The weight of a sample, E[weight | wi] = f·|cosθi|/p(wi), where p is the density that samples
///   have. A walk that multiplies its own factors gives that. f̂·|cosθi|/p̂ does not: E[1/p̂] ≥
///   1/E[p̂] (Jensen), so that p̂ as a divisor makes too bright, even if E[p̂] = p. Where p̂ comes
///   near to 0 that has no variance either, and the check stays inconclusive.
/// - A multiple importance sample in which p̂ enters weights only:
///     w_light(p̂) f̂·|cosθ|·L/p_light + w_bsdf(p̂) weight·L,   w_light(p̂) + w_bsdf(p̂) = 1.
///   Its mean is ∫ f·|cosθ|·L · (E[w_light(p̂)] + E[w_bsdf(p̂)]), hence right for any p̂ at all,
///   also one that is nobody's density, if p̂ given wi (i) has one distribution at both places, be
///   it the same number or one drawn anew, (ii) is independent of f̂ where light is sampled, and
///   (iii) of the weight where the BSDF is. Not right: a p̂ that comes with the sample (that of the
///   last vertex, say: samples pick vertices that make it large) at one place and pdf() at the
///   other; f̂ and p̂ from one walk, or from generators with one seed.
/// - p̂ itself, E[p̂] = p: needed where something is divided by it in the mean, or for how good
///   weights are; not for their mean.
///
/// @source Veach 1997, Section 9.2.1 (weights that sum to 1) · Guo, Hašan, Zhao 2018 (position-free
///         walks) · Pharr, Jakob, Humphreys 2023, Section 14.3 (LayeredBxDF: weights by the walk,
///         pdf() an estimate of an approximation)
namespace plumbline::verify {

/// All directions in the local frame, z the normal, pointing away from the surface.
struct StochasticBsdf {
  std::string name;

  /// A direction with its weight. `pdf` of the record: what multiple importance sampling uses in
  /// this place; to be left out where pdf() is asked instead (pbrt's pdfIsProportional). `mass` not
  /// 0: a direction of an atom, whose probability need not be known; its weight is light that eval
  /// says nothing of.
  std::function<std::optional<SampleRecord>(const Vec3& wo, Random&)> sample;

  /// Estimate of f [1/sr], without the cosine.
  std::function<Channels(const Vec3& wo, const Vec3& wi, Random&)> eval;

  /// Estimate of a density [1/sr], ≥ 0. May be empty.
  std::function<double(const Vec3& wo, const Vec3& wi, Random&)> pdf;
};

struct StochasticOptions : CheckSettings {
  std::vector<double> angles = {10, 45, 75};  ///< of wo from the normal, degrees, < 90
  bool front = true, back = true;             ///< sides to look from

  /// Error that a pass allows: of what a region reflects relative to the albedo, of its share of
  /// samples relative to all, of what is seen of a light relative to that. In each channel.
  double tolerance = 0.01;

  std::uint64_t max_samples = std::uint64_t{1} << 23;  ///< of each side of a check

  bool unbiased_pdf = true;  ///< E[pdf] claims to be the density of samples
  bool mis = true;           ///< whether pdf is meant for weights

  bool reciprocal = true;  ///< E[f(wo, wi)]/η_o² = E[f(wi, wo)]/η_i²
  double eta = 1;          ///< as BsdfOptions::eta

  /// Directional albedo of the first channel, atoms included; empty if not known. A walk that ends
  /// too early the same way in `sample` and in `eval` shows in nothing else.
  std::function<double(const Vec3& wo)> albedo;
};

/// Everything that can be proven of means, from each direction:
///
/// - `eval`: what samples carry into each of 8 regions, Σ weight, equals ∫ E[eval]·|cosθ| over it,
///   in each channel, and in the whole. Regions hold equally many samples, so that an error that
///   integrates to 0 shows where a lobe lies.
/// - `pdf`, if claimed: the share of samples in each region equals ∫ E[pdf] over it; over the
///   whole, ∫ E[pdf] = 1 − rejected − atoms.
/// - `mis`: the mean of the multiple importance sample above, one sample of each, for two caps of
///   light and a smooth sky, with the balance and the power heuristic (β = 2), equals that of
///   sampling without the BSDF. pdf is asked after eval, from the same generator that goes on.
/// - `albedo`, if known; `reciprocity`, over pairs of directions, random and sampled ones, sorted
///   by side, by how far their cosines lie apart and by the sense of the turn: an error would have
///   to average out in each sort.
///
/// Integrals use points of the check's own, spread as samples are. A value that is not finite, and
/// a pdf below 0, fail. Results are named name/face angle/check. Code that works in a generator of
/// its own, seeded by the directions, gives estimates all the same, over random directions.
///
/// @throws std::invalid_argument where `sample` or `eval` is missing, or for angles ≥ 90
Report check_stochastic_bsdf(const StochasticBsdf& bsdf, const StochasticOptions& options = {});

/// From an object with sample(wo, random), eval(wo, wi, random) and, if it has one, pdf(wo, wi,
/// random); SampleRecords, or records and values as
/// `erase_bsdf` reads them.
///
/// @tparam Direction  its vector type
template <class Direction, class B>
StochasticBsdf stochastic_bsdf(std::string name, const B& bsdf) {
  const auto held = std::make_shared<const B>(bsdf);
  StochasticBsdf s;
  s.name = std::move(name);
  s.sample = [held](const Vec3& wo, Random& random) {
    auto record = held->sample(from_vec3<Direction>(wo), random);
    if constexpr (std::is_convertible_v<decltype(record), std::optional<SampleRecord>>) {
      return std::optional<SampleRecord>(std::move(record));
    } else {
      return read_record(record);
    }
  };
  s.eval = [held](const Vec3& wo, const Vec3& wi, Random& random) {
    return to_channels(held->eval(from_vec3<Direction>(wo), from_vec3<Direction>(wi), random));
  };
  if constexpr (requires(const Direction& w, Random& random) { held->pdf(w, w, random); }) {
    s.pdf = [held](const Vec3& wo, const Vec3& wi, Random& random) {
      return static_cast<double>(
          held->pdf(from_vec3<Direction>(wo), from_vec3<Direction>(wi), random));
    };
  }
  return s;
}

/// A BSDF that answers the same each time is the simplest case.
StochasticBsdf stochastic_bsdf(std::string name, const ErasedBsdf& bsdf);

}  // namespace plumbline::verify
