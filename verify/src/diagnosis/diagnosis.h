#pragma once

#include <string>
#include <vector>

#include <plumbline/verify/pair.h>

/// What is likely wrong, from the ratio of what was observed to what was expected.
namespace plumbline::verify {

/// observed/expected at a point, with the weight of its logarithm (inverse variance, up to a
/// factor).
struct RatioPoint {
  Vec3 x{};
  double ratio = 1;
  double weight = 1;
};

/// What a check found: in words what is over what, the ratio, and samples that no pdf expected.
struct RatioEvidence {
  std::string quotient;     ///< "observed/expected"
  std::string denominator;  ///< that a remark blames: "pdf"
  std::vector<RatioPoint> points;
  double noise = 0;          ///< of a logarithm at weight 1, standard deviation; 0: none
  std::vector<Vec3> strays;  ///< samples where the pdf is 0
  double stray_share = 0;    ///< of all samples
};

/// A guess, and how well it fits.
struct Diagnosis {
  std::string text;
  double r_squared = 0;
  double constant = kNotApplicable;  ///< the ratio, if it is the same everywhere
};

/// The best of the usual suspects: constant factors, cosθ, sinθ, what the pair suspects itself (4
/// wo·h, G1, η², …), swapped or mirrored arguments, lobe probabilities, a support too small. No
/// text where nothing fits.
Diagnosis diagnose(const SamplingPair& pair, const RatioEvidence& evidence);

}  // namespace plumbline::verify
