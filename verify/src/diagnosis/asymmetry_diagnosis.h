#pragma once

#include <string>
#include <vector>

#include <plumbline/verify/detail/vector_access.h>

namespace plumbline::verify {

/// What a BSDF has that is not reciprocal, from the ratio of its values both ways.
class Asymmetry {
 public:
  struct Point {
    Vec3 wo{}, wi{};
    double ratio = 1;        ///< f(wo, wi)/η_o² over f(wi, wo)/η_i²
    double eta_squared = 1;  ///< η_i²/η_o²
  };

  void add(const Point& point);

  /// A factor that stands at one direction only: cosθi, η², a masking. Empty where nothing fits.
  std::string diagnosis() const;

 private:
  std::vector<Point> points_;
};

}  // namespace plumbline::verify
