#pragma once

#include <functional>
#include <memory>

#include <plumbline/analytic/camera.h>
#include <plumbline/analytic/pixel_oracle.h>

namespace plumbline::analytic {

/// Mean of a function over a box by Gauss–Legendre rules of 8 × 8 and 6 × 6 points, cut into
/// quarters until the two agree.
///
/// @param relative  difference of the rules at which a box is left whole, in every channel relative
///                  to the first look at the whole box; kinks are cut at most 2^levels times
Average box_quadrature(const std::function<Colour(double, double)>& f, const FilmBox& box,
                       double relative, int levels);

/// Radiance [W/(m² sr)] that leaves a point of the floor z = 0 towards a unit direction.
using Outgoing = std::function<Colour(const Vec3& point, const Vec3& to_camera)>;

struct FloorPrecision {
  double outgoing = 1e-13;  ///< relative error of `outgoing` itself
  double quadrature = 1e-10;
  int levels = 6;
};

/// The image of a floor that fills the film, by quadrature over each box of it.
///
/// @throws std::invalid_argument where the film sees past the square |x|, |y| ≤ `half_side`
std::unique_ptr<PixelOracle> floor_oracle(const Camera& camera, double half_side, Outgoing outgoing,
                                          FloorPrecision precision = {});

/// The same radiance everywhere.
std::unique_ptr<PixelOracle> uniform_oracle(FilmSize film, const Colour& radiance);

/// @throws std::invalid_argument with `what` unless the condition holds
void require(bool condition, const char* what);

}  // namespace plumbline::analytic
