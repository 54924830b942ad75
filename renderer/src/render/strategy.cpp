#include <plumbline/renderer/render/strategy.h>

namespace plumbline::renderer {
namespace {

template <class Value, std::size_t N>
std::optional<Value> from_name(const std::array<Value, N>& values, std::string_view text) {
  for (const Value value : values) {
    if (name(value) == text) return value;
  }
  return std::nullopt;
}

}  // namespace

std::string_view name(Strategy strategy) {
  switch (strategy) {
    case Strategy::bsdf:
      return "bsdf";
    case Strategy::light:
      return "light";
    case Strategy::uniform:
      return "uniform";
    case Strategy::mis:
      return "mis";
    case Strategy::one_sample:
      return "one-sample";
  }
  return "?";
}

std::string_view name(Heuristic heuristic) {
  switch (heuristic) {
    case Heuristic::balance:
      return "balance";
    case Heuristic::power:
      return "power";
    case Heuristic::cutoff:
      return "cutoff";
    case Heuristic::maximum:
      return "maximum";
  }
  return "?";
}

std::optional<Strategy> strategy_from_name(std::string_view text) {
  return from_name(kStrategies, text);
}

std::optional<Heuristic> heuristic_from_name(std::string_view text) {
  return from_name(kHeuristics, text);
}

}  // namespace plumbline::renderer
