#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include <plumbline/renderer/core/mis/heuristics.h>

namespace plumbline::renderer {

/// How the techniques for direct light are combined at every vertex of a path.
enum class Strategy {
  bsdf,        ///< directions from the BSDF only
  light,       ///< points on lights only
  uniform,     ///< directions uniform on the hemisphere only
  mis,         ///< light samples and BSDF samples, weighted by a heuristic
  one_sample,  ///< light or BSDF, chosen at random (Veach 1997, Section 9.2.4)
  average  ///< half of each: a negative control, wrong wherever only one of them finds the light
};

inline constexpr std::array kStrategies{Strategy::bsdf, Strategy::light,      Strategy::uniform,
                                        Strategy::mis,  Strategy::one_sample, Strategy::average};
inline constexpr std::array kHeuristics{Heuristic::balance, Heuristic::power, Heuristic::cutoff,
                                        Heuristic::maximum};

/// The name on the command line: "bsdf", "light", "uniform", "mis", "one-sample", "average".
std::string_view name(Strategy strategy);
/// "balance", "power", "cutoff", "maximum".
std::string_view name(Heuristic heuristic);

/// "balance", "power=2", "cutoff=0.1", "maximum": the heuristic with its parameter, if it has one.
std::string describe(const Weighting& weighting);

/// What `describe` writes; without "=" the usual parameter.
///
/// @return nullopt for an unknown heuristic, a parameter where there is none, β ≤ 0, or α outside
///         [0, 1]
std::optional<Weighting> weighting_from_text(std::string_view text);

/// Whether the heuristic has any effect.
constexpr bool uses_heuristic(Strategy strategy) {
  return strategy == Strategy::mis || strategy == Strategy::one_sample;
}

}  // namespace plumbline::renderer
