#pragma once

#include <optional>
#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/pair.h>

/// What the checks of a pair or BSDF saw, all of it, for one diagnosis of the whole report. Nothing
/// here is a verdict: ratios that agree are evidence too, they say which function is right.
namespace plumbline::verify {

/// What stands over what. Each ratio is 1 for correct code.
enum class RatioKind {
  record_over_pdf,       ///< pdf stated in the record / pdf()
  weight_over_value,     ///< weight · pdf() / value, brightest channel
  density_over_pdf,      ///< density of the samples, 1/|∂x/∂u| (summed over branches) / pdf()
  lobe_density_over_pdf  ///< the same of one lobe alone / the lobe's own pdf
};

/// A ratio at a point.
struct RatioAt {
  Vec3 x{};
  double ratio = 1;
  double error = 0;  ///< of the ratio, relative: what rounding or differences may be off by
  int lobe = -1;     ///< of lobe_density_over_pdf

  /// The random numbers that lead there, where they are known to be the only ones.
  std::optional<Uniforms> u = {};
};

struct RatioSeries {
  RatioKind kind{};
  std::vector<RatioAt> points;
};

/// A bin with its counts, and a few points of it that share out its expected mass.
struct BinSeen {
  double observed = 0, expected = 0;
  double expected_error = 0;   ///< standard error of `expected`
  std::vector<Vec3> nodes;     ///< about evenly spread over the bin
  std::vector<double> shares;  ///< of the bin's expected mass, sum to 1

  /// Measure of the domain that each node stands for, sum to the bin's; may be empty. A hypothesis
  /// under which the density is smooth where the pdf is not is judged by both.
  std::vector<double> measures;
};

/// ∫pdf + atoms + rejected = 1, and how well each is known (at the level of a fail).
struct MassSeen {
  double integral = 1, integral_error = 0;
  double atoms = 0;
  double rejected = 0, rejected_error = 0;
};

/// One pair: a BSDF seen from one direction, a light, a warp.
struct ViewEvidence {
  const SamplingPair* pair = nullptr;
  std::optional<Vec3> wo;            ///< of a BSDF
  const ErasedBsdf* bsdf = nullptr;  ///< of a BSDF: pdf and eval at any arguments
  double eta = 1;                    ///< of a BSDF, below over above
  std::vector<RatioSeries> ratios;   ///< of the kinds that were measured, also where they agree
  std::vector<BinSeen> bins;         ///< at the finest level that counts about 100 in each
  double samples = 0;                ///< that the bins were counted from
  std::optional<MassSeen> mass;
  std::vector<Vec3> strays;  ///< samples where the pdf is 0 all around, or outside the domain
  double stray_share = 0;    ///< of all samples
  bool failed = false;       ///< any check of this pair did
};

/// f(wo, wi)/η_o² over f(wi, wo)/η_i².
struct ReciprocityAt {
  Vec3 wo{}, wi{};
  double ratio = 1;
  double error = 0;  ///< relative, from the conditioning of both
};

/// Directional albedo from one direction, against what is known (or 1 as its bound).
struct AlbedoAt {
  Vec3 wo{};
  double albedo = 0, error = 0;
  std::optional<double> known;
};

/// Everything that one report knows.
struct ReportEvidence {
  std::vector<ViewEvidence> views;
  std::vector<ReciprocityAt> reciprocity;
  std::vector<AlbedoAt> albedos;
};

}  // namespace plumbline::verify
