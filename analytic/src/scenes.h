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
double parameter(const OracleInput& input, std::string_view name);

/// `albedo`/π · `radiance`, what turns an irradiance per radiance into reflected radiance; 0 where
/// the depth shows emission alone.
///
/// @throws std::invalid_argument for an albedo outside [0, 1] or a negative or infinite radiance
double reflected_radiance(const OracleInput& input);

/// One expectation for each strategy: a pass.
std::vector<Expectation> expect_pass_from_all();

/// A pass but for those given.
std::vector<Expectation> expect_pass_but_for(std::vector<Expectation> exceptions);

}  // namespace plumbline::analytic
