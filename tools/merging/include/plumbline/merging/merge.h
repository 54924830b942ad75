#pragma once

#include <map>
#include <string>
#include <vector>

#include <plumbline/output/checkpoint.h>
#include <plumbline/renderer/image_io/exr.h>

/// One picture of several, of the same scene and settings, that hold other samples.
namespace plumbline::merging {

/// What the header of a picture says of the settings that its samples depend on, beyond its record.
std::map<std::string, std::string> header_of(const output::CheckpointSettings& settings);

/// Puts checkpoints together: in double, each replicate by itself, sorted by seed and first sample,
/// so that their order here does not matter. Ranges of samples of one seed, and shards, come to
/// what one render of all of them is, but for the order of sums where a pixel has samples of
/// several; other seeds add samples, under Sobol replicates.
///
/// @source Chan, Golub, LeVeque 1979, Eq. 2.1 (PixelMoments::merge)
/// @throws renderer::InputError for samples that are in two of them, pixels that are in none, and
///         parts of other renders, with what is another
renderer::Image merge_checkpoints(std::vector<std::string> files);

/// Puts images together by their layers and headers: each pixel's mean, variance and count, in the
/// order of `merge_checkpoints`, summed in double.
///
/// What it comes to differs from the sum of the same samples without rounding in between by the
/// rounding of the layers to float, u = 2⁻²⁴, of the parts and of the result. In each channel of a
/// pixel, with m the largest |mean| of a part, M, V the mean and variance without rounding:
///
///     mean      |ΔM| ≤ u (m + |M|)
///     variance  |ΔV| ≤ 2u V + 6u m √V + 9u² m²
///
/// The parts' means are off by u m, so is their weighted sum, and the result's rounding adds u|M|.
/// Distances of means d_i = m_i − M are off by e ≤ 2u m, and Σ n_i ((d_i + e)² − d_i²) ≤ 2e √(n B)
/// + n e², B = Σ n_i d_i² ≤ (n − 1) V, by Cauchy and Schwarz; over n − 1 ≥ n/2 that is 2√2 e √V +
/// 2e². Sums of squares within the parts are off by u, the result's rounding is u. Terms in u
/// times these bounds are in the last digits of 6 and 9. It holds where no float underflows.
///
/// @throws renderer::InputError as merge_checkpoints; also for images that do not say which samples
///         they hold, and, under Sobol, for pixels of which two parts hold points of the same
///         scrambles: these depend on each other, and an image does not say how
renderer::Image merge_images(std::vector<std::string> files);

}  // namespace plumbline::merging
