#pragma once

#include <vector>

#include <plumbline/analytic/camera.h>
#include <plumbline/analytic/colour.h>

namespace plumbline::analytic {

/// A closed form averaged over an area, with a bound on its numerical error.
struct Average {
  Colour value;  ///< radiance [W/(m² sr)]
  /// |value − truth| is at most this: rounding, plus quadrature where there is any.
  Colour error;
};

/// Axis-aligned rectangle in film coordinates [pixels]: x0 < x1 and y0 < y1.
struct FilmBox {
  double x0 = 0, y0 = 0, x1 = 1, y1 = 1;
};

/// The exact image of a scene, as a box-filtered film of any resolution sees it.
class PixelOracle {
 public:
  explicit PixelOracle(FilmSize film) : film_(film) {}
  virtual ~PixelOracle() = default;
  PixelOracle(const PixelOracle&) = delete;
  PixelOracle& operator=(const PixelOracle&) = delete;

  FilmSize film() const { return film_; }

  /// Radiance averaged over any box on the film: a pixel, a tile, the whole image.
  virtual Average box_mean(const FilmBox& box) const = 0;

  /// Radiance averaged over the footprint of pixel (x, y); (0, 0) is the top left one.
  Average pixel_mean(int x, int y) const;

  /// Radiance averaged over the whole film.
  Average image_mean() const;

  /// `pixel_mean` of every pixel, row by row from the top: width·height values.
  std::vector<Colour> image() const;

 private:
  FilmSize film_;
};

}  // namespace plumbline::analytic
