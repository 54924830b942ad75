#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

#include <plumbline/analytic/colour.h>
#include <plumbline/renderer/core/math.h>
#include <plumbline/verify/detail/moments.h>
#include <plumbline/verify/detail/result.h>
#include <plumbline/verify/mean.h>

namespace plumbline::tests {

/// One channel by name, in answers and in what is rendered.
struct Channel {
  std::string_view name;
  double analytic::Colour::*exact;
  double renderer::Rgbd::*rendered;
};

inline constexpr std::array<Channel, 3> kChannels{
    {{"red", &analytic::Colour::r, &renderer::Rgbd::r},
     {"green", &analytic::Colour::g, &renderer::Rgbd::g},
     {"blue", &analytic::Colour::b, &renderer::Rgbd::b}}};

/// Moments of the same samples in red, green and blue.
using ColourMoments = std::array<verify::Moments, 3>;

/// As verify::MomentSampler.
using ColourSampler = std::function<ColourMoments(std::uint64_t first, std::uint64_t count)>;

/// `check_mean` of each channel, all of them fed by one pass of samples, until each is decided:
/// three checks of the error budget, whose levels hold whatever the channels have to do with each
/// other. Where they are proportional to each other, as under one light and one bounce, they are
/// decided by the same samples: three cost what one does.
///
/// @param options  by channel; with the same counts of samples, or some wait for others
std::array<verify::CheckResult, 3> check_channels(const std::array<verify::MeanOptions, 3>& options,
                                                  const ColourSampler& sampler);

/// The options once for each channel, with its name behind the subject and its answer.
std::array<verify::MeanOptions, 3> for_each_channel(const verify::MeanOptions& options,
                                                    const analytic::Colour& answer);

}  // namespace plumbline::tests
