#pragma once

#include <cstdint>

#include <plumbline/verify/image.h>
#include <plumbline/verify/pair.h>

/// Sampling pairs and images that the experiments look at.
namespace plumbline::calibration {

/// Directions with density cosθ/π, and a pdf that says (1 + ε (cosθ − 2/3)) cosθ/π: a tilt that
/// leaves the integral alone. Root mean square deviation: ε·√(1/18).
verify::SamplingPair tilted_cosine(double epsilon);

/// Half of the directions in a lobe about z, half with density cosθ/π; the pdf gives the lobe the
/// weight stated.
verify::SamplingPair lobe_mixture(double stated_weight);

/// A render of a grey image, exponential noise, its mean `bias` times the answer 1.
verify::Image noisy_image(int edge, int samples_per_pixel, double bias, std::uint64_t seed);

/// The answer to it.
verify::Image grey_image(int edge);

}  // namespace plumbline::calibration
