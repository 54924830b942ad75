#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/light/light.h>
#include <plumbline/renderer/core/mis/heuristics.h>
#include <plumbline/renderer/core/render/strategy.h>
#include <plumbline/renderer/core/sampling/sampler.h>

/// What the user chooses by, with the words of the command line and of reports.
namespace plumbline::renderer {

inline constexpr std::array kStrategies{Strategy::bsdf, Strategy::light,      Strategy::uniform,
                                        Strategy::mis,  Strategy::one_sample, Strategy::average};
inline constexpr std::array kHeuristics{Heuristic::balance, Heuristic::power, Heuristic::cutoff,
                                        Heuristic::maximum};
inline constexpr std::array kSamplers{SamplerType::independent, SamplerType::sobol};
inline constexpr std::array kLightSelections{LightSelection::uniform, LightSelection::area,
                                             LightSelection::power};
inline constexpr std::array kBackends{Backend::batched, Backend::scalar};
inline constexpr std::array kAccelerators{Accelerator::automatic, Accelerator::embree,
                                          Accelerator::brute_force};

/// "bsdf", "light", "uniform", "mis", "one-sample", "average".
std::string_view name(Strategy strategy);
/// "balance", "power", "cutoff", "maximum".
std::string_view name(Heuristic heuristic);
/// "independent", "sobol".
std::string_view name(SamplerType sampler);
/// "uniform", "area", "power".
std::string_view name(LightSelection selection);
/// "batched", "scalar".
std::string_view name(Backend backend);
/// "auto", "embree", "brute_force".
std::string_view name(Accelerator accelerator);

/// The value that the command line calls `text`.
///
/// @param values  of an enumeration with a function name(Value), all of them: one of the above
/// @return        nullopt for a name that none of them has
template <class Value, std::size_t N>
constexpr std::optional<Value> from_name(const std::array<Value, N>& values,
                                         std::string_view text) {
  for (const Value value : values) {
    if (name(value) == text) return value;
  }
  return std::nullopt;
}

/// "balance", "power=2", "cutoff=0.1", "maximum": the heuristic with its parameter, if it has one.
std::string describe(const Weighting& weighting);

/// What `describe` writes; without "=" the usual parameter.
///
/// @return nullopt for an unknown heuristic, a parameter where there is none, β ≤ 0, or α outside
///         [0, 1]
std::optional<Weighting> weighting_from_text(std::string_view text);

}  // namespace plumbline::renderer
