#pragma once

#include <vector>

#include <plumbline/analytic/known_scene.h>

namespace plumbline::analytic {

/// The known scenes, by what lights them or what is asked of them.
std::vector<KnownScene> furnace_scenes();
std::vector<KnownScene> sphere_scenes();
std::vector<KnownScene> polygon_scenes();
std::vector<KnownScene> shadow_scenes();
std::vector<KnownScene> bsdf_scenes();
std::vector<KnownScene> sun_scenes();

/// Value of a parameter that the scene is known to have.
Colour colour(const OracleInput& input, std::string_view name);

/// The same of one that is no colour.
///
/// @throws std::invalid_argument where its channels differ
double parameter(const OracleInput& input, std::string_view name);

/// A parameter that is a reflectance.
///
/// @throws std::invalid_argument outside [0, 1]
Colour reflectance(const OracleInput& input, std::string_view name);

/// A parameter that is what a light emits.
///
/// @throws std::invalid_argument where it is negative or infinite
Colour emitted(const OracleInput& input, std::string_view name);

/// A floor, or what stands for one, seen at 64×48 pixels by light that is reflected once; every
/// strategy passes. View and parameters are left to fill in.
KnownScene floor_scene(std::string_view name, std::string_view answer,
                       std::unique_ptr<PixelOracle> (*make)(const OracleInput&));

/// The parameters that most of these have: "radiance" and "albedo".
Parameter light_radiance(const Colour& value);
Parameter floor_albedo(const Colour& value);

/// Whether light that is reflected once counts at the depth asked for.
bool counts_reflected(const OracleInput& input);

/// `albedo`/π; 0 where the depth shows emission alone.
///
/// @throws std::invalid_argument for an albedo outside [0, 1]
Colour albedo_over_pi(const OracleInput& input);

/// `albedo`/π · `radiance`, what turns an irradiance per radiance into reflected radiance; 0 where
/// the depth shows emission alone.
///
/// @throws std::invalid_argument for an albedo outside [0, 1] or a negative or infinite radiance
Colour reflected_radiance(const OracleInput& input);

/// One expectation for each strategy: a pass.
std::vector<Expectation> expect_pass_from_all();

/// A pass but for those given.
std::vector<Expectation> expect_pass_but_for(std::vector<Expectation> exceptions);

}  // namespace plumbline::analytic
