#include <plumbline/renderer/assembly/names.h>

#include <fmt/format.h>

#include <charconv>

namespace plumbline::renderer {
namespace {

bool has_parameter(Heuristic heuristic) {
  return heuristic == Heuristic::power || heuristic == Heuristic::cutoff;
}

bool in_range(const Weighting& w) {
  return w.heuristic == Heuristic::power ? w.parameter > 0 : w.parameter >= 0 && w.parameter <= 1;
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
    case Strategy::average:
      return "average";
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

std::string_view name(SamplerType sampler) {
  return sampler == SamplerType::sobol ? "sobol" : "independent";
}

std::string_view name(LightSelection selection) {
  switch (selection) {
    case LightSelection::uniform:
      return "uniform";
    case LightSelection::area:
      return "area";
    case LightSelection::power:
      return "power";
  }
  return "?";
}

std::string_view name(Backend backend) {
  return backend == Backend::batched ? "batched" : "scalar";
}

std::string_view name(Accelerator accelerator) {
  switch (accelerator) {
    case Accelerator::automatic:
      return "auto";
    case Accelerator::embree:
      return "embree";
    case Accelerator::brute_force:
      return "brute_force";
  }
  return "?";
}

std::string describe(const Weighting& weighting) {
  if (!has_parameter(weighting.heuristic)) return std::string(name(weighting.heuristic));
  return fmt::format("{}={}", name(weighting.heuristic), weighting.parameter);
}

std::optional<Weighting> weighting_from_text(std::string_view text) {
  const std::size_t equals = text.find('=');
  const auto heuristic = from_name(kHeuristics, text.substr(0, equals));
  if (!heuristic) return std::nullopt;
  if (equals == std::string_view::npos) return Weighting(*heuristic);
  const std::string_view number = text.substr(equals + 1);
  Weighting weighting(*heuristic);
  const char* end = number.data() + number.size();
  const auto parsed = std::from_chars(number.data(), end, weighting.parameter);
  if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  if (!has_parameter(*heuristic) || !in_range(weighting)) return std::nullopt;
  return weighting;
}

}  // namespace plumbline::renderer
