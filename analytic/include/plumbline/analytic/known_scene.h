#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/analytic/camera.h>
#include <plumbline/analytic/colour.h>
#include <plumbline/analytic/pixel_oracle.h>

/// The scenes whose answers are known: each is a scene file and a closed form of its image.
namespace plumbline::analytic {

/// How a renderer combines its sampling techniques. Names as on the command line.
enum class Strategy { bsdf, light, uniform, mis, one_sample, average };

inline constexpr Strategy kStrategies[] = {Strategy::bsdf, Strategy::light,      Strategy::uniform,
                                           Strategy::mis,  Strategy::one_sample, Strategy::average};

/// "bsdf", "light", "uniform", "mis", "one-sample" or "average".
std::string_view to_string(Strategy strategy);

/// What a renderer without bugs can be expected to prove about a scene with a strategy.
enum class Expected {
  pass,               ///< that it agrees
  infinite_variance,  ///< nothing, whatever a finite number of samples looks like
  hopeless,           ///< nothing: the variance is finite, but beyond what can be sampled
  fail                ///< that it does not agree: the strategy is blind to light of this scene
};

struct Expectation {
  Strategy strategy = Strategy::mis;
  Expected verdict = Expected::pass;
  std::string_view reason;  ///< one sentence; empty where a pass is expected
  /// Of one independent sample, where a closed form gives it; 0 where not. A light that samples
  /// seldom hit does not show in theirs.
  Colour variance{};
};

/// A <default> of the scene file with the value it has there: a colour where its meaning says
/// [rgb], else one number.
struct Parameter {
  std::string_view name;
  Colour value;
  std::string_view meaning;  ///< with unit and range
};

using ParameterValues = std::map<std::string, Colour, std::less<>>;

/// Other parameters under which the scene is worth a check of its own.
struct Variant {
  std::string_view name;
  ParameterValues parameters;
  std::vector<Expectation> exceptions;  ///< where they differ from the scene's
};

/// Everything that decides a scene's image. Depth counts as in Mitsuba 3: at `max_depth` 1 only
/// emission that the camera sees directly, at 2 direct light too; −1 is unlimited.
struct OracleInput {
  ParameterValues parameters;  ///< every parameter of the scene, by name
  Camera camera;
  int max_depth = -1;
};

struct KnownScene {
  std::string_view name;    ///< also the name of its file, without ".xml"
  std::string_view answer;  ///< one line: "L = albedo · Le on the sphere, Le around it"
  View view;
  FilmSize film;       ///< as in the scene file
  int max_depth = -1;  ///< as in the scene file
  std::vector<Parameter> parameters;
  std::vector<Expectation> expectations;  ///< one for each strategy, at the default parameters
  std::vector<Variant> variants;
  std::unique_ptr<PixelOracle> (*make)(const OracleInput&) = nullptr;

  /// @param variant  one of `variants`, or nullptr for the default parameters
  const Expectation& expectation(Strategy strategy, const Variant* variant = nullptr) const;
};

/// All known scenes, sorted by name.
const std::vector<KnownScene>& known_scenes();

/// The scene of that name, or nullptr.
const KnownScene* find_known_scene(std::string_view name);

/// The scene of that name.
/// @throws std::invalid_argument for an unknown name, listing the known ones
const KnownScene& known_scene(std::string_view name);

/// Path of the scene's XML file.
/// @throws std::invalid_argument for an unknown name
std::filesystem::path scene_file(std::string_view name);

/// The parameters under which a scene is grey: every colour is what its green channel is. Its
/// answer is then the green channel of the scene's own, for renderers in which the product of two
/// colours is not that of their channels: those that render spectra.
ParameterValues in_grey(const KnownScene& scene);

/// The closed form of a scene's image.
///
/// @param overrides  parameters that differ from the defaults
/// @param film       resolution; the scene file's own where not given
/// @param max_depth  the scene file's own where not given; −1 is unlimited
/// @throws std::invalid_argument for a parameter that the scene does not have, a value out of
///         range, or values for which the closed form does not hold (it says which and why)
std::unique_ptr<PixelOracle> make_oracle(const KnownScene& scene,
                                         const ParameterValues& overrides = {},
                                         std::optional<FilmSize> film = std::nullopt,
                                         std::optional<int> max_depth = std::nullopt);

}  // namespace plumbline::analytic
