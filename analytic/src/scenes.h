#pragma once

#include <plumbline/analytic/known_scene.h>

namespace plumbline::analytic {

KnownScene furnace_cube();
KnownScene furnace_open();
KnownScene furnace_sphere();
KnownScene sphere_light();

/// Value of a parameter that the scene is known to have.
double parameter(const OracleInput& input, std::string_view name);

/// One expectation for each strategy: a pass.
std::vector<Expectation> expect_pass_from_all();

}  // namespace plumbline::analytic
