#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/verify/detail/result.h>
#include "ways.h"

/// Which part of a renderer is wrong, from which ways of a scene give its known answer and which do
/// not.
namespace plumbline::tests {

/// What the check of one channel came to.
struct ChannelVerdict {
  verify::Verdict verdict = verify::Verdict::inconclusive;
  /// Interval of the estimate over the answer (99.9 %); empty where the answer is 0.
  std::optional<verify::Interval> ratio;
};

ChannelVerdict verdict_of(const verify::CheckResult& result);

/// A way of a scene whose every technique can find all light.
struct WayVerdict {
  Way way;
  std::array<ChannelVerdict, 3> channels;

  bool right() const;  ///< all channels pass
  bool wrong() const;  ///< one fails
};

/// What a scene says of a renderer that fails on it.
struct SceneVerdicts {
  std::vector<WayVerdict> ways;  ///< undecided ones say nothing
  bool one_bounce = true;        ///< light is reflected once: only direct light counts
  /// Depth at which a way that fails is first wrong; empty where that is not known.
  std::optional<int> first_wrong_depth;
};

/// What to ask a scene once more to tell parts from each other: ways that fail, without one option
/// at a time; where none of them is batched, the batched ones by the scalar backend.
std::vector<Way> ways_to_ask(const std::vector<WayVerdict>& seen);

/// "the light samples: what uses them is off by a factor of 2 (1.98 to 2.03), …": the one part that
/// explains all verdicts, the usual constant that is within the interval of every ratio if there is
/// just one, the backend, the channel, the depth. Empty where nothing is wrong, or no part or more
/// than one explains it.
std::string likely_part(const SceneVerdicts& scene);

/// The part to look at where a way that cannot find all light gives the whole answer all the same.
std::string part_that_sees(renderer::Strategy strategy);

}  // namespace plumbline::tests
