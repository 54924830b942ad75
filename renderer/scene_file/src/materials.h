#pragma once

#include <map>
#include <string>

#include <plumbline/renderer/core/bsdf/fresnel.h>

/// Refractive indices by the names that Mitsuba 3 has for them.
namespace plumbline::renderer {

/// What `int_ior` and `ext_ior` may name.
///
/// @source the table of Mitsuba 3's ior.h
extern const std::map<std::string, double> kRefractiveIndices;

/// What `material` may name: the spectra of Mitsuba's data files as linear RGB, relative to air.
extern const std::map<std::string, ConductorFresnel> kMetals;

}  // namespace plumbline::renderer
