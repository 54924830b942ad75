#pragma once

#include <array>
#include <optional>
#include <string_view>

#include <plumbline/renderer/mis/heuristics.h>

namespace plumbline::renderer {

/// How the techniques for direct light are combined at every vertex of a path.
enum class Strategy {
  bsdf,       ///< directions from the BSDF only
  light,      ///< points on lights only
  uniform,    ///< directions uniform on the hemisphere only
  mis,        ///< one light sample and one BSDF sample, weighted by a heuristic
  one_sample  ///< light or BSDF, chosen with probability 1/2 (Veach 1997, Section 9.2.4)
};

inline constexpr std::array kStrategies{Strategy::bsdf, Strategy::light, Strategy::uniform,
                                        Strategy::mis, Strategy::one_sample};
inline constexpr std::array kHeuristics{Heuristic::balance, Heuristic::power};

/// The name on the command line: "bsdf", "light", "uniform", "mis", "one-sample".
std::string_view name(Strategy strategy);
/// "balance", "power".
std::string_view name(Heuristic heuristic);

/// @return nullopt for a name that no strategy has
std::optional<Strategy> strategy_from_name(std::string_view text);
std::optional<Heuristic> heuristic_from_name(std::string_view text);

/// Whether the heuristic has any effect.
constexpr bool uses_heuristic(Strategy strategy) {
  return strategy == Strategy::mis || strategy == Strategy::one_sample;
}

}  // namespace plumbline::renderer
