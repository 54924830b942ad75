#include "colour_check.h"

#include <algorithm>

namespace plumbline::tests {

std::array<verify::CheckResult, 3> check_channels(const std::array<verify::MeanOptions, 3>& options,
                                                  const ColourSampler& sampler) {
  std::array<verify::MeanCheck, 3> checks{
      verify::MeanCheck(options[0]), verify::MeanCheck(options[1]), verify::MeanCheck(options[2])};
  std::uint64_t drawn = 0;
  for (;;) {
    std::uint64_t wanted = 0;
    for (const verify::MeanCheck& check : checks) {
      wanted = std::max(wanted, check.samples_wanted());
    }
    if (wanted == 0) break;
    const ColourMoments batch = sampler(drawn, wanted);
    drawn += wanted;
    for (std::size_t i = 0; i < checks.size(); ++i) {
      if (!checks[i].done()) checks[i].add(batch[i]);
    }
  }
  return {checks[0].result(), checks[1].result(), checks[2].result()};
}

std::array<verify::MeanOptions, 3> for_each_channel(const verify::MeanOptions& options,
                                                    const analytic::Colour& answer) {
  std::array<verify::MeanOptions, 3> result{options, options, options};
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i].subject.append("/").append(kChannels[i].name);
    result[i].reference = answer.*kChannels[i].exact;
  }
  return result;
}

}  // namespace plumbline::tests
