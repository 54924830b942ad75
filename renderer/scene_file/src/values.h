#pragma once

#include <string_view>
#include <vector>

#include <plumbline/renderer/core/math.h>

#include "scene_file.h"

/// Attribute values as numbers, taken whole: anything left over is an error of the element's.
namespace plumbline::renderer {

/// @throws InputError unless the text is one finite decimal number that a double can hold
double parse_number(const Element& element, std::string_view text);

/// @throws InputError unless the text is one whole number that an int can hold
int parse_integer(const Element& element, std::string_view text);

/// Numbers separated by spaces, or by commas with or without spaces.
std::vector<double> parse_numbers(const Element& element, std::string_view text);

/// One number for all coordinates, or three.
Vec3d parse_vector(const Element& element, std::string_view text);

/// `value` with one or three numbers, or any of `x`, `y`, `z`.
///
/// @param absent  what a coordinate is that is not given
Vec3d parse_xyz(const Element& element, double absent);

/// An attribute with exactly three numbers.
Vec3d parse_triple(const Element& element, const char* attribute);

/// One number for all channels, or three.
Rgbd parse_rgb(const Element& element, std::string_view text);

}  // namespace plumbline::renderer
